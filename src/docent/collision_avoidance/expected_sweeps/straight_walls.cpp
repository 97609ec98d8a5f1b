#include "docent/collision_avoidance/expected_sweeps/straight_walls.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"

namespace docent::collision_avoidance {
namespace {

constexpr int kSteps = 6;             // of Gauss-Newton
constexpr double kLeastSlope = 0.05;  // of 1/m: a wall 20 m away, seen at a right angle

/// A straight wall, as ranges that are too long by an offset have it: r(b) = 1 / (n . u(b)) + offset.
struct Piece {
  Eigen::Vector2d normal{0.0, 0.0};  ///< [1/m] towards the wall's foot, and as long as that is near
  double offset = 0.0;               ///< [m]
  double error = 0.0;                ///< [m] of it, standard deviation
  double chi2 = 0.0;                 ///< a sample
  bool fits = false;
};

struct Run {
  std::size_t first;
  std::size_t end;
};

class Fitter {
 public:
  Fitter(const SweepView& view, const StraightWallsParams& params) : view_{view}, params_{params} {}

  /// Pieces of all runs of neighbours, and for each its samples.
  void fit_all() {
    for (std::size_t first = 0; first < view_.ranges.size();) {
      std::size_t end = first;
      while (end < view_.ranges.size() && view_.met(end) && (end == first || is_next(end))) ++end;
      split({first, end});
      first = std::max(end, first + 1);
    }
  }
  struct Found {
    Piece piece;
    int samples;
  };
  std::vector<Found> found;

 private:
  [[nodiscard]] double range(std::size_t i) const { return static_cast<double>(view_.ranges[i]); }
  [[nodiscard]] bool is_next(std::size_t i) const {
    return std::abs(range(i) - range(i - 1)) <= spacing_of(range(i), range(i - 1), view_.bearing_step);
  }
  [[nodiscard]] double slant(std::size_t i, const Run& run) const {
    const std::size_t before = i > run.first ? i - 1 : i;
    const std::size_t after = i + 1 < run.end ? i + 1 : i;
    return std::abs(range(after) - range(before)) / static_cast<double>(std::max<std::size_t>(1, after - before));
  }

  void split(const Run& run) {
    const std::size_t count = run.end - run.first;
    if (static_cast<int>(count) < params_.least_samples) return;
    if (static_cast<double>(count - 1) * view_.bearing_step < params_.least_angle) return;
    if (norm(view_.place(run.end - 1) - view_.place(run.first)) < params_.least_length) return;
    const Piece piece = fit(run);
    if (piece.fits) {
      found.push_back({piece, static_cast<int>(count)});
      return;
    }
    const std::size_t corner = farthest_from_chord(run);
    split({run.first, corner + 1});
    split({corner, run.end});
  }

  [[nodiscard]] std::size_t farthest_from_chord(const Run& run) const {
    const Point2 from = view_.place(run.first);
    const Point2 chord = view_.place(run.end - 1) - from;
    std::size_t farthest = run.first + 1;
    double most = -1.0;
    for (std::size_t i = run.first + 1; i + 1 < run.end; ++i) {
      const Point2 at = view_.place(i) - from;
      const double off = std::abs(chord.x * at.y - chord.y * at.x);
      if (off > most) {
        most = off;
        farthest = i;
      }
    }
    return farthest;
  }

  [[nodiscard]] Piece fit(const Run& run) const {
    Piece piece;
    // Without an offset 1 / r is linear in the normal.
    Eigen::Matrix2d a = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (std::size_t i = run.first; i < run.end; ++i) {
      const Eigen::Vector2d u{view_.rays->units[i].x, view_.rays->units[i].y};
      const double weight = range(i) * range(i);
      a += weight * u * u.transpose();
      b += weight * u / range(i);
    }
    piece.normal = a.ldlt().solve(b);
    for (int step = 0; step < kSteps; ++step) {
      Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
      piece.chi2 = 0.0;
      double worst = 0.0;
      for (std::size_t i = run.first; i < run.end; ++i) {
        const Eigen::Vector2d u{view_.rays->units[i].x, view_.rays->units[i].y};
        const double slope = piece.normal.dot(u);
        if (slope < kLeastSlope) return piece;
        const double distance = 1.0 / slope;
        const double error = range(i) - distance - piece.offset;
        const double slanted = params_.per_slant * slant(i, run);
        const double noise = params_.noise + params_.per_metre * range(i);
        const double weight = 1.0 / (noise * noise + slanted * slanted);
        const Eigen::Vector3d j{-distance * distance * u.x(), -distance * distance * u.y(), 1.0};
        information += weight * j * j.transpose();
        gradient += weight * error * j;
        piece.chi2 += weight * error * error;
        worst = std::max(worst, std::abs(error) / (params_.off + params_.off_per_metre * range(i) + 2.0 * slanted));
      }
      piece.fits = worst <= 1.0;
      const Eigen::LDLT<Eigen::Matrix3d> solver{information};
      const Eigen::Vector3d change = solver.solve(gradient);
      const double excess = std::max(1.0, piece.chi2 / static_cast<double>(run.end - run.first - 3));
      piece.error = std::sqrt(std::max(0.0, solver.solve(Eigen::Vector3d::UnitZ()).z()) * excess);
      if (step + 1 == kSteps) break;
      piece.normal += change.head<2>();
      piece.offset += change.z();
      if (!(std::abs(piece.offset) <= 2.0 * params_.most_offset)) break;
    }
    piece.fits = piece.fits && std::abs(piece.offset) <= params_.most_offset;
    return piece;
  }

  const SweepView& view_;
  const StraightWallsParams& params_;
};

double bearing_of(const Piece& piece) { return std::atan2(piece.normal.y(), piece.normal.x()); }

}  // namespace

std::vector<WallPiece> straight_walls_of(const SweepView& view, const StraightWallsParams& params) {
  Fitter fitter{view, params};
  fitter.fit_all();
  std::vector<WallPiece> pieces;
  for (const auto& [piece, samples] : fitter.found)
    if (piece.error <= params.tells) pieces.push_back({bearing_of(piece), piece.offset, piece.error, samples});
  return pieces;
}

void StraightWallsCheck::gather(const SweepView& view) {
  const double heading = view.odom_from_sensor.theta.radians();
  std::array<Direction, kDirections> news{};
  for (const WallPiece& piece : straight_walls_of(view, params_.walls)) {
    const double turns = (heading + piece.bearing) / (2.0 * std::numbers::pi);
    const double part = (turns - std::floor(turns)) * static_cast<double>(kDirections);
    Direction& direction = news[static_cast<std::size_t>(std::lround(part)) % kDirections];
    const double weight = 1.0 / (piece.error * piece.error);
    direction.weight += weight;
    direction.sum += weight * piece.offset;
  }
  const double keeps = fresh_way_ > params_.longest ? 0.5 : 1.0;
  if (keeps < 1.0) fresh_way_ = 0.0;
  const double most = 1.0 / (params_.remembers * params_.remembers);
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double kept = std::min(keeps, most / std::max(most, directions_[i].weight));
    directions_[i].weight = kept * directions_[i].weight + news[i].weight;
    directions_[i].sum = kept * directions_[i].sum + news[i].sum;
  }
}

StraightWallsCheck::Finding StraightWallsCheck::judge() {
  const double least_variance = params_.least_error * params_.least_error;
  const auto variance = [&](const Direction& one) { return 1.0 / one.weight + least_variance; };
  double weights = 0.0, sum = 0.0;
  int count = 0;
  for (const Direction& one : directions_) {
    if (one.weight == 0.0 || 1.0 / one.weight > params_.counts * params_.counts) continue;
    ++count;
    weights += 1.0 / variance(one);
    sum += one.sum / one.weight / variance(one);
  }
  if (count < params_.least_directions) return Finding::nothing;
  offset_ = sum / weights;
  double agreeing = 0.0;
  int agree = 0;
  for (const Direction& one : directions_) {
    if (one.weight == 0.0 || 1.0 / one.weight > params_.counts * params_.counts) continue;
    if (std::abs(one.sum / one.weight - offset_) > params_.agrees + std::sqrt(variance(one))) continue;
    agreeing += 1.0 / variance(one);
    ++agree;
  }
  if (agree < params_.least_directions || agreeing < params_.share * weights) return Finding::nothing;
  if (std::abs(offset_) <= params_.in_order) return Finding::in_order;
  const bool is_sure =
      std::abs(offset_) >= params_.least_offset && std::abs(offset_) >= params_.sure / std::sqrt(weights);
  return is_sure && way_ >= params_.elsewhere ? Finding::offset : Finding::nothing;
}

StraightWallsCheck::Finding StraightWallsCheck::add(const SweepView& view) {
  if (was_in_order_) return Finding::in_order;
  const Pose2 moved = inverse(last_) * view.odom_from_sensor;
  const double way = norm(moved.position());
  const bool is_news = way >= params_.news_way || std::abs(moved.theta.radians()) >= params_.news_turn ||
                       view.stamp - last_stamp_ >= seconds(params_.news_time);
  if (has_last_ && !is_news) return Finding::nothing;
  way_ += has_last_ ? way : 0.0;
  fresh_way_ += has_last_ ? way : 0.0;
  last_ = view.odom_from_sensor;
  last_stamp_ = view.stamp;
  has_last_ = true;
  gather(view);
  const Finding found = judge();
  was_in_order_ = was_in_order_ || found == Finding::in_order;
  return found;
}

}  // namespace docent::collision_avoidance
