#include "docent/evaluation/message_ages.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

template <class T>
void tell(MessageAges& ages, const Topic<T>& topic, double stamp, double heard, bool is_localized = true) {
  auto message = std::make_shared<T>();
  message->header.stamp = to_message(time_from_seconds(stamp));
  if constexpr (requires { message->localized; }) message->localized = is_localized;
  ages.add(transport::topic_info(topic), time_from_seconds(heard), message);
}

TEST(MessageAges, AreFromTheStampToTheReceipt) {
  MessageAges ages;
  tell(ages, topics::kVirtualScan, 0.0, 5.0);  // of a robot that starts
  tell(ages, topics::kBelief, 0.0, 5.0, false);
  for (int i = 0; i < 99; ++i) tell(ages, topics::kBelief, i, i + 0.02);
  tell(ages, topics::kBelief, 100.0, 100.5);
  tell(ages, topics::kVirtualScan, 10.0, 10.1);
  tell(ages, topics::kScanFront, 10.0, 12.0);
  ASSERT_EQ(ages.beliefs().count(), 100U);
  EXPECT_NEAR(ages.beliefs().at(0.5), 0.02, 0.001);
  EXPECT_NEAR(ages.beliefs().at(1.0), 0.5, 0.01);
  ASSERT_EQ(ages.hazards().count(), 1U);
  EXPECT_NEAR(ages.hazards().at(0.5), 0.1, 0.002);
}

}  // namespace
}  // namespace docent::evaluation
