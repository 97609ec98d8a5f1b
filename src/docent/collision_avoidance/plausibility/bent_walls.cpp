#include "docent/collision_avoidance/plausibility/bent_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/range_law.h"

namespace docent::collision_avoidance {

BentWalls::Line BentWalls::line_of(std::span<const Sample> samples, double offset) const {
  // 1 / (range - offset) = a cos + b sin, each weighed so that errors of the range count. Twice: then without what lies off.
  double a = 0.0;
  double b = 0.0;
  Line line;
  for (int pass = 0; pass < 3; ++pass) {
    const double off = pass == 0 ? std::numeric_limits<double>::infinity() : (pass == 1 ? 2.0 : 1.0) * params_.off;
    double cc = 0.0, cs = 0.0, ss = 0.0, c1 = 0.0, s1 = 0.0;
    line.squares = 0.0;
    line.count = 0;
    for (const Sample& sample : samples) {
      const double range = sample.range - offset;
      if (range < 0.1) return {};
      const double inverse = a * sample.cosine + b * sample.sine;
      const double error = pass == 0 ? 0.0 : inverse > 1e-3 ? range - 1.0 / inverse : 1e3;
      if (std::abs(error) > off) continue;
      line.squares += error * error;
      ++line.count;
      const double weight = range * range * range * range;
      cc += weight * sample.cosine * sample.cosine;
      cs += weight * sample.cosine * sample.sine;
      ss += weight * sample.sine * sample.sine;
      c1 += weight * sample.cosine / range;
      s1 += weight * sample.sine / range;
    }
    const double determinant = cc * ss - cs * cs;
    if (!(determinant > 1e-9 * cc * ss)) return {};
    a = (c1 * ss - s1 * cs) / determinant;
    b = (s1 * cc - c1 * cs) / determinant;
  }
  line.normal = std::atan2(b, a);
  return line;
}

std::optional<BentWalls::Wall> BentWalls::wall_of(std::span<const Sample> samples) const {
  std::vector<double> ranges;
  for (const Sample& sample : samples) ranges.push_back(sample.range);
  const double middle = median(ranges);
  const auto least_count = (1.0 - params_.holes) * static_cast<double>(samples.size());
  const double most_noise = params_.noise + params_.per_metre * middle;
  const int steps = static_cast<int>(std::lround((params_.most - params_.least) / params_.grid));
  std::vector<double> costs;  // [offsets] mean square, with what lies off
  std::vector<Line> lines;
  for (int i = 0; i <= steps; ++i) {
    lines.push_back(line_of(samples, params_.least + i * params_.grid));
    const int lost = static_cast<int>(samples.size()) - lines.back().count;
    costs.push_back((lines.back().squares + lost * params_.off * params_.off) / static_cast<double>(samples.size()));
  }
  const auto best = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  if (best == 0 || best + 1 == costs.size() || lines[best].count < least_count) return std::nullopt;
  if (std::sqrt(lines[best].squares / lines[best].count) > most_noise) return std::nullopt;
  const double curve = costs[best - 1] + costs[best + 1] - 2.0 * costs[best];
  if (!(curve > 0.0)) return std::nullopt;
  const double aside = 0.5 * (costs[best - 1] - costs[best + 1]) / curve;  // grid steps
  const double per_offset = 0.5 * curve / (params_.grid * params_.grid);   // mean square a squared metre
  const double noise = std::max(costs[best], 1e-4);
  return Wall{params_.least + (static_cast<double>(best) + aside) * params_.grid,
              std::sqrt(noise / (per_offset * static_cast<double>(lines[best].count))), lines[best].normal};
}

void BentWalls::look(const SweepView& view) {
  const auto width = static_cast<std::size_t>(std::lround(params_.window / view.bearing_step));
  const auto step = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(params_.step / view.bearing_step)));
  if (width < 16) return;
  std::optional<Vote> vote;
  for (std::size_t first = 0; first + width <= view.ranges.size(); first += step) {
    std::vector<Sample> samples;
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0.0;
    for (std::size_t i = first; i < first + width; ++i) {
      if (!view.met(i)) continue;
      const double bearing = view.first_bearing + static_cast<double>(i) * view.bearing_step;
      const auto range = static_cast<double>(view.ranges[i]);
      samples.push_back({std::cos(bearing), std::sin(bearing), range});
      nearest = std::min(nearest, range);
      farthest = std::max(farthest, range);
    }
    if (static_cast<double>(samples.size()) < (1.0 - params_.holes) * static_cast<double>(width)) continue;
    if (farthest > params_.slant * nearest) continue;
    const auto wall = wall_of(samples);
    if (!wall || wall->sigma > params_.sure_offset) continue;
    const double offset = std::abs(wall->offset);
    const bool is_bent = offset >= params_.bent && offset >= params_.sigmas * wall->sigma;
    if (!is_bent && offset > params_.straight) continue;
    // A single straight wall speaks for the sweep.
    if (!vote || !is_bent)
      vote = Vote{view.stamp, wall->offset, view.odom_from_sensor.theta + Angle::radians(wall->normal), is_bent};
    if (!is_bent) break;
  }
  if (vote) votes_.push_back(*vote);
}

std::optional<double> BentWalls::offset() const {
  if (votes_.empty() || !votes_.back().is_bent) return std::nullopt;
  std::vector<double> offsets;
  for (const Vote& vote : votes_)
    if (vote.is_bent) offsets.push_back(vote.offset);
  const double offset = median(offsets);
  std::size_t same = 0;
  std::size_t straight = 0;
  bool is_other_wall = false;
  const Vote* first = nullptr;
  for (const Vote& vote : votes_) {
    straight += vote.is_bent ? 0 : 1;
    if (!vote.is_bent || std::abs(vote.offset - offset) > params_.same) continue;
    ++same;
    if (first == nullptr) first = &vote;
    is_other_wall = is_other_wall || std::abs((vote.normal - first->normal).radians()) >= params_.other_wall;
  }
  const auto count = static_cast<double>(same);
  const bool is_offset = same >= params_.votes && is_other_wall &&
                         count >= params_.than_others * static_cast<double>(straight) &&
                         count >= params_.share * static_cast<double>(votes_.size());
  return is_offset ? std::optional{offset} : std::nullopt;
}

bool BentWalls::are_straight() const {
  std::size_t straight = 0;
  for (const Vote& vote : votes_) {
    if (votes_.back().stamp - vote.stamp > seconds(params_.newest)) continue;
    if (vote.is_bent) return false;
    ++straight;
  }
  return straight >= params_.straight_again;
}

std::optional<double> BentWalls::add(const SweepView& view) {
  while (!votes_.empty() && view.stamp - votes_.front().stamp > seconds(params_.memory)) votes_.pop_front();
  if (view.stamp - looked_ < seconds(params_.between)) return std::nullopt;
  looked_ = view.stamp;
  const std::size_t before = votes_.size();
  look(view);
  return votes_.size() > before ? offset() : std::nullopt;
}

}  // namespace docent::collision_avoidance
