#include "docent/collision_avoidance/virtual_measurements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kStep = 2.0 * kPi / VirtualMeasurements::kDirections;
constexpr double kLattice = 0.025;        // [m] positions closer than this share their distances
constexpr std::size_t kMaxRows = 300000;  // 60 MB
constexpr double kReentry = 0.5;          // [m]

std::uint8_t bin_of(double range) {
  return static_cast<std::uint8_t>(
      std::clamp(static_cast<int>(range / VirtualMeasurements::kBin), 0, VirtualMeasurements::kBins - 1));
}

std::uint64_t key_of(Point2 position) {
  const auto column = static_cast<std::uint64_t>(std::llround(position.x / kLattice));
  const auto line = static_cast<std::uint64_t>(std::llround(position.y / kLattice));
  return (column << 32U) ^ (line & 0xffffffffU);
}

int wrapped(int direction) {
  const int rest = direction % VirtualMeasurements::kDirections;
  return rest < 0 ? rest + VirtualMeasurements::kDirections : rest;
}

}  // namespace

Result<void> VirtualMeasurementParams::validate() const {
  if (!(confidence > 0.5 && confidence < 1.0)) return fail("hazards.confidence must lie between 0.5 and 1");
  if (!(cell_padding >= 0.0 && cell_padding < 0.5)) return fail("hazards.cell_padding must lie between 0 and 0.5 m");
  if (!(max_impossible >= 0.0 && max_impossible < 1.0)) return fail("hazards.max_impossible must lie in [0, 1)");
  return {};
}

VirtualMeasurements::VirtualMeasurements(Polygon area, std::vector<Polygon> hazards, VirtualMeasurementParams params)
    : area_{std::move(area)},
      hazards_{std::move(hazards)},
      params_{params},
      histogram_(static_cast<std::size_t>(kDirections) * kBins) {
  if (area_.size() >= 3) borders_ = sides(area_);
  for (const auto& hazard : hazards_) {
    const auto outline = sides(hazard);
    borders_.insert(borders_.end(), outline.begin(), outline.end());
  }
}

bool VirtualMeasurements::is_possible(Point2 position) const {
  if (area_.size() >= 3 && !contains(area_, position)) return false;
  return std::none_of(hazards_.begin(), hazards_.end(),
                      [&](const Polygon& hazard) { return contains(hazard, position); });
}

double VirtualMeasurements::border_distance(Point2 position) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& border : borders_) least = std::min(least, distance(border, position));
  return least;
}

double VirtualMeasurements::nearest(Point2 position) const {
  return is_possible(position) ? border_distance(position) : 0.0;
}

double VirtualMeasurements::square_range(Point2 centre, double half_diagonal) const {
  const double range = border_distance(centre) - half_diagonal;
  return range < 0.0 ? 0.0 : is_possible(centre) ? range : -1.0;
}

void VirtualMeasurements::fill(Row& row, Point2 position) const {
  const double padding = params_.cell_padding;
  std::array<double, kDirections> ranges;
  ranges.fill(kMaxRange);
  for (const auto& border : borders_) {
    const Point2 foot = nearest_point(border, position);
    const double nearest = distance(foot, position);
    if (nearest - padding >= kMaxRange) continue;
    const Point2 a = border.a - position;
    const Point2 b = border.b - position;
    const double first = std::atan2(a.y, a.x);
    const double turn = std::atan2(cross(a, b), dot(a, b));  // from a to b, less than half a turn
    const double low = std::min(first, first + turn);
    const double high = std::max(first, first + turn);
    const double line_distance = std::abs(cross(a, b)) / std::max(1e-9, norm(b - a));
    const Point2 along = (1.0 / std::max(1e-9, norm(b - a))) * (b - a);
    const Point2 to_line = a - dot(a, along) * along;
    const double normal = std::atan2(to_line.y, to_line.x);
    // A ray that starts up to `padding` beside the centre, or anywhere within its 2 degrees, may still hit.
    const double widening = 0.5 * kStep + std::asin(std::min(1.0, padding / std::max(nearest, 1e-9)));
    const int from = static_cast<int>(std::ceil((low - widening) / kStep));
    const int to = static_cast<int>(std::floor((high + widening) / kStep));
    for (int direction = from; direction <= to; ++direction) {
      double range = nearest;
      if (line_distance > 1e-3) {
        const double centre = direction * kStep;
        double start = std::clamp(centre - widening, low, high) - normal;
        double end = std::clamp(centre + widening, low, high) - normal;
        const double whole_turns = 2.0 * kPi * std::round(0.5 * (start + end) / (2.0 * kPi));
        start -= whole_turns;
        end -= whole_turns;
        const double best = start > 0.0 ? start : end < 0.0 ? end : 0.0;  // nearest to the foot of the normal
        const double cosine = std::cos(best);
        range = cosine > 1e-6 ? std::max(nearest, line_distance / cosine) : kMaxRange;
      }
      auto& least = ranges[static_cast<std::size_t>(wrapped(direction))];
      least = std::min(least, std::max(0.0, range - padding));
    }
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) row.bins[i] = bin_of(ranges[i]);
}

void VirtualMeasurements::fill_from_outside(Row& row, Point2 position) const {
  for (int i = 0; i < kDirections; ++i) {
    const Point2 direction = unit(Angle::radians(i * kStep));
    bool returns = false;
    for (double way = kBin; way <= kReentry && !returns; way += kBin) returns = is_possible(position + way * direction);
    row.bins[static_cast<std::size_t>(i)] = returns ? static_cast<std::uint8_t>(kBins - 1) : std::uint8_t{1};
  }
}

const VirtualMeasurements::Row& VirtualMeasurements::row_at(Point2 position) {
  if (rows_.size() >= kMaxRows) {
    rows_.clear();
    index_.clear();
  }
  const auto [entry, is_new] = index_.try_emplace(key_of(position), rows_.size());
  if (is_new) {
    const Point2 centre{kLattice * std::round(position.x / kLattice), kLattice * std::round(position.y / kLattice)};
    Row& row = rows_.emplace_back();
    row.possible = is_possible(centre);
    row.possible ? fill(row, centre) : fill_from_outside(row, centre);
  }
  return rows_[entry->second];
}

VirtualMeasurements::Scan VirtualMeasurements::measure(std::span<const WeightedPose> poses,
                                                       std::span<const WeightedSquare> rest) {
  std::array<WeightedPose, 1> best;
  if (params_.best_pose_only && !poses.empty()) {
    best[0] =
        *std::max_element(poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.mass < b.mass; });
    poses = best;
    rest = {};
  }
  if (rows_.size() + poses.size() > kMaxRows) {  // not in the middle of a belief
    rows_.clear();
    index_.clear();
  }

  double all = 0.0;
  double possible = 0.0;
  for (const auto& pose : poses) {
    all += pose.mass;
    if (row_at(pose.position).possible) possible += pose.mass;
  }
  double rest_mass = 0.0;
  for (const auto& square : rest) rest_mass += square.mass;
  Scan scan;
  if (!(all + rest_mass > 0.0)) return scan;
  scan.possible_mass = all > 0.0 ? possible / all : 0.0;
  const bool leave_out = possible >= (1.0 - params_.max_impossible) * all;

  std::fill(histogram_.begin(), histogram_.end(), 0.0);
  double total = 0.0;
  for (const auto& pose : poses) {
    const Row& row = row_at(pose.position);
    if (leave_out && !row.possible) continue;
    total += pose.mass;
    // Robot direction i is map direction i + heading - 180 degrees.
    int direction = wrapped(static_cast<int>(std::lround(pose.heading / kStep)) - kDirections / 2);
    double* bins = histogram_.data();
    for (int i = 0; i < kDirections; ++i, bins += kBins) {
      bins[row.bins[static_cast<std::size_t>(direction)]] += pose.mass;
      if (++direction == kDirections) direction = 0;
    }
  }
  for (const auto& square : rest) {
    if (!(square.mass > 0.0)) continue;
    const double half = 0.5 * std::numbers::sqrt2 * square.side;
    const auto [place, is_new] = square_ranges_.try_emplace(key_of(square.centre), 0.0);
    if (is_new) place->second = square_range(square.centre, half);
    const double range = place->second;
    if (range < 0.0 && leave_out) continue;  // the robot can be nowhere in it
    total += square.mass;
    for (int i = 0; i < kDirections; ++i) {
      histogram_[static_cast<std::size_t>(i) * kBins + bin_of(std::max(0.0, range))] += square.mass;
    }
  }

  const double allowed = (1.0 - params_.confidence) * total;
  for (int i = 0; i < kDirections; ++i) {
    const double* bins = histogram_.data() + static_cast<std::ptrdiff_t>(i) * kBins;
    double below = 0.0;
    int bin = 0;
    while (bin + 1 < kBins && (below += bins[bin]) < allowed) ++bin;
    scan.ranges[static_cast<std::size_t>(i)] = kBin * bin;
  }
  return scan;
}

}  // namespace docent
