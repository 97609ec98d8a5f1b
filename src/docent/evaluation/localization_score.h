#pragma once

#include <deque>

#include "docent/base/quantiles.h"
#include "docent/evaluation/deployment_report.h"
#include "docent/evaluation/truth_history.h"
#include "docent/messages/localization_messages.h"

namespace docent::evaluation {

/// Holds beliefs against the truth. "Right" means: localized by its own word, and truly within 0.5 m and 20 degrees.
class LocalizationScore {
 public:
  void add_belief(const docent_msgs::Belief& belief);
  /// After every new true state.
  void step(const TruthHistory& truth);

  [[nodiscard]] DeploymentReport::Localization result() const;

 private:
  struct Claim {
    Time stamp;
    bool localized = false;
    Pose2 map_from_base;
  };
  void judge(const Claim& claim, const Pose2& truth);
  void tick(Time now, double dt, double distance_m);

  std::deque<Claim> waiting_;  ///< for a true state that is not older
  DeploymentReport::Localization result_;
  Quantiles errors_m_;

  bool has_started_ = false;
  Time start_{};
  Time last_{};
  bool claimed_localized_ = false;  ///< by the last belief that was judged
  bool claim_is_right_ = false;
  Time claim_time_{};
  double distance_at_claim_ = 0.0;
  bool is_right_ = false;
  Time right_since_{};
  Time wrong_since_{};
  bool in_lost_event_ = false;
};

}  // namespace docent::evaluation
