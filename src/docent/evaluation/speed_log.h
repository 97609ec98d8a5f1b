#pragma once

#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/transport/bus.h"

namespace docent {

/// How fast the robot truly drove, what was near and what it said of it, as CSV, five times a second: what the velocity
/// profile of `scripts/evaluate speed` is drawn from.
///
/// Columns: time [s] since the first truth; world x, y [m]; true speed [m/s]; distance driven [m]; nearest solid and
/// nearest person [m] from the outline; state and speed cap [m/s] of collision avoidance and its reason (commas become
/// semicolons); state of the goal.
class SpeedLog {
 public:
  /// Topics that do not matter are passed over.
  void add(const TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  [[nodiscard]] const std::string& rows() const { return rows_; }
  [[nodiscard]] Result<void> save(const std::string& path) const;

 private:
  void add_state(const docent_msgs::TrueState& state, Time time);

  Time first_{};
  Time last_{};
  bool has_truth_ = false;
  std::string avoidance_ = ",0.00,";  ///< state, cap, reason
  std::string goal_ = "idle";
  std::string rows_;
};

}  // namespace docent
