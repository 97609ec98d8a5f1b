#pragma once

#include <optional>
#include <string>

#include "docent/geometry/pose2.h"
#include "docent/messages/standard_messages.h"
#include "docent/modules/eyes/dock_params.h"
#include "docent/modules/eyes/picture_watch.h"
#include "docent/vision/lens/lens.h"
#include "docent/vision/marks/dock_line.h"
#include "docent/vision/marks/tag_finder.h"

namespace docent::modules {

/// What the front camera knows of the charger: the line to its tag, in odometry's frame.
class DockEye {
 public:
  DockEye(const DockParams& params, Time now) : params_{params}, watch_{now}, begun_{now} {}

  /// The lens, as its driver says it.
  void know(const sensor_msgs::CameraInfo& info);
  /// Odometry without jumps, in the order of its stamps.
  void add_odometry(Time stamp, const Pose2& odom_from_base);
  /// @param taken  by the clock of `now`. @returns the tag was seen, and its place is told anew
  bool see(Time now, Time taken, const sensor_msgs::Image& image);
  /// Likewise, a JPEG file.
  bool see(Time now, Time taken, const sensor_msgs::CompressedImage& picture);
  /// Where the tag should stand, by the map.
  void expect(const Pose2& odom_from_tag);
  /// A new approach: what was seen long ago no longer counts.
  void forget();

  /// Where the tag stands; nullopt: it was not seen, its plane is not sure, or that is too long ago.
  [[nodiscard]] std::optional<vision::DockLineEstimate> line(Time now) const;
  /// What is wrong with the camera; "" while all is well.
  [[nodiscard]] std::string complaint(Time now) const;

 private:
  bool find(Time now, Time taken, int columns, int rows, std::vector<std::uint8_t> grey);

  DockParams params_;
  PictureWatch watch_;
  Time begun_;
  std::optional<sensor_msgs::CameraInfo> known_;
  std::optional<vision::Lens> lens_;
  std::optional<vision::DockLine> line_;
  vision::TagFinder finder_{{.decimate = 2.0}};
  std::string fault_;
  struct Way {
    std::optional<Pose2> last;
    double driven = 0.0;  ///< [m] since the tag was seen
    Time seen{};          ///< the tag
  } way_;
};

}  // namespace docent::modules
