#pragma once

#include <optional>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"

namespace docent::vision {

/// Where a camera hangs.
struct CameraPlace {
  Point2 position;      ///< [m], map
  double height = 2.5;  ///< [m] above the floor
};

/// How a camera on a mount looks.
struct View {
  double pan = 0.0;            ///< [rad] from the map's x axis, to the left
  double tilt = 0.0;           ///< [rad] upwards
  double field_of_view = 1.0;  ///< [rad] across the picture
};

/// Part of section `scene_camera` of robot.yaml.
struct PanTiltZoomParams {
  double shown_m = 4.5;      ///< [m] across, at the robot: it and the people round it
  double height_m = 0.7;     ///< [m] above the floor, of the point that is kept in the middle: the robot's waist
  double deviations = 2.0;   ///< standard deviations of the robot's place that the picture must hold on either side
  double narrowest = 25.0;   ///< [deg] across: the zoom's end
  double widest = 65.0;      ///< [deg] across: the other end
  double lowest = -85.0;     ///< [deg] downwards
  double dead_share = 0.15;  ///< of the picture's width: a robot that is nearer to the middle makes no move
  double dead_zoom = 0.25;   ///< the view is made wider or narrower when it is off by more than this share
  double lost_m = 3.0;       ///< [m] standard deviation beyond which all is shown
  template <class V>
  void visit(V& v) {
    v("shown_m", shown_m);
    v("height_m", height_m);
    v("deviations", deviations);
    v("narrowest", narrowest);
    v("widest", widest);
    v("lowest", lowest);
    v("dead_share", dead_share);
    v("dead_zoom", dead_zoom);
    v("lost_m", lost_m);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Keeps the robot in the picture of a camera in the hall.
class PanTiltZoom {
 public:
  /// @param overview  [m], map: the middle of what is shown while nobody knows where the robot is
  PanTiltZoom(CameraPlace place, Point2 overview, const PanTiltZoomParams& params);

  /// The view from now on.
  /// @param robot      [m], map; nullopt: it is lost
  /// @param deviation  [m] standard deviation of its place, along the worse axis
  const View& follow(std::optional<Point2> robot, double deviation);
  [[nodiscard]] const View& view() const { return view_; }

 private:
  [[nodiscard]] View towards(Point2 point, double shown) const;
  [[nodiscard]] bool is_worth_a_move(const View& wanted) const;
  CameraPlace place_;
  Point2 overview_;
  PanTiltZoomParams params_;
  View view_;
};

}  // namespace docent::vision
