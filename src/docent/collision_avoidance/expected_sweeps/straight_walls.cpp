#include "docent/collision_avoidance/expected_sweeps/straight_walls.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

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

std::optional<StraightWalls> straight_walls_of(const SweepView& view, const StraightWallsParams& params) {
  Fitter fitter{view, params};
  fitter.fit_all();
  std::erase_if(fitter.found, [&](const Fitter::Found& one) { return !(one.piece.error <= params.tells); });
  StraightWalls walls;
  double weights = 0.0;
  for (const auto& [piece, samples] : fitter.found) {
    ++walls.pieces;
    walls.samples += samples;
    const double weight = 1.0 / (piece.error * piece.error);
    weights += weight;
    walls.offset += weight * piece.offset;
  }
  if (walls.pieces < params.least_pieces || walls.samples < params.least_of_all) return std::nullopt;
  walls.offset /= weights;
  walls.error = std::sqrt(1.0 / weights);
  int agreeing = 0;
  double widest = 0.0;
  const Piece* first = nullptr;
  for (const auto& [piece, samples] : fitter.found) {
    if (std::abs(piece.offset - walls.offset) > params.agrees + 2.0 * piece.error) continue;
    agreeing += samples;
    if (first == nullptr) first = &piece;
    widest = std::max(widest, std::abs(Angle::radians(bearing_of(piece) - bearing_of(*first)).radians()));
  }
  walls.agree = agreeing >= params.share * walls.samples && widest >= params.other;
  return walls;
}

StraightWallsCheck::Finding StraightWallsCheck::add(const SweepView& view) {
  constexpr std::size_t kMost = 64;  // sweeps that are remembered
  const auto walls = straight_walls_of(view, params_);
  if (!walls || !walls->agree) return Finding::nothing;
  if (std::abs(walls->offset) <= params_.in_order) {
    seen_.clear();
    was_in_order_ = true;
    return Finding::in_order;
  }
  if (std::abs(walls->offset) < params_.least_offset || std::abs(walls->offset) < params_.sure * walls->error)
    return Finding::nothing;
  const Point2 here = view.odom_from_sensor.position();
  int alike = 1;
  bool is_from_elsewhere = walls->pieces >= params_.many_pieces && !was_in_order_;
  const double far = was_in_order_ ? params_.far_elsewhere : params_.elsewhere;
  for (const Seen& one : seen_) {
    if (std::abs(one.offset - walls->offset) > params_.same) continue;
    ++alike;
    is_from_elsewhere = is_from_elsewhere || distance(one.in_odom, here) >= far;
  }
  if (seen_.size() >= kMost) seen_.erase(seen_.begin());
  seen_.push_back({here, walls->offset});
  if (alike < (was_in_order_ ? params_.more_sweeps : params_.sweeps) || !is_from_elsewhere) return Finding::nothing;
  offset_ = walls->offset;
  return Finding::offset;
}

}  // namespace docent::collision_avoidance
