#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/messages/mission_messages.h"
#include "docent/messages/request_messages.h"
#include "docent/simulator/scenario/scenario.h"

namespace docent::simulator {

struct WishParams {
  std::string source = "visitor";                  ///< who asks: visitor, web, staff
  double requests_per_hour = 24.0;                 ///< mean; no gap is longer than 1.8 times the mean
  double exhibit_share = 0.6;                      ///< the rest asks for a tour
  std::vector<std::string> languages{"de", "en"};  ///< each wish is made in one of them, all equally likely
  double answers_more = 0.3;   ///< chance to answer a question with the first option, "more" or "yes"
  double answers_next = 0.2;   ///< with the second; else nobody answers and the default comes
  double resend_period = 2.0;  ///< [s] until the wish stands on the request board
};

/// Visitors with wishes: they ask for exhibits and tours and sometimes answer what the robot asks.
class WishingVisitors {
 public:
  WishingVisitors(const WishParams& params, std::vector<std::string> exhibits, std::vector<std::string> tours, Rng rng);

  /// What to send now: `offered` holds the ids of wishes sent for the first time.
  struct Output {
    std::vector<docent_msgs::Request> requests;
    std::vector<std::string> offered;
    std::vector<docent_msgs::Choice> choices;
  };
  /// Ten times a second or so. @param since_start  run time
  [[nodiscard]] Output step(Time now, Duration since_start);
  void ask(Time now, const Wish& wish);
  /// From now on. @pre more >= 0, next >= 0, more + next <= 1
  void answer_with(double more, double next);
  void see_board(const docent_msgs::RequestBoard& board);
  void see_mission(Time now, const docent_msgs::MissionState& mission);

 private:
  struct Open {
    docent_msgs::Request request;
    Time next_send{};
    bool was_sent = false;
  };
  [[nodiscard]] std::string new_id(Time now);
  [[nodiscard]] std::string language();
  [[nodiscard]] double next_gap();
  docent_msgs::Request& ask(Time now, const std::string& kind, const std::string& target, const std::string& language);

  WishParams params_;
  std::vector<std::string> exhibits_;
  std::vector<std::string> tours_;
  Rng wish_rng_;    ///< who wishes for what, and when: the same whatever the robot asks them
  Rng answer_rng_;  ///< what they answer
  Rng id_rng_;
  double next_wish_ = 0.0;  ///< [s] since the start
  std::vector<Open> open_;
  std::set<std::string> seen_prompts_;
  struct Answer {
    Time at{};
    docent_msgs::Choice choice;
  };
  std::vector<Answer> answers_;
};

}  // namespace docent::simulator
