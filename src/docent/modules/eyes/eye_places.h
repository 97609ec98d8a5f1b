#pragma once

#include <string>

#include "docent/base/result.h"
#include "docent/vision/ceiling/ceiling_camera.h"
#include "docent/vision/depth/depth_sight.h"
#include "docent/vision/things/floor_things.h"
#include "docent/vision/things/thing_map.h"

namespace docent::modules {

/// Where an eye sits on the robot, as robot.yaml has it. Base frame: x ahead, y to the left, z up from the floor.
struct EyePlace {
  double x = 0.16, y = -0.03, z = 1.05;  ///< [m] of its glass
  double pan = 0.0;                      ///< [deg] to the left
  double tilt = -30.0;                   ///< [deg] upwards; 90 looks at the ceiling, the picture's top to the rear
  double roll = 0.0;                     ///< [deg] about its own axis, clockwise as it looks
  template <class V>
  void visit(V& v) {
    v("x", x);
    v("y", y);
    v("z", z);
    v("pan", pan);
    v("tilt", tilt);
    v("roll", roll);
  }
  [[nodiscard]] Result<void> validate() const;
  [[nodiscard]] vision::DepthCameraMount depth_mount() const;
  [[nodiscard]] vision::CameraMount camera_mount() const;
};
/// The other way round. Of a camera that looks up all but straight, pan and roll alone mean little, and much together.
[[nodiscard]] EyePlace place_of(const vision::CameraMount& mount);

/// Section `ceiling`: a camera that looks up.
struct CeilingParams {
  bool enabled = false;                             ///< the robot has one
  EyePlace place{0.10, 0.0, 1.25, 0.0, 90.0, 0.0};  ///< of the camera
  std::string mosaic;  ///< file of the ceiling as `docent map-ceiling` made it; "": ceiling.yaml in the museum's folder
  double steepest = 1.2;  ///< > 0: slope of the farthest looks; less where the base rocks much
  template <class V>
  void visit(V& v) {
    v("enabled", enabled);
    v("place", place);
    v("mosaic", mosaic);
    v("steepest", steepest);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Section `sight`: a depth camera that looks at the floor ahead.
struct SightParams {
  bool enabled = false;       ///< the robot has one; then it stands while the module `sight` is silent
  EyePlace place;             ///< of the camera
  double low = 0.03;          ///< [m] > 0: what is higher over the floor is in the way; carpets and sills are lower
  double robot_height = 1.4;  ///< [m] > low: what hangs higher is not
  double drop = 0.05;         ///< [m] > 0: a floor that is so much deeper is none
  double reach = 4.0;         ///< [m] > 0.5: farther is too coarse
  template <class V>
  void visit(V& v) {
    v("enabled", enabled);
    v("place", place);
    v("low", low);
    v("robot_height", robot_height);
    v("drop", drop);
    v("reach", reach);
  }
  [[nodiscard]] Result<void> validate() const;
  [[nodiscard]] vision::DepthSightParams sight() const;
};

/// Section `things`: a colour camera that looks at the floor ahead, beside the depth camera of `sight`.
struct ThingsParams {
  bool enabled = false;                               ///< the robot has one, and knows things by it
  EyePlace place{0.16, 0.05, 1.10, 0.0, -28.0, 0.0};  ///< of the camera
  std::string book;      ///< file of `docent learn-objects`; "": objects.json in the museum's folder
  std::string keep;      ///< folder into which a picture of each look at a thing is put, to teach by; "": none is kept
  double turning = 0.5;  ///< [rad/s] > 0: while the robot turns faster, pictures are not looked at
  vision::FloorThingParams floor;  ///< what stands out of the floor
  vision::ThingMapParams map;      ///< what several looks make of it
  template <class V>
  void visit(V& v) {
    v("enabled", enabled);
    v("place", place);
    v("book", book);
    v("keep", keep);
    v("turning", turning);
    v("floor", floor);
    v("map", map);
  }
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace docent::modules
