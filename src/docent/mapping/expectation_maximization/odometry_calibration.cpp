#include "docent/mapping/expectation_maximization/odometry_calibration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace docent::mapping {
namespace {

struct Piece {
  double way = 0.0;        ///< [m], odometry's
  double turn = 0.0;       ///< [rad], odometry's, with its sign
  double all_turns = 0.0;  ///< [rad], without
  double true_way = 0.0;
  double true_turn = 0.0;
};

std::vector<Piece> pieces_of(std::span<const MappingScan> scans, std::span<const Pose2> before_from_after,
                             const PlaceParams& bounds) {
  std::vector<Piece> pieces;
  Piece piece;
  for (std::size_t i = 0; i + 1 < scans.size(); ++i) {
    const Pose2 read = inverse(scans[i].odom_from_base) * scans[i + 1].odom_from_base;
    piece.way += norm(read.position());
    piece.turn += read.theta.radians();
    piece.all_turns += std::abs(read.theta.radians());
    piece.true_way += norm(before_from_after[i].position());
    piece.true_turn += before_from_after[i].theta.radians();
    if (piece.way < bounds.way && piece.all_turns < bounds.turn) continue;
    pieces.push_back(piece);
    piece = {};
  }
  return pieces;
}

/// Variance a metre and a radian that explain the squares best; neither below a tenth of what the mean would say.
Eigen::Vector2d variances_of(const std::vector<Piece>& pieces, const Eigen::VectorXd& residuals) {
  Eigen::MatrixXd causes(residuals.size(), 2);
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    const Piece& piece = pieces[static_cast<std::size_t>(i)];
    causes.row(i) << piece.way, piece.all_turns;
  }
  const Eigen::VectorXd squares = residuals.array().square();
  const double mean = squares.sum() / std::max(causes.sum(), 1e-9);
  const Eigen::Vector2d found = causes.colPivHouseholderQr().solve(squares);
  return found.cwiseMax(0.1 * mean).cwiseMin(10.0 * mean);
}

}  // namespace

OdometryCalibration calibrate_odometry(std::span<const MappingScan> scans, std::span<const Pose2> before_from_after,
                                       const EmMapperParams& params) {
  constexpr std::size_t kFewest = 12;
  OdometryCalibration result{
      1.0, 1.0, 0.0, params.way_per_metre, params.way_per_radian, params.turn_per_metre, params.turn_per_radian};
  const std::vector<Piece> pieces = pieces_of(scans, before_from_after, params.places);
  if (pieces.size() < kFewest) return result;
  const auto count = static_cast<Eigen::Index>(pieces.size());
  Eigen::MatrixXd turn_causes(count, 2);
  Eigen::VectorXd turns(count);
  Eigen::VectorXd ways(count);
  Eigen::VectorXd true_ways(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Piece& piece = pieces[static_cast<std::size_t>(i)];
    turn_causes.row(i) << piece.turn, piece.way;
    turns[i] = piece.true_turn;
    ways[i] = piece.way;
    true_ways[i] = piece.true_way;
  }
  const Eigen::Vector2d of_turn = turn_causes.colPivHouseholderQr().solve(turns);
  result.turn_scale = std::clamp(of_turn[0], 0.7, 1.4);
  result.veer = of_turn[1];
  result.way_scale = std::clamp(ways.dot(true_ways) / std::max(ways.squaredNorm(), 1e-9), 0.7, 1.4);
  const Eigen::Vector2d turn_left = variances_of(pieces, turns - turn_causes * of_turn);
  const Eigen::Vector2d way_left = variances_of(pieces, true_ways - result.way_scale * ways);
  // Sideways a step errs as along it, and neither less than a few centimetres.
  constexpr double kLeastWay = 0.0008;    // [m2/m]
  constexpr double kLeastTurn = 0.00015;  // [rad2/m]
  result.way_per_metre = std::max(way_left[0], kLeastWay);
  result.way_per_radian = way_left[1];
  result.turn_per_metre = std::max(turn_left[0], kLeastTurn);
  result.turn_per_radian = turn_left[1];
  return result;
}

std::vector<MappingScan> with_odometry_corrected(std::span<const MappingScan> scans,
                                                 const OdometryCalibration& calibration) {
  std::vector<MappingScan> corrected(scans.begin(), scans.end());
  for (std::size_t i = 1; i < corrected.size(); ++i) {
    const Pose2 read = inverse(scans[i - 1].odom_from_base) * scans[i].odom_from_base;
    const double turn = calibration.turn_scale * read.theta.radians() + calibration.veer * norm(read.position());
    const Pose2 step{calibration.way_scale * read.x, calibration.way_scale * read.y, Angle::radians(turn)};
    corrected[i].odom_from_base = corrected[i - 1].odom_from_base * step;
  }
  return corrected;
}

}  // namespace docent::mapping
