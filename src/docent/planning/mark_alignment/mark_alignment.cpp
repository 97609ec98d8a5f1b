#include "docent/planning/mark_alignment/mark_alignment.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace docent::planning {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kBin = 0.05;      // [m] of histograms
constexpr double kInside = 1.0;    // [m] that histograms reach inside the border
constexpr double kPerWall = 0.15;  // [m] of wall that one point stands for
constexpr double kAlike = 0.94;    // cosine of 20 degrees: between a wall and a side of the border
constexpr double kBeyond = 0.6;    // [m] beyond the ends of a side
constexpr double kShift = 0.1;     // [m] between places of the search
constexpr double kTurn = 1.0 * kDegree;
constexpr double kSearched = 3.0;    // standard deviations to each side
constexpr double kOtherPlace = 4.0;  // sigmas by what is seen: so far off is another place
constexpr double kTold = 0.5;        // [m] of wall that one sigma off what the robot was told costs
constexpr double kMatters = 0.06;    // [m] at a corner of the border
constexpr double kLeastGap = -0.3;   // [m]: a border that runs along the walls themselves
constexpr double kEndWeight = 2.0;   // ends of a wall that are seen count as so many metres each, at most

double gauss(double off, double sigma) { return std::exp(-0.5 * off * off / (sigma * sigma)); }

}  // namespace

Result<void> MarkAlignmentParams::validate() const {
  if (!(start_position >= 0.0 && start_position <= 2.0)) return fail("start_position must be 0..2 m");
  if (!(start_heading >= 0.0 && start_heading <= 30.0)) return fail("start_heading must be 0..30 degrees");
  if (!(sigmas >= 0.0)) return fail("sigmas must be >= 0");
  if (!(free >= 0.0)) return fail("free must be >= 0 m");
  if (!(wall_reach > 0.0)) return fail("wall_reach must be > 0 m");
  if (!(wall_sigma > 0.0)) return fail("wall_sigma must be > 0 m");
  if (!(least_wall > 0.0)) return fail("least_wall must be > 0 m");
  if (!(distinct > 1.0)) return fail("distinct must be > 1");
  return {};
}

MarkAlignment::MarkAlignment(const MarkAlignmentParams& params, const Polygon& area, const Pose2& start)
    : params_{params}, start_{start}, covariance_{Eigen::Matrix3d::Zero()} {
  const double sign = signed_area(area) > 0.0 ? 1.0 : -1.0;
  for (const Segment& side : sides(area)) {
    const double length = distance(side.a, side.b);
    if (length < 1.0) continue;
    const Point2 along = (1.0 / length) * (side.b - side.a);
    const Point2 outward{sign * along.y, -sign * along.x};
    borders_.push_back({side, outward, dot(outward, side.a), length});
  }
  covariance_(0, 0) = covariance_(1, 1) = params.start_position * params.start_position;
  covariance_(2, 2) = params.start_heading * params.start_heading * kDegree * kDegree;
}

Pose2 MarkAlignment::pose_of(const Place& place) const {
  // Turned about the start, then shifted.
  const Pose2 turned{start_.x, start_.y, Angle::radians(place.heading)};
  const Point2 back = turned * Point2{-start_.x, -start_.y};
  return {back.x + place.x, back.y + place.y, Angle::radians(place.heading)};
}

MarkAlignment::Histograms MarkAlignment::histograms(std::span<const mapping::SurfacePoint> walls, double heading,
                                                    Point2 shift) const {
  const auto bins = static_cast<std::size_t>((kInside + params_.wall_reach) / kBin) + 1;
  Histograms result{std::vector(borders_.size(), std::vector<float>(bins, 0.0F))};
  const Pose2 pose = pose_of({shift.x, shift.y, heading});
  for (const mapping::SurfacePoint& wall : walls) {
    const mapping::SurfacePoint at = transformed(pose, wall);
    for (std::size_t k = 0; k < borders_.size(); ++k) {
      const Border& border = borders_[k];
      if (-dot(at.normal, border.outward) < kAlike) continue;  // it looks to where the robot is
      const double along = dot(at.at - border.side.a, border.side.b - border.side.a) / border.length;
      if (along < -kBeyond || along > border.length + kBeyond) continue;
      const double outside = dot(border.outward, at.at) - border.offset;
      const double place = (outside + kInside) / kBin;
      if (place < 0.0 || place >= static_cast<double>(bins)) continue;
      result.walls[k][static_cast<std::size_t>(place)] += static_cast<float>(kPerWall);
    }
  }
  smooth(result);
  return result;
}

/// Borders are not drawn to a bin: each point counts at the distances about its own, too.
void MarkAlignment::smooth(Histograms& histograms) const {
  constexpr int kWide = 4;  // bins to each side
  std::array<float, kWide + 1> weights{};
  for (int i = 0; i <= kWide; ++i)
    weights[static_cast<std::size_t>(i)] = static_cast<float>(gauss(i * kBin, params_.wall_sigma));
  for (std::vector<float>& bins : histograms.walls) {
    const std::vector<float> sharp = bins;
    const int count = static_cast<int>(sharp.size());
    for (int bin = 0; bin < count; ++bin) {
      float sum = 0.0F;
      for (int i = std::max(-kWide, -bin); i <= kWide && bin + i < count; ++i)
        sum += weights[static_cast<std::size_t>(std::abs(i))] * sharp[static_cast<std::size_t>(bin + i)];
      bins[static_cast<std::size_t>(bin)] = sum;
    }
  }
}

/// [m] of wall so far outside the border, if all of it lay shifted by that.
double MarkAlignment::score(const Histograms& histograms, Point2 shift, double gap) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    const auto& bins = histograms.walls[k];
    const double place = (gap - dot(borders_[k].outward, shift) + kInside) / kBin - 0.5;
    const double before = std::floor(place);
    if (before < 0.0 || before + 1.0 >= static_cast<double>(bins.size())) continue;
    const auto bin = static_cast<std::size_t>(before);
    const double share = place - before;
    const double met = (1.0 - share) * static_cast<double>(bins[bin]) + share * static_cast<double>(bins[bin + 1]);
    sum += met;
  }
  return sum;
}

/// [m] of wall: what speaks against a place that is far from what the robot was told.
double MarkAlignment::unlikely(double x, double y, double heading) const {
  const double position = std::hypot(x, y) / std::max(1e-3, params_.start_position);
  const double turn = heading / std::max(1e-4, params_.start_heading * kDegree);
  return 0.5 * kTold * (position * position + turn * turn);
}

void MarkAlignment::search(std::span<const mapping::SurfacePoint> walls, std::vector<Place>& places) const {
  const double turns = kSearched * params_.start_heading * kDegree;
  const double shifts = kSearched * params_.start_position;
  for (double heading = -std::ceil(turns / kTurn) * kTurn; heading <= turns + 1e-9; heading += kTurn) {
    const Histograms seen = histograms(walls, heading, {});
    for (double x = -shifts; x <= shifts + 1e-9; x += kShift) {
      for (double y = -shifts; y <= shifts + 1e-9; y += kShift) {
        Place best{x, y, heading, 0.0, -1e9};
        for (double gap = kLeastGap; gap <= params_.wall_reach - 0.2; gap += kBin) {
          const double value = score(seen, {x, y}, gap) - unlikely(x, y, heading);
          if (value > best.score + 1e-12) best = {x, y, heading, gap, value};
        }
        places.push_back(best);
      }
    }
  }
}

MarkAlignment::Place MarkAlignment::refined(std::span<const mapping::SurfacePoint> walls, Place place) const {
  for (double step = 1.0; step > 0.1; step *= 0.5) {
    for (int round = 0; round < 3; ++round) {
      const Place before = place;
      for (int turn = -1; turn <= 1; ++turn) {
        const double heading = before.heading + turn * 0.5 * step * kTurn;
        const Histograms seen = histograms(walls, heading, {before.x, before.y});
        for (int i = -2; i <= 2; ++i) {
          for (int j = -2; j <= 2; ++j) {
            for (int k = -1; k <= 1; ++k) {
              const Point2 more{0.25 * step * kShift * i, 0.25 * step * kShift * j};
              const double gap = before.gap + 0.5 * step * kBin * k;
              const double value = score(seen, more, gap) - unlikely(before.x + more.x, before.y + more.y, heading);
              if (value > place.score + 1e-9) place = {before.x + more.x, before.y + more.y, heading, gap, value};
            }
          }
        }
      }
      if (place.score <= before.score) break;
    }
  }
  return place;
}

Eigen::Matrix4d MarkAlignment::information(std::span<const mapping::SurfacePoint> walls, const Place& place) const {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  const double position = std::max(1e-3, params_.start_position);
  const double turn = std::max(1e-4, params_.start_heading * kDegree);
  sum(0, 0) = sum(1, 1) = 1.0 / (position * position);
  sum(2, 2) = 1.0 / (turn * turn);
  sum(3, 3) = 1.0 / (params_.wall_reach * params_.wall_reach);
  const Pose2 pose = pose_of(place);
  for (const Border& border : borders_) {
    double first = border.length + kBeyond;
    double last = -kBeyond;
    double metres = 0.0;
    for (const mapping::SurfacePoint& wall : walls) {
      const mapping::SurfacePoint at = transformed(pose, wall);
      const double along = dot(at.at - border.side.a, border.side.b - border.side.a) / border.length;
      const double outside = dot(border.outward, at.at) - border.offset - place.gap;
      if (-dot(at.normal, border.outward) < kAlike || along < -kBeyond || along > border.length + kBeyond ||
          std::abs(outside) > 2.0 * params_.wall_sigma)
        continue;
      first = std::min(first, along);
      last = std::max(last, along);
      metres += kPerWall;
    }
    // Both ends of what is seen of the wall: what was drawn unevenly is so all along.
    const double weight = std::min(1.0, metres / (2.0 * kEndWeight)) / (params_.wall_sigma * params_.wall_sigma);
    if (last - first < 0.5) continue;
    for (const double along : {first, last}) {
      const Point2 at = border.side.a + (along / border.length) * (border.side.b - border.side.a);
      const Point2 arm = at - start_.position();
      const Eigen::Vector4d row{border.outward.x, border.outward.y,
                                -border.outward.x * arm.y + border.outward.y * arm.x, -1.0};
      sum += weight * row * row.transpose();
    }
  }
  return sum;
}

bool MarkAlignment::align(std::span<const mapping::SurfacePoint> walls) {
  if (borders_.empty() || walls.empty() || params_.start_position <= 0.0) return false;
  std::vector<Place> places;
  search(walls, places);
  Place best =
      *std::max_element(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.score < b.score; });
  if (best.score < params_.least_wall) return false;
  best = refined(walls, best);
  const Eigen::Matrix4d covariance = information(walls, best).inverse();
  const Eigen::Matrix3d certainty = covariance.topLeftCorner<3, 3>().inverse();
  const bool has_rival = std::any_of(places.begin(), places.end(), [&](const Place& other) {
    const Eigen::Vector3d off{other.x - best.x, other.y - best.y, other.heading - best.heading};
    return other.score * params_.distinct > best.score && off.dot(certainty * off) > kOtherPlace * kOtherPlace;
  });
  if (has_rival) return false;
  is_aligned_ = true;
  covariance_ = covariance.topLeftCorner<3, 3>();
  const Pose2 found = pose_of(best);
  const Pose2 moved = found * inverse(site_from_survey_);
  // Every change draws the map anew.
  const bool matters = std::any_of(borders_.begin(), borders_.end(), [&](const Border& border) {
    return distance(moved * border.side.a, border.side.a) > kMatters;
  });
  if (matters) site_from_survey_ = found;
  return matters;
}

double MarkAlignment::margin_at(Point2 site) const {
  const Point2 arm = site - start_.position();
  // The displacement of a mark by (x, y) + heading * (normal of the way to it); the worse direction.
  Eigen::Matrix<double, 2, 3> rows;
  rows << 1.0, 0.0, -arm.y, 0.0, 1.0, arm.x;
  const Eigen::Matrix2d spread = rows * covariance_ * rows.transpose();
  const double half = 0.5 * (spread(0, 0) + spread(1, 1));
  const double root = std::sqrt(std::max(0.0, half * half - spread.determinant()));
  return std::max(0.0, params_.sigmas * std::sqrt(std::max(0.0, half + root)) - params_.free);
}

}  // namespace docent::planning
