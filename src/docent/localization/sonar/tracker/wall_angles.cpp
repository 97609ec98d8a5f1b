#include "docent/localization/sonar/tracker/wall_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::localization {
namespace {

constexpr double kEchoDeviation = 0.02;   // [m], of one echo, for the angle's deviation
constexpr double kModelDeviation = 0.01;  // [rad]: walls are not quite straight, the way is not quite known

}  // namespace

Result<void> WallAngleParams::validate() const {
  if (!(length > 0.2)) return fail("walls.length must be > 0.2");
  if (!(echoes >= 3)) return fail("walls.echoes must be >= 3");
  if (!(residual > 0.0)) return fail("walls.residual must be > 0");
  if (!(turn > 0.0)) return fail("walls.turn must be > 0");
  if (!(jump > 0.0)) return fail("walls.jump must be > 0");
  if (!(range > 0.0)) return fail("walls.range must be > 0");
  if (!(oblique > 0.0 && oblique < 60.0)) return fail("walls.oblique must be > 0 and < 60");
  return {};
}

WallAngles::WallAngles(const WallAngleParams& params, int sonars)
    : params_{params}, runs_(static_cast<std::size_t>(std::max(0, sonars))) {}

void WallAngles::forget() {
  for (auto& run : runs_) run.clear();
}

bool WallAngles::continues(const std::vector<Echo>& run, const Echo& echo) const {
  const Echo& last = run.back();
  const double way = distance(last.track_from_sonar.position(), echo.track_from_sonar.position());
  const double turn = (echo.track_from_sonar.theta - run.front().track_from_sonar.theta).radians();
  const double change = way * std::sin(params_.oblique * kDegree);
  return std::abs(turn) <= params_.turn * kDegree && std::abs(echo.range - last.range) <= params_.jump + change &&
         way < 0.7 * params_.length;
}

std::optional<WallAngle> WallAngles::add(int sonar, const Pose2& track_from_sonar, std::optional<double> range) {
  if (sonar < 0 || static_cast<std::size_t>(sonar) >= runs_.size()) return std::nullopt;
  auto& run = runs_[static_cast<std::size_t>(sonar)];
  if (!range || *range > params_.range) {
    run.clear();
    return std::nullopt;
  }
  const Echo echo{track_from_sonar, *range};
  if (!run.empty() && !continues(run, echo)) run.clear();
  // A robot that stands hears the same again and again: one echo a place is enough.
  if (!run.empty() && distance(run.back().track_from_sonar.position(), track_from_sonar.position()) < 0.05) {
    return std::nullopt;
  }
  run.push_back(echo);
  const double span = distance(run.front().track_from_sonar.position(), track_from_sonar.position());
  if (run.size() < static_cast<std::size_t>(params_.echoes) || span < params_.length) return std::nullopt;
  const auto wall = fit(run);
  if (wall) {
    run.clear();
  } else {
    run.erase(run.begin());
  }
  return wall;
}

std::optional<WallAngle> WallAngles::fit(const std::vector<Echo>& run) const {
  // normal . sonar + range = offset for all echoes; two unknowns, the start is the sonar's axis.
  double heading = run[run.size() / 2].track_from_sonar.theta.radians();
  const double axis = heading;
  const auto count = static_cast<double>(run.size());
  double squares = 0.0;
  double spread = 0.0;
  for (int pass = 0; pass < 4; ++pass) {
    const Point2 normal{std::cos(heading), std::sin(heading)};
    const Point2 along{-normal.y, normal.x};
    double mean_along = 0.0;
    double mean_offset = 0.0;
    for (const Echo& echo : run) {
      mean_along += dot(along, echo.track_from_sonar.position()) / count;
      mean_offset += (dot(normal, echo.track_from_sonar.position()) + echo.range) / count;
    }
    double both = 0.0;
    spread = squares = 0.0;
    for (const Echo& echo : run) {
      const double a = dot(along, echo.track_from_sonar.position()) - mean_along;
      const double b = dot(normal, echo.track_from_sonar.position()) + echo.range - mean_offset;
      spread += a * a;
      both += a * b;
      squares += b * b;
    }
    if (!(spread > 1e-6)) return std::nullopt;
    if (pass < 3) heading -= both / spread;
  }
  if (std::sqrt(squares / count) > params_.residual) return std::nullopt;
  if (std::abs(Angle::radians(heading - axis).radians()) > params_.oblique * kDegree) return std::nullopt;
  return WallAngle{Angle::radians(heading), std::hypot(kModelDeviation, kEchoDeviation / std::sqrt(spread))};
}

}  // namespace docent::localization
