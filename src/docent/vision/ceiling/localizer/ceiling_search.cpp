#include "docent/vision/ceiling/localizer/ceiling_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace docent::vision {
namespace {

constexpr float kPlain = 1e-5F;          // [square of brightness] variance of what is plain
constexpr float kLeastSeen = 0.5F;       // of the samples, that lie on the ceiling
constexpr float kLargest = 0.95F;        // correlation that a coarse grid can reach
constexpr float kLeastPart = 0.02F;      // of the ceiling: smaller parts are no part of their own here
constexpr double kAlike = 0.10;          // heights of which the logarithms differ by less are one part here
constexpr int kTogether = 8;             // places that are looked at together
constexpr int kMargin = 100;             // [places] round the ceiling: the farthest look
constexpr double kApart = 0.7;           // [m]
constexpr double kTurnedApart = 20.0;    // [deg]
constexpr std::size_t kNeighbours = 40;  // cells of the grid that one place fills at most

int rounded(double value) { return static_cast<int>(std::lround(value)); }
float log_of(float correlation) { return -std::log1p(-correlation * correlation); }

}  // namespace

/// Of the samples at some places beside one another: how many lie on the ceiling, and what makes the correlation.
struct CeilingSearch::Sums {
  using Places = Eigen::Array<float, kTogether, 1>;
  Places n = Places::Zero(), shown = Places::Zero(), shown2 = Places::Zero();
  Places seen = Places::Zero(), seen2 = Places::Zero(), both = Places::Zero();
  void add(const Part& part, float brightness, std::ptrdiff_t at) {
    const Eigen::Map<const Places> there{part.is_there.data() + at}, value{part.brightness.data() + at};
    const Eigen::Map<const Places> square{part.square.data() + at};
    const Places bright = brightness * there;
    n += there;
    shown += bright;
    shown2 += brightness * bright;
    seen += value;
    seen2 += square;
    both += brightness * value;
  }
  [[nodiscard]] float correlation(Eigen::Index i, float least) const {
    if (n(i) < least) return 0.0F;
    const float share = 1.0F / n(i);
    const float of_shown = shown2(i) * share - shown(i) * share * shown(i) * share;
    const float of_seen = seen2(i) * share - seen(i) * share * seen(i) * share;
    if (of_shown < kPlain || of_seen < kPlain) return 0.0F;
    const float together = both(i) * share - shown(i) * share * seen(i) * share;
    return std::clamp(together / std::sqrt(of_shown * of_seen), 0.0F, kLargest);
  }
};

CeilingSearch::CeilingSearch(const CeilingMosaic& mosaic, const MosaicLevel& level, const CameraMount& mount,
                             double step, double turn)
    : mount_{mount},
      origin_{mosaic.frame.origin},
      step_{step},
      headings_{std::max(1, rounded(360.0 / turn))},
      rows_{std::max(1, static_cast<int>(mosaic.frame.rows * mosaic.frame.resolution / step))},
      columns_{std::max(1, static_cast<int>(mosaic.frame.columns * mosaic.frame.resolution / step))} {
  const double per_metre = 1.0 / level.frame().resolution;
  for (std::size_t k = 0; k < level.heights().size(); ++k) {
    Part part{level.heights()[k], Plane::Zero(height(), width()), Plane::Zero(height(), width()), {}};
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        float brightness = 0.0F;
        if (!level.nearest(static_cast<float>((column + 0.5) * step * per_metre),
                           static_cast<float>((row + 0.5) * step * per_metre), k, brightness))
          continue;
        part.is_there(row + kMargin, column + kMargin) = 1.0F;
        part.brightness(row + kMargin, column + kMargin) = brightness;
      }
    parts_.push_back(std::move(part));
  }
  join_parts();
  for (Part& part : parts_) part.square = part.brightness.square();
}

/// Small parts count as the one that is nearest in height: a coarse grid tells them hardly apart.
void CeilingSearch::join_parts() {
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) { return a.area() > b.area(); });
  const float all = std::accumulate(parts_.begin(), parts_.end(), 0.0F,
                                    [](float sum, const Part& part) { return sum + part.area(); });
  std::vector<Part> large;
  for (Part& part : parts_) {
    const auto nearest = std::min_element(large.begin(), large.end(), [&](const Part& a, const Part& b) {
      return std::abs(std::log(a.height / part.height)) < std::abs(std::log(b.height / part.height));
    });
    const bool is_alike = nearest != large.end() && std::abs(std::log(nearest->height / part.height)) < kAlike;
    if (is_alike || (nearest != large.end() && part.area() < kLeastPart * all)) {
      nearest->is_there += part.is_there;
      nearest->brightness += part.brightness;
    } else {
      large.push_back(std::move(part));
    }
  }
  parts_ = std::move(large);
}

int CeilingSearch::width() const { return columns_ + 2 * kMargin; }
int CeilingSearch::height() const { return rows_ + 2 * kMargin; }

/// Whether there is ceiling above one of the places that are looked at together.
bool CeilingSearch::is_below(int row, int column) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) {
    return (part.is_there.row(row + kMargin).segment<kTogether>(column + kMargin) > 0.0F).any();
  });
}

CeilingSearch::Likelihoods CeilingSearch::likelihoods(std::span<const CeilingSample> samples) const {
  struct Offset {
    const Part* part;
    float brightness;
    std::ptrdiff_t from_here;
  };
  const float per_log = 255.0F / log_of(kLargest);
  const float least = kLeastSeen * static_cast<float>(samples.size());
  Likelihoods found(size());
  std::vector<Offset> offsets;
  for (int heading = 0; heading < headings_; ++heading) {
    const Point2 along = unit(Angle::degrees(360.0 * heading / headings_));
    offsets.clear();
    for (const CeilingSample& sample : samples)
      for (const Part& part : parts_) {
        const double above = part.height - mount_.position.z();
        const double x = mount_.position.x() + above * static_cast<double>(sample.slope_x);
        const double y = mount_.position.y() + above * static_cast<double>(sample.slope_y);
        const int right = rounded((along.x * x - along.y * y) / step_);
        const int up = rounded((along.y * x + along.x * y) / step_);
        if (std::max(std::abs(right), std::abs(up)) <= kMargin)
          offsets.push_back({&part, sample.brightness, up * static_cast<std::ptrdiff_t>(width()) + right});
      }
    for (int row = 0; row < rows_; ++row) {
      const std::ptrdiff_t first = (row + kMargin) * static_cast<std::ptrdiff_t>(width()) + kMargin;
      std::uint8_t* out = found.data() + static_cast<std::ptrdiff_t>(heading * rows_ + row) * columns_;
      for (int column = 0; column < columns_; column += kTogether) {
        if (!is_below(row, column)) continue;
        Sums sums;
        for (const Offset& offset : offsets)
          sums.add(*offset.part, offset.brightness, first + column + offset.from_here);
        for (int i = 0; i < std::min(kTogether, columns_ - column); ++i)
          out[column + i] = static_cast<std::uint8_t>(per_log * log_of(sums.correlation(i, least)));
      }
    }
  }
  return found;
}

Pose2 CeilingSearch::pose_of(std::size_t index) const {
  const auto columns = static_cast<std::size_t>(columns_), rows = static_cast<std::size_t>(rows_);
  const std::size_t place = index % (rows * columns);
  return {origin_.x + (static_cast<double>(place % columns) + 0.5) * step_,
          origin_.y + (static_cast<double>(place / columns) + 0.5) * step_,
          Angle::degrees(360.0 * static_cast<double>(index / (rows * columns)) / headings_)};
}

std::vector<std::uint16_t> CeilingSearch::summed(std::span<const View> views) const {
  std::vector<std::uint16_t> sums(size());
  const auto columns = static_cast<std::ptrdiff_t>(columns_), rows = static_cast<std::ptrdiff_t>(rows_);
  for (const View& view : views) {
    const int turned = rounded(view.here_from_view.theta.degrees() * headings_ / 360.0);
    for (int heading = 0; heading < headings_; ++heading) {
      const Point2 along = unit(Angle::degrees(360.0 * heading / headings_));
      const Point2 then = view.here_from_view.position();
      const std::ptrdiff_t right = rounded((along.x * then.x - along.y * then.y) / step_);
      const std::ptrdiff_t up = rounded((along.y * then.x + along.x * then.y) / step_);
      const int heading_then = ((heading + turned) % headings_ + headings_) % headings_;
      const std::ptrdiff_t first = std::max<std::ptrdiff_t>(0, -right), last = std::min(columns, columns - right);
      for (std::ptrdiff_t row = std::max<std::ptrdiff_t>(0, -up); row < std::min(rows, rows - up); ++row) {
        const std::uint8_t* from = view.likelihoods->data() + (heading_then * rows + row + up) * columns + right;
        std::uint16_t* to = sums.data() + (heading * rows + row) * columns;
        for (std::ptrdiff_t column = first; column < last; ++column) to[column] += from[column];
      }
    }
  }
  return sums;
}

std::vector<Pose2> CeilingSearch::best(std::span<const View> views, std::size_t most) const {
  const std::vector<std::uint16_t> sums = summed(views);
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < sums.size(); ++i)
    if (sums[i] > 0) order.push_back(i);
  const std::size_t count = std::min(order.size(), kNeighbours * most);
  const auto is_better = [&](std::uint32_t a, std::uint32_t b) {
    return sums[a] != sums[b] ? sums[a] > sums[b] : a < b;
  };
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(), is_better);
  order.resize(count);
  std::sort(order.begin(), order.end(), is_better);
  std::vector<Pose2> found;
  for (const std::uint32_t i : order) {
    if (found.size() >= most) break;
    const Pose2 pose = pose_of(i);
    const bool is_known = std::any_of(found.begin(), found.end(), [&](const Pose2& other) {
      return distance(other.position(), pose.position()) < kApart &&
             std::abs((other.theta - pose.theta).degrees()) < kTurnedApart;
    });
    if (!is_known) found.push_back(pose);
  }
  return found;
}

}  // namespace docent::vision
