#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "docent/base/time.h"

namespace docent::vision {

/// A picture as its camera sent it.
struct Picture {
  Time stamp{};  ///< when it was taken
  std::shared_ptr<const std::vector<std::uint8_t>> file;
};

/// Pictures of the same moment by the camera on the robot and the one in the hall.
struct PicturePair {
  Picture robot;
  Picture scene;
};

/// Matches the pictures of two cameras by their stamps, each at its own rate. Keeps the last few of each.
class ImagePairs {
 public:
  static constexpr std::size_t kKept = 4;  ///< of a camera

  /// @param tolerance  two pictures that are farther apart are no pair
  explicit ImagePairs(Duration tolerance) : tolerance_{tolerance} {}

  void add_robot(Picture picture) { add(robot_, std::move(picture)); }
  void add_scene(Picture picture) { add(scene_, std::move(picture)); }
  /// The pair with the newest picture of the robot, and that of the hall nearest in time to it. O(kKept^2).
  [[nodiscard]] std::optional<PicturePair> newest() const;

 private:
  static void add(std::deque<Picture>& pictures, Picture picture);
  Duration tolerance_;
  std::deque<Picture> robot_, scene_;
};

}  // namespace docent::vision
