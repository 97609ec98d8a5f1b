#pragma once

#include "docent/base/result.h"
#include "docent/modules/eyes/eye_places.h"
#include "docent/planning/dock_approach/dock_approach.h"
#include "docent/vision/marks/dock_line.h"

namespace docent::modules {

/// The charger's AprilTag, of family 36h11.
struct DockTag {
  int id = 0;            ///< its number, 0..586
  double side = 0.16;    ///< [m] > 0 of its black square
  double height = 0.35;  ///< [m] of its middle above the floor
  template <class V>
  void visit(V& v) {
    v("id", id);
    v("side", side);
    v("height", height);
  }
};

/// Section `dock`: docking by the charger's tag. The museum's charger is the place where the robot stands at the
/// contacts, and looks at the tag.
struct DockParams {
  bool enabled = false;                              ///< the robot has a camera that looks ahead, and its charger a tag
  EyePlace place{0.20, 0.0, 0.45, 0.0, -10.0, 0.0};  ///< of the camera
  DockTag tag;
  double contact = 0.35;  ///< [m] > 0 from the tag, on the floor, to the base's middle at the contacts
  double beside = 0.0;    ///< [m] that the tag hangs to the left of the contacts' middle, as who docks sees it
  double held_m = 1.0;    ///< [m] > 0 that is driven by odometry since the tag was seen
  double held_s = 30.0;   ///< [s] > 0 likewise
  double try_s = 150.0;   ///< [s] > 0 for all attempts
  template <class V>
  void visit(V& v) {
    v("enabled", enabled);
    v("place", place);
    v("tag", tag);
    v("contact", contact);
    v("beside", beside);
    v("held_m", held_m);
    v("held_s", held_s);
    v("try_s", try_s);
  }
  [[nodiscard]] Result<void> validate() const;
  [[nodiscard]] vision::DockLineParams line() const;
  [[nodiscard]] planning::DockApproachParams approach() const;
  /// Where the tag stands, its x axis out of it, before who stands at the contacts.
  [[nodiscard]] Pose2 charger_from_tag() const;
};

}  // namespace docent::modules
