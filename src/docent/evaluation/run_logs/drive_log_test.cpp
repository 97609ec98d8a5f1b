#include "docent/evaluation/run_logs/drive_log.h"

#include <gtest/gtest.h>

namespace docent::evaluation {
namespace {

TEST(DriveLog, HasARowForEveryTrueStateWithWhatAvoidSaidLast) {
  DriveLog log;
  auto avoid = std::make_shared<docent_msgs::AvoidState>();
  avoid->state = "driving";
  avoid->reason = "slow, and late";
  avoid->speed_cap = 0.25;
  auto truth = std::make_shared<docent_msgs::TrueState>();
  truth->linear = 0.5;
  truth->distance_m = 2.0;
  truth->inside_area = true;
  truth->nearest_person_m = 0.7;
  truth->nearest_solid_m = 0.4;
  log.add(transport::topic_info(topics::kTrueState), time_from_seconds(50.0), truth);
  log.add(transport::topic_info(topics::kAvoidState), time_from_seconds(50.05), avoid);
  auto offer = std::make_shared<docent_msgs::TrueOffer>();
  offer->kind = "left_out";
  offer->subject = "begins";
  log.add(transport::topic_info(topics::kTrueOffer), time_from_seconds(50.05), offer);
  log.add(transport::topic_info(topics::kTrueState), time_from_seconds(50.1), truth);
  EXPECT_EQ(log.rows(),
            "0.00,0.000,0.000,0.00,0.500,0.000,2.000,0,0,0,0.700,0.400,0,,0.000,\n"
            "0.10,0.000,0.000,0.00,0.500,0.000,2.000,0,0,0,0.700,0.400,1,driving,0.250,slow; and late\n");
}

}  // namespace
}  // namespace docent::evaluation
