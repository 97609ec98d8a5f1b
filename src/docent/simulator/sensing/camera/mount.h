#pragma once

#include "docent/base/time.h"

namespace docent::simulator {

/// How a camera in the hall looks, or shall look.
struct MountView {
  double pan = 0.0;            ///< [rad] from the world's x axis, to the left
  double tilt = -0.3;          ///< [rad] upwards
  double field_of_view = 1.0;  ///< [rad] across
};

/// What a mount of the market does.
struct MountParams {
  double pan_speed = 1.4;    ///< [rad/s]
  double tilt_speed = 1.0;   ///< [rad/s]
  double zoom_speed = 0.35;  ///< [rad/s] of the field of view
  double narrowest = 0.12;   ///< [rad]
  double widest = 1.2;       ///< [rad]
  double lowest = -1.55;     ///< [rad]
  double highest = 0.35;     ///< [rad]
};

/// A pan-tilt-zoom mount: it turns towards the view that it was told, as fast as it can, the shorter way round.
class Mount {
 public:
  explicit Mount(const MountParams& params = {}) : params_{params} {}
  /// Values beyond its ends are taken for the ends.
  void command(const MountView& wanted);
  void step(double dt);  ///< [s]
  [[nodiscard]] const MountView& view() const { return view_; }

 private:
  MountParams params_;
  MountView view_;
  MountView wanted_;
};

}  // namespace docent::simulator
