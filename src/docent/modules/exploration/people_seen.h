#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "docent/grid/occupancy_grid.h"
#include "docent/messages/people_messages.h"
#include "docent/modules/exploration/keyframes.h"

namespace docent::modules {

/// A sweep with what the map so far says of each beam, so that `people` can follow those who are about: what ends on
/// floor that was seen to be free is of nobody's building.
[[nodiscard]] docent_msgs::PersonBeams person_beams(const Keyframes::Look& look, const Pose2& map_from_odom,
                                                    const OccupancyGrid& map);

/// Those of the tracked who have walked: things that stand are tracked, too, where they look like somebody.
class PeopleSeen {
 public:
  void note(const docent_msgs::People& in_odom);
  [[nodiscard]] const std::vector<Point2>& walkers() const { return walkers_; }  ///< [m], odom, at present

 private:
  struct Track {
    Point2 first;
    bool has_walked = false;
  };
  std::map<std::uint32_t, Track> tracks_;
  std::vector<Point2> walkers_;
};

}  // namespace docent::modules
