#include "docent/vision/pan_tilt_zoom.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::vision {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double kNearest = 0.3;  // [m] straight below the camera no pan is better than another

}  // namespace

Result<void> PanTiltZoomParams::validate() const {
  if (!(shown_m > 0.5 && shown_m <= 50.0)) return fail("shown_m must be 0.5 to 50");
  if (!(height_m >= 0.0 && height_m <= 3.0)) return fail("height_m must be 0 to 3");
  if (!(deviations >= 0.0 && deviations <= 5.0)) return fail("deviations must be 0 to 5");
  if (!(narrowest > 0.5 && narrowest <= widest && widest < 170.0))
    return fail("narrowest and widest must be 0.5 to 170, and in order");
  if (!(lowest >= -90.0 && lowest < 0.0)) return fail("lowest must be -90 to 0");
  if (!(dead_share >= 0.0 && dead_share < 0.5)) return fail("dead_share must be 0 to 0.5");
  if (!(dead_zoom >= 0.0 && dead_zoom < 1.0)) return fail("dead_zoom must be 0 to 1");
  if (!(lost_m > 0.0)) return fail("lost_m must be above 0");
  return {};
}

PanTiltZoom::PanTiltZoom(CameraPlace place, Point2 overview, const PanTiltZoomParams& params)
    : place_{place}, overview_{overview}, params_{params}, view_{towards(overview, 1e3)} {}

View PanTiltZoom::towards(Point2 point, double shown) const {
  const Point2 offset = point - place_.position;
  const double along = norm(offset);
  const double down = place_.height - params_.height_m;
  const double away = std::max(kNearest, std::hypot(along, down));
  View view;
  view.pan = along > kNearest ? std::atan2(offset.y, offset.x) : view_.pan;
  view.tilt = std::max(radians(params_.lowest), -std::atan2(down, std::max(along, 1e-3)));
  view.field_of_view =
      std::clamp(2.0 * std::atan(0.5 * shown / away), radians(params_.narrowest), radians(params_.widest));
  return view;
}

bool PanTiltZoom::is_worth_a_move(const View& wanted) const {
  const double dead = params_.dead_share * view_.field_of_view;
  const double pan = (Angle::radians(wanted.pan) - Angle::radians(view_.pan)).radians() * std::cos(wanted.tilt);
  const double zoom = wanted.field_of_view / view_.field_of_view;
  return std::abs(pan) > dead || std::abs(wanted.tilt - view_.tilt) > dead || std::abs(zoom - 1.0) > params_.dead_zoom;
}

const View& PanTiltZoom::follow(std::optional<Point2> robot, double deviation) {
  const bool is_lost = !robot || !(deviation <= params_.lost_m);
  const View wanted =
      is_lost ? towards(overview_, 1e3) : towards(*robot, params_.shown_m + 2.0 * params_.deviations * deviation);
  if (is_worth_a_move(wanted)) view_ = wanted;
  return view_;
}

}  // namespace docent::vision
