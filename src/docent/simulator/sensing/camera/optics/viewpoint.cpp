#include "docent/simulator/sensing/camera/optics/viewpoint.h"

#include <array>
#include <cmath>

namespace docent::simulator {
namespace {

using Axis = std::array<double, 3>;

/// About one of the axes of the frame: 0, 1, 2.
Axis turned(const Axis& v, std::size_t axis, double angle) {
  const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
  const double c = std::cos(angle), s = std::sin(angle);
  Axis result = v;
  result[a] = c * v[a] - s * v[b];
  result[b] = s * v[a] + c * v[b];
  return result;
}

Vec3 floats(const Axis& v) { return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])}; }

struct Axes {
  Axis right{0.0, -1.0, 0.0}, down{0.0, 0.0, -1.0}, ahead{1.0, 0.0, 0.0};
  void turn(std::size_t axis, double angle) {
    for (Axis* each : {&right, &down, &ahead}) *each = turned(*each, axis, angle);
  }
};

}  // namespace

Viewpoint viewpoint_at(Vec3 eye, double pan, double tilt) {
  Axes axes;
  axes.turn(1, -tilt);
  axes.turn(2, pan);
  return {eye, floats(axes.right), floats(axes.down), floats(axes.ahead)};
}

Viewpoint viewpoint_of(const CameraMount& mount, const Pose2& world_from_base, const Lean& lean) {
  Axes axes;
  axes.turn(0, mount.roll);  // it still looks along x
  axes.turn(1, -mount.tilt);
  axes.turn(2, mount.pan);
  Axis eye{mount.x, mount.y, mount.z};
  const auto lean_over = [&](std::size_t axis, double angle) {
    axes.turn(axis, angle);
    eye = turned(eye, axis, angle);
  };
  lean_over(0, lean.roll);
  lean_over(1, lean.pitch);
  lean_over(2, world_from_base.theta.radians());
  return {{static_cast<float>(eye[0] + world_from_base.x), static_cast<float>(eye[1] + world_from_base.y),
           static_cast<float>(eye[2])},
          floats(axes.right),
          floats(axes.down),
          floats(axes.ahead)};
}

}  // namespace docent::simulator
