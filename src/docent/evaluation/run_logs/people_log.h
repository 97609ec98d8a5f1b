#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/evaluation/truth_history.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// Tracked people beside the true ones, as CSV, twice a second: what the tables and the plot of `scripts/evaluate
/// people` are made of. One row a person within 5 m of the robot, and one a track within 5 m that is nobody's, for the
/// tracks in the map and for those in odometry's frame, which are held against the truth as seen from the robot.
///
/// Columns: time [s] since the first truth; frame (map, odom); whether the robot said that it is localized; the robot's
/// speed [m/s] and turn rate [rad/s]; kind (person, nobody); id of the person or, of nobody, of the track; distance
/// from the robot [m]; beams of the sweep on the person; seconds that the person has been in view within 5 m without a
/// break; true speed [m/s], of nobody as claimed; radius [m]; id of the track, 0 for none; how far off it is [m] and
/// the speed that it claims [m/s]; world x, y [m].
class PeopleLog {
 public:
  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] Result<void> save(const std::string& path) const;

 private:
  struct Waiting {
    bool in_map = false;
    std::shared_ptr<const docent_msgs::People> people;
  };
  void add_truth(Time time, std::shared_ptr<const docent_msgs::TrueState> state);
  void judge(const Waiting& claim, const docent_msgs::TrueState& truth, Time stamp);

  TruthHistory truth_;
  std::deque<Waiting> waiting_;            ///< for a true state that is not older
  std::map<std::uint32_t, Time> in_view_;  ///< people by id, since when
  Time first_{};
  std::map<bool, Time> sampled_;  ///< by frame
  std::size_t rows_ = 0;
  std::string lines_;
};

}  // namespace docent::evaluation
