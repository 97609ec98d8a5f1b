#include "docent/vision/marks/dock_line.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::vision {
namespace {

constexpr Duration kHistory = std::chrono::seconds{3};         // of odometry: no picture is later
constexpr Duration kLongest = std::chrono::milliseconds{250};  // between two of it: what lies between is known

/// Columns: the camera's x, y, z in the base frame.
Eigen::Matrix3d base_from_camera(double pan, double down, double roll) {
  const Eigen::Vector3d level_right{0.0, -1.0, 0.0};
  const Eigen::Vector3d level_down{-std::sin(down), 0.0, -std::cos(down)};
  Eigen::Matrix3d turned;
  turned.col(0) = std::cos(roll) * level_right + std::sin(roll) * level_down;
  turned.col(1) = std::cos(roll) * level_down - std::sin(roll) * level_right;
  turned.col(2) = Eigen::Vector3d{std::cos(down), 0.0, -std::sin(down)};
  return Eigen::AngleAxisd{pan, Eigen::Vector3d::UnitZ()} * turned;
}

}  // namespace

Result<void> DockLineParams::validate() const {
  if (!(tag >= 0)) return fail("dock line: tag must be >= 0");
  if (!(side > 0.0 && pixel > 0.0 && most_off > 0.0)) return fail("dock line: side, pixel and most_off must be > 0");
  if (!(mount >= 0.0 && height_sigma >= 0.0 && odometry >= 0.0 && apart >= 0.0))
    return fail("dock line: mount, height_sigma, odometry and apart must be >= 0");
  if (!(pictures >= 2)) return fail("dock line: pictures must be >= 2");
  if (!(sure > 0.0 && sure_heading > 0.0 && independent > 0.0 && alike >= 0.0 && least_pixels > 0.0))
    return fail("dock line: sure, sure_heading, independent and least_pixels must be > 0, alike >= 0");
  return {};
}

DockLine::DockLine(const DockCamera& camera, const DockLineParams& params) : camera_{camera}, params_{params} {}

void DockLine::forget() {
  views_.clear();
  last_.reset();
  estimate_.reset();
}

void DockLine::expect(const Pose2& odom_from_tag, double place_sigma, double heading_sigma) {
  expected_ = Expected{odom_from_tag, place_sigma, heading_sigma};
}

void DockLine::add_odometry(Time stamp, const Pose2& odom_from_base) {
  if (!odometry_.empty()) {
    if (stamp <= odometry_.back().first) return;
    const Pose2 step = inverse(odometry_.back().second) * odom_from_base;
    driven_ += norm(step.position()) + std::abs(step.theta.radians());
  }
  odometry_.emplace_back(stamp, odom_from_base);
  while (odometry_.front().first < stamp - kHistory) odometry_.pop_front();
}

std::optional<Pose2> DockLine::odometry_at(Time stamp) const {
  const auto after = std::lower_bound(odometry_.begin(), odometry_.end(), stamp,
                                      [](const auto& entry, Time time) { return entry.first < time; });
  if (after == odometry_.end()) return std::nullopt;
  if (after->first == stamp) return after->second;
  if (after == odometry_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  if (after->first - before->first > kLongest) return std::nullopt;
  const double part = to_seconds(stamp - before->first) / to_seconds(after->first - before->first);
  const Pose2 step = inverse(before->second) * after->second;
  return before->second * Pose2{part * step.x, part * step.y, Angle::radians(part * step.theta.radians())};
}

bool DockLine::add_tags(Time stamp, const std::vector<SeenTag>& tags) {
  const auto odom_from_base = odometry_at(stamp);
  if (!odom_from_base) return false;
  for (const SeenTag& tag : tags) {
    if (tag.id != params_.tag) continue;
    double shortest = 1e9;
    for (std::size_t i = 0; i < 4; ++i) {
      const Pixel a = tag.corners[i], b = tag.corners[(i + 1) % 4];
      shortest = std::min(shortest, std::hypot(a.column - b.column, a.row - b.row));
    }
    if (shortest < params_.least_pixels) continue;
    const View view{*odom_from_base, unit(odom_from_base->theta), tag.corners, driven_};
    keep(view);
    estimate(view, tag);
    return true;
  }
  return false;
}

/// Pictures from much the same place replace each other; of too many the oldest goes.
void DockLine::keep(const View& view) {
  if (!views_.empty() && view.driven - views_.back().driven < params_.apart) views_.pop_back();
  views_.push_back(view);
  if (views_.size() > static_cast<std::size_t>(params_.pictures)) views_.erase(views_.begin());
}

Eigen::Matrix3d DockLine::camera_from_base(const Unknowns& at) const {
  return base_from_camera(camera_.pan.radians() + at(3), camera_.down.radians() + at(4), at(5)).transpose();
}

bool DockLine::residuals(const Unknowns& at, const Eigen::Matrix3d& turn, const View& view,
                         Eigen::Matrix<double, 8, 1>& off) const {
  const double half = 0.5 * params_.side, height = params_.height + at(6);
  const Point2 right{-std::sin(at(2)), std::cos(at(2))};  // of who looks at the tag
  constexpr std::array<std::array<double, 2>, 4> kCorners{{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Point2 odom = Point2{at(0), at(1)} + kCorners[i][0] * half * right;
    const Point2 away{odom.x - view.odom_from_base.x, odom.y - view.odom_from_base.y};
    const Point2 base{view.ahead.x * away.x + view.ahead.y * away.y, view.ahead.x * away.y - view.ahead.y * away.x};
    const Eigen::Vector3d seen =
        turn * Eigen::Vector3d{base.x - camera_.x, base.y - camera_.y, height + kCorners[i][1] * half - camera_.z};
    if (!(seen.z() > 0.02)) return false;
    const Pixel pixel = camera_.lens.pixel_of(seen);
    off(2 * static_cast<int>(i)) = pixel.column - view.corners[i].column;
    off(2 * static_cast<int>(i) + 1) = pixel.row - view.corners[i].row;
  }
  return true;
}

/// Cost at a place, and what its slopes say. nullopt: a tag would stand behind the camera.
std::optional<double> DockLine::normal_equations(const Unknowns& at, Eigen::Matrix<double, 7, 7>* information,
                                                 Unknowns* slope) const {
  constexpr double kStep = 1e-6, kFirm = 1e-4;
  const double mount = std::max(kFirm, params_.mount * std::numbers::pi / 180.0);
  Unknowns priors = Unknowns::Zero();
  priors.segment<3>(3).setConstant(1.0 / (mount * mount));
  priors(6) = 1.0 / std::pow(std::max(kFirm, params_.height_sigma), 2);
  double cost = at.cwiseProduct(priors).dot(at);
  if (information != nullptr) *information = priors.asDiagonal();
  if (slope != nullptr) *slope = priors.cwiseProduct(at);
  if (expected_) {
    Unknowns off = Unknowns::Zero(), inverse_squares = Unknowns::Zero();
    off(0) = at(0) - expected_->odom_from_tag.x;
    off(1) = at(1) - expected_->odom_from_tag.y;
    off(2) = (Angle::radians(at(2)) - expected_->odom_from_tag.theta).radians();
    inverse_squares.head<2>().setConstant(1.0 / std::pow(expected_->place_sigma, 2));
    inverse_squares(2) = 1.0 / std::pow(expected_->heading_sigma, 2);
    cost += off.cwiseProduct(inverse_squares).dot(off);
    if (information != nullptr) *information += inverse_squares.asDiagonal();
    if (slope != nullptr) *slope += inverse_squares.cwiseProduct(off);
  }
  // Lens and mount move the corners of all pictures alike: many pictures are not many measurements.
  const double shared = std::max(1.0, static_cast<double>(views_.size()) / params_.independent);
  const Eigen::Matrix3d turn = camera_from_base(at);
  std::array<Unknowns, 7> steps;
  std::array<Eigen::Matrix3d, 7> turns;
  for (int k = 0; k < 7; ++k) {
    const auto i = static_cast<std::size_t>(k);
    steps[i] = at;
    steps[i](k) += kStep;
    turns[i] = camera_from_base(steps[i]);
  }
  for (const View& view : views_) {
    Eigen::Matrix<double, 8, 1> off, beside;
    if (!residuals(at, turn, view, off)) return std::nullopt;
    // What odometry has lost since then moves the tag in the picture by an angle.
    const double drift = camera_.lens.focal * params_.odometry * (driven_ - view.driven);
    const double variance = (params_.pixel * params_.pixel + drift * drift) * shared;
    const double most = params_.most_off * params_.most_off;
    const double square = off.squaredNorm() / (8.0 * variance);
    const double weight = 1.0 / (variance * (1.0 + square / most));  // Cauchy
    cost += 8.0 * most * std::log1p(square / most);
    if (information == nullptr) continue;
    Eigen::Matrix<double, 8, 7> slopes;
    for (int k = 0; k < 7; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!residuals(steps[i], turns[i], view, beside)) return std::nullopt;
      slopes.col(k) = (beside - off) / kStep;
    }
    *information += weight * slopes.transpose() * slopes;
    *slope += weight * slopes.transpose() * off;
  }
  return cost;
}

std::optional<DockLine::Fit> DockLine::fit(Unknowns start) const {
  constexpr int kRounds = 20;
  Fit best;
  best.at = start;
  Unknowns slope;
  auto cost = normal_equations(best.at, &best.information, &slope);
  if (!cost) return std::nullopt;
  double damping = 1e-4;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix<double, 7, 7> damped = best.information;
    damped.diagonal() *= 1.0 + damping;
    const Unknowns step = damped.ldlt().solve(-slope);
    const Unknowns next = best.at + step;
    const auto next_cost = normal_equations(next, nullptr, nullptr);
    if (next_cost && *next_cost < *cost) {
      best.at = next;
      cost = normal_equations(best.at, &best.information, &slope);
      damping = std::max(1e-9, 0.2 * damping);
      if (step.norm() < 1e-6) break;
    } else {
      damping *= 10.0;
      if (damping > 1e8) break;
    }
  }
  best.cost = *cost;
  return best;
}

std::vector<DockLine::Fit> DockLine::fits_about(const View& view, const SeenTag& tag) const {
  const Eigen::Matrix3d turn = base_from_camera(camera_.pan.radians(), camera_.down.radians(), 0.0);
  std::vector<Fit> fits;
  const auto add = [&](const Unknowns& start) {
    const auto found = fit(start);
    if (!found) return;
    // The same minimum twice is one.
    const auto is_same = [&](const Fit& other) {
      return std::abs(Angle::radians(other.at(2) - found->at(2)).radians()) < 0.01;
    };
    if (std::none_of(fits.begin(), fits.end(), is_same)) fits.push_back(*found);
  };
  if (last_) add(*last_);
  for (const TagPose& pose : tag_poses(tag, camera_.lens, params_.side)) {
    const Eigen::Vector3d place = turn * pose.position + Eigen::Vector3d{camera_.x, camera_.y, camera_.z};
    const Eigen::Vector3d normal = turn * pose.camera_from_tag.col(2);
    const Point2 odom = view.odom_from_base * Point2{place.x(), place.y()};
    Unknowns start = Unknowns::Zero();
    start(0) = odom.x;
    start(1) = odom.y;
    start(2) = (view.odom_from_base.theta + Angle::radians(std::atan2(normal.y(), normal.x()))).radians();
    add(start);
    // And its mirror about the line of sight, as a vertical plane has it.
    const double sight = std::atan2(view.odom_from_base.y - odom.y, view.odom_from_base.x - odom.x);
    start(2) = 2.0 * sight - start(2);
    add(start);
  }
  return fits;
}

void DockLine::estimate(const View& view, const SeenTag& tag) {
  const std::vector<Fit> fits = fits_about(view, tag);
  if (fits.empty()) return;
  const bool was_sure = estimate_ && estimate_->is_sure;
  const auto by_cost = [](const Fit& a, const Fit& b) { return a.cost < b.cost; };
  const auto turned = [&](const Fit& from, double heading) {
    return std::abs(Angle::radians(from.at(2) - heading).radians());
  };
  auto best = std::min_element(fits.begin(), fits.end(), by_cost);
  if (was_sure) {  // it goes on from where it was, and flips to no other plane
    const auto near = std::min_element(fits.begin(), fits.end(), [&](const Fit& a, const Fit& b) {
      return turned(a, (*last_)(2)) < turned(b, (*last_)(2));
    });
    if (near->cost - best->cost > params_.sure) {  // what was kept does not fit together
      forget();
      views_.push_back(view);
      return;
    }
    best = near;
  }
  const double alike = params_.alike * std::numbers::pi / 180.0;
  double next = best->cost + 1e9;
  for (const Fit& other : fits)
    if (turned(other, best->at(2)) > alike) next = std::min(next, other.cost);
  last_ = best->at;
  const Eigen::Matrix<double, 7, 7> covariance = best->information.inverse();
  const double heading_sigma = std::sqrt(std::max(0.0, covariance(2, 2)));
  const bool is_sure =
      next - best->cost > params_.sure && heading_sigma < params_.sure_heading * std::numbers::pi / 180.0;
  const Eigen::Vector2d across{-std::sin(best->at(2)), std::cos(best->at(2))};
  estimate_ = DockLineEstimate{{best->at(0), best->at(1), Angle::radians(best->at(2))},
                               std::sqrt(std::max(0.0, across.dot(covariance.topLeftCorner<2, 2>() * across))),
                               heading_sigma,
                               was_sure || is_sure,
                               Angle::radians(best->at(3))};
}

}  // namespace docent::vision
