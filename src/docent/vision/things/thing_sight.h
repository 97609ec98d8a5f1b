#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/vision/objects/object_book.h"
#include "docent/vision/things/floor_things.h"
#include "docent/vision/things/thing_map.h"
#include "docent/vision/things/thing_patch.h"

namespace docent::vision {

/// Where the robot was when a picture was taken.
struct ThingViewpoint {
  Time taken;
  Pose2 map_from_base;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y, theta
};

/// A thing that was cut out of a picture, and where it lies.
struct KeptPatch {
  pictures::Image patch;
  Point2 in_map;  ///< [m]
};

/// From pictures to things on the map: depths find them, colours name them by an object book. Deterministic.
class ThingSight {
 public:
  /// @param book  without: nothing has a name
  ThingSight(const FloorThingParams& floor, const ThingMapParams& map, std::optional<ObjectBook> book);

  /// @pre valid
  void set_depth_camera(const DepthCamera& camera);
  void set_front_camera(std::optional<FrontCamera> camera) { front_ = std::move(camera); }
  /// Of which depth pictures are; nullptr: nobody has said.
  [[nodiscard]] const DepthCamera* depth_camera() const { return depth_ ? &*depth_ : nullptr; }

  /// A picture in colours; the last one counts.
  void see(pictures::Image picture, const ThingViewpoint& from);
  /// @pre depth_camera(), and the picture has its size. @returns what was cut out
  std::vector<KeptPatch> see(const DepthPicture& picture, const ThingViewpoint& from);

  [[nodiscard]] const ThingMap& map() const { return map_; }
  [[nodiscard]] bool has_book() const { return book_.has_value(); }
  [[nodiscard]] Time looked() const { return looked_; }  ///< when the last depth picture that showed floor was taken

 private:
  struct Colours {
    pictures::Image picture;
    ThingViewpoint from;
  };
  [[nodiscard]] std::optional<pictures::Image> patch_of(const FloorThing& thing, Point2 in_map, Time taken) const;
  void look_for_gaps(const ThingViewpoint& from);

  FloorThingParams params_;
  ThingMap map_;
  std::optional<ObjectBook> book_;
  std::optional<DepthCamera> depth_;
  std::optional<FloorThingFinder> finder_;
  std::optional<FrontCamera> front_;
  std::optional<Colours> colours_;
  Rng rng_;
  Time looked_{};
};

}  // namespace docent::vision
