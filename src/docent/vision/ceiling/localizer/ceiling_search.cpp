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
constexpr double kLeastPart = 0.01;      // of the ceiling: smaller parts tell too little for what they cost
constexpr double kApart = 0.7;       // [m]
constexpr double kTurnedApart = 20.0;       // [deg]
constexpr std::size_t kNeighbours = 40;  // cells of the grid that one place fills at most

int rounded(double value) { return static_cast<int>(std::lround(value)); }
float log_of(float correlation) { return -std::log1p(-correlation * correlation); }

}  // namespace

/// Of the samples at the places of one row: how many lie on the ceiling, and what makes the correlation.
struct CeilingSearch::Sums {
  Row n, shown, shown2, seen, seen2, both;
  explicit Sums(int columns)
      : n(columns), shown(columns), shown2(columns), seen(columns), seen2(columns), both(columns) {}
  void clear() {
    for (Row* row : {&n, &shown, &shown2, &seen, &seen2, &both}) row->setZero();
  }
  void add(const Part& part, float brightness, int row, int right) {
    const Eigen::Index columns = n.size();
    const Eigen::Index first = std::max(0, -right), count = columns - std::abs(right);
    if (count <= 0) return;
    const auto there = part.is_there.row(row).segment(first + right, count).transpose();
    const auto value = part.brightness.row(row).segment(first + right, count).transpose();
    n.segment(first, count) += there;
    shown.segment(first, count) += brightness * there;
    shown2.segment(first, count) += brightness * brightness * there;
    seen.segment(first, count) += value;
    seen2.segment(first, count) += part.square.row(row).segment(first + right, count).transpose();
    both.segment(first, count) += brightness * value;
  }
  [[nodiscard]] float correlation(Eigen::Index i, float least) const {
    if (n(i) < least) return 0.0F;
    const float share = 1.0F / n(i);
    const float of_shown = shown2(i) * share - shown(i) * share * shown(i) * share;
    const float of_seen = seen2(i) * share - seen(i) * share * seen(i) * share;
    if (of_shown < kPlain || of_seen < kPlain) return 0.0F;
    return std::clamp((both(i) * share - shown(i) * share * seen(i) * share) / std::sqrt(of_shown * of_seen), 0.0F,
                      kLargest);
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
    Part part{level.heights()[k], Plane::Zero(rows_, columns_), Plane::Zero(rows_, columns_), {}};
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        float brightness = 0.0F;
        if (!level.nearest(static_cast<float>((column + 0.5) * step * per_metre),
                           static_cast<float>((row + 0.5) * step * per_metre), k, brightness))
          continue;
        part.is_there(row, column) = 1.0F;
        part.brightness(row, column) = brightness;
      }
    part.square = part.brightness.square();
    parts_.push_back(std::move(part));
  }
  const auto area = [](double sum, const Part& part) { return sum + static_cast<double>(part.is_there.sum()); };
  const double all = std::accumulate(parts_.begin(), parts_.end(), 0.0, area);
  std::erase_if(parts_, [&](const Part& part) { return area(0.0, part) < kLeastPart * all; });
}

CeilingSearch::Likelihoods CeilingSearch::likelihoods(std::span<const CeilingSample> samples) const {
  struct Offset {
    const Part* part;
    float brightness;
    int right, up;
  };
  const float per_log = 255.0F / log_of(kLargest);
  const float least = kLeastSeen * static_cast<float>(samples.size());
  Likelihoods found(size());
  Sums sums{columns_};
  std::vector<Offset> offsets;
  std::uint8_t* out = found.data();
  for (int heading = 0; heading < headings_; ++heading) {
    const Point2 along = unit(Angle::degrees(360.0 * heading / headings_));
    offsets.clear();
    for (const CeilingSample& sample : samples)
      for (const Part& part : parts_) {
        const double above = part.height - mount_.position.z();
        const double x = mount_.position.x() + above * static_cast<double>(sample.slope_x);
        const double y = mount_.position.y() + above * static_cast<double>(sample.slope_y);
        offsets.push_back({&part, sample.brightness, rounded((along.x * x - along.y * y) / step_),
                           rounded((along.y * x + along.x * y) / step_)});
      }
    for (int row = 0; row < rows_; ++row) {
      sums.clear();
      for (const Offset& offset : offsets)
        if (row + offset.up >= 0 && row + offset.up < rows_)
          sums.add(*offset.part, offset.brightness, row + offset.up, offset.right);
      for (int column = 0; column < columns_; ++column)
        *out++ = static_cast<std::uint8_t>(per_log * log_of(sums.correlation(column, least)));
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
