#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "docent/base/time.h"
#include "docent/evaluation/deployment_report.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/mission_messages.h"
#include "docent/messages/request_messages.h"
#include "docent/messages/truth_messages.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::evaluation {

/// Counts wishes, tours and explanations. Wishes come from the truth (who truly asked) and from the board (the Web);
/// what became of them is the board's word, checked against where the robot truly stood.
class RequestTally {
 public:
  void add_offer(Time time, const docent_msgs::TrueOffer& offer);
  void add_task(const docent_msgs::Task& task);
  /// @param truth  where the robot truly is now; nullopt: unknown
  void add_board(Time time, const docent_msgs::RequestBoard& board, const std::optional<Point2>& truth);
  void add_event(Time time, const docent_msgs::Event& event, const std::optional<Point2>& truth);

  /// Fills requests, success_rate, tours, explanations, revisions and visitors. `end` of the run.
  void fill(DeploymentReport& report, Time end) const;

 private:
  struct Wish {
    Time offered{};
    bool on_board = false;
    std::optional<RequestStatus> state;
    std::string reason;
    std::optional<RequestSource> source;
    std::string visitor;
    bool in_wrong_place = false;
  };
  [[nodiscard]] bool is_in_place(const std::string& exhibit, const std::optional<Point2>& truth) const;

  std::map<std::string, Wish> wishes_;
  std::map<std::string, Point2> places_;  ///< of the exhibits, as last driven to
  std::map<std::string, Time> tours_under_way_;
  DeploymentReport tally_;
};

}  // namespace docent::evaluation
