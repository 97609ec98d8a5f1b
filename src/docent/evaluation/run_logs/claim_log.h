#pragma once

#include <deque>
#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/evaluation/truth_history.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// Every belief beside the truth of its moment, as CSV: what the tables and plots of localization are made of. Columns:
/// time [s] since the first truth; true x, y [m], heading [deg]; whether there was a best hypothesis, its x, y [m],
/// heading [deg], mass; localized; p_lost; entropy [nat]; hypotheses; active cells; beams used and filtered; blocked
/// share of the beams; distance driven [m]; speed [m/s]; number of kidnaps so far; agreement,
/// contradiction, surprise, hidden, confirmation, blind_way [m] and unmapped as in the message; spread [m] of the best
/// hypothesis; its share among the places that the whole way leaves possible; exhibits explained, contacts and area
/// violations so far.
class ClaimLog {
 public:
  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  [[nodiscard]] std::size_t claims() const { return claims_; }
  [[nodiscard]] Result<void> save(const std::string& path) const;

 private:
  void judge(const docent_msgs::Belief& belief, const Pose2& truth);

  TruthHistory truth_;
  std::deque<std::shared_ptr<const docent_msgs::Belief>> waiting_;  ///< for a true state that is not older
  Time first_{};
  Time last_stamp_{};
  int kidnaps_ = 0;
  int explained_ = 0;
  int contacts_ = 0;
  int violations_ = 0;
  std::size_t claims_ = 0;
  std::string lines_;
};

}  // namespace docent::evaluation
