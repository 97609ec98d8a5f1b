#include "docent/evaluation/run_logs/health_log.h"

#include <gtest/gtest.h>

namespace docent::evaluation {
namespace {

void tell(HealthLog& log, double time, const char* module, const char* state, const char* reason) {
  auto health = std::make_shared<docent_msgs::Health>();
  health->module = module;
  health->state = state;
  health->reason = reason;
  log.add(transport::topic_info(topics::kHealth), time_from_seconds(time), health);
}

TEST(HealthLog, HasARowForEveryChange) {
  HealthLog log;
  log.add(transport::topic_info(topics::kTrueState), time_from_seconds(100.0),
          std::make_shared<docent_msgs::TrueState>());
  tell(log, 100.5, "localize", "ready", "");
  tell(log, 101.0, "localize", "ready", "");
  tell(log, 101.0, "avoid", "ready", "");
  tell(log, 101.5, "localize", "degraded", "no sonar, no laser");
  tell(log, 102.0, "localize", "degraded", "no sonar, no laser");
  tell(log, 102.5, "localize", "ready", "");
  EXPECT_EQ(log.rows(),
            "0.50,localize,ready,\n"
            "1.00,avoid,ready,\n"
            "1.50,localize,degraded,no sonar; no laser\n"
            "2.50,localize,ready,\n");
}

}  // namespace
}  // namespace docent::evaluation
