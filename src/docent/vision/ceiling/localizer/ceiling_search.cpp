#include "docent/vision/ceiling/localizer/ceiling_search.h"

#include <algorithm>
#include <cmath>

namespace docent::vision {
namespace {

constexpr float kPlainVariance = 1e-5F;  // [square of brightness] of what is plain
constexpr std::size_t kFew = 20;         // samples that choose
constexpr std::size_t kChosen = 20;      // times as many places as are wanted are compared by all samples

}  // namespace

/// Where the samples of one heading fall, part after part, from the place below them.
struct CeilingSearch::Looks {
  std::vector<float> x, y;        ///< [samples][parts] [cells]
  std::vector<float> brightness;  ///< [samples]
};

CeilingSearch::CeilingSearch(const CeilingMosaic& mosaic, const MosaicLevel& level, const CameraMount& mount,
                             double step, double turn)
    : level_{&level}, mount_{mount}, headings_{std::max(1, static_cast<int>(std::lround(360.0 / turn)))} {
  const GridFrame& frame = mosaic.frame;
  for (double y = 0.5 * step; y < frame.rows * frame.resolution; y += step)
    for (double x = 0.5 * step; x < frame.columns * frame.resolution; x += step) {
      const Point2 at{frame.origin.x + x, frame.origin.y + y};
      if (mosaic.part[frame.index(frame.cell_at(at))] != CeilingMosaic::kUnknown) places_.push_back(at);
    }
}

double CeilingSearch::correlation_at(Point2 cells, const Looks& looks, std::size_t count) const {
  const std::size_t parts = level_->heights().size();
  const auto x = static_cast<float>(cells.x), y = static_cast<float>(cells.y);
  float n = 0.0F, seen = 0.0F, seen2 = 0.0F, shown = 0.0F, shown2 = 0.0F, both = 0.0F;
  for (std::size_t i = 0; i < count; ++i) {
    float expected = 0.0F;
    bool found = false;
    for (std::size_t part = 0; part < parts && !found; ++part) {
      const std::size_t k = i * parts + part;
      found = level_->nearest(x + looks.x[k], y + looks.y[k], part, expected);
    }
    if (!found) continue;
    const float b = looks.brightness[i];
    n += 1.0F, seen += expected, seen2 += expected * expected, shown += b, shown2 += b * b, both += b * expected;
  }
  if (2.0F * n < static_cast<float>(count)) return 0.0;
  const float of_shown = shown2 / n - shown / n * (shown / n), of_seen = seen2 / n - seen / n * (seen / n);
  if (of_shown < kPlainVariance || of_seen < kPlainVariance) return 0.0;
  return static_cast<double>((both / n - shown / n * (seen / n)) / std::sqrt(of_shown * of_seen));
}

std::vector<std::pair<double, Pose2>> CeilingSearch::best(std::span<const CeilingSample> samples,
                                                          std::size_t most) const {
  const GridFrame& frame = level_->frame();
  const double per_metre = 1.0 / frame.resolution;
  const std::vector<double>& heights = level_->heights();
  std::vector<Looks> all(static_cast<std::size_t>(headings_));
  for (int k = 0; k < headings_; ++k) {
    const Point2 along = unit(Angle::degrees(360.0 * k / headings_));
    Looks& looks = all[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < samples.size(); ++i) {
      // The few are spread over all.
      const CeilingSample& sample = samples[i * 7 % samples.size()];
      looks.brightness.push_back(sample.brightness);
      for (const double height : heights) {
        const double above = height - mount_.position.z();
        const double x = mount_.position.x() + above * static_cast<double>(sample.slope_x);
        const double y = mount_.position.y() + above * static_cast<double>(sample.slope_y);
        looks.x.push_back(static_cast<float>(per_metre * (along.x * x - along.y * y)));
        looks.y.push_back(static_cast<float>(per_metre * (along.y * x + along.x * y)));
      }
    }
  }
  struct Candidate {
    double correlation = 0.0;
    std::uint32_t place = 0, heading = 0;
  };
  const auto is_better = [](const Candidate& a, const Candidate& b) {
    if (a.correlation != b.correlation) return a.correlation > b.correlation;
    return a.place != b.place ? a.place < b.place : a.heading < b.heading;
  };
  const auto keep_best = [&](std::vector<Candidate>& from, std::size_t count) {
    if (from.size() > count) {
      std::nth_element(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count), from.end(), is_better);
      from.resize(count);
    }
  };
  const auto in_cells = [&](std::uint32_t place) { return per_metre * (places_[place] - frame.origin); };
  std::vector<Candidate> found;
  const std::size_t few = std::min(kFew, samples.size());
  for (std::uint32_t place = 0; place < places_.size(); ++place)
    for (std::uint32_t heading = 0; heading < all.size(); ++heading)
      found.push_back({correlation_at(in_cells(place), all[heading], few), place, heading});
  keep_best(found, kChosen * most);
  for (Candidate& one : found) one.correlation = correlation_at(in_cells(one.place), all[one.heading], samples.size());
  keep_best(found, most);
  std::sort(found.begin(), found.end(), is_better);
  std::vector<std::pair<double, Pose2>> best;
  for (const Candidate& one : found)
    best.emplace_back(one.correlation, Pose2{places_[one.place].x, places_[one.place].y,
                                             Angle::degrees(360.0 * one.heading / headings_)});
  return best;
}

}  // namespace docent::vision
