#include "docent/simulator/sensing/camera/mount.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::simulator {
namespace {

double moved(double from, double way, double most) { return from + std::clamp(way, -most, most); }

}  // namespace

void Mount::command(const MountView& wanted) {
  wanted_.pan = wanted.pan;
  wanted_.tilt = std::clamp(wanted.tilt, params_.lowest, params_.highest);
  wanted_.field_of_view = std::clamp(wanted.field_of_view, params_.narrowest, params_.widest);
}

void Mount::step(double dt) {
  const double round = std::remainder(wanted_.pan - view_.pan, 2.0 * std::numbers::pi);
  view_.pan = moved(view_.pan, round, params_.pan_speed * dt);
  view_.tilt = moved(view_.tilt, wanted_.tilt - view_.tilt, params_.tilt_speed * dt);
  view_.field_of_view =
      moved(view_.field_of_view, wanted_.field_of_view - view_.field_of_view, params_.zoom_speed * dt);
}

}  // namespace docent::simulator
