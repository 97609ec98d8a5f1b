#include "docent/telepresence/foxglove/hub.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

class FoxgloveHubTest : public testing::Test {
 protected:
  static FoxgloveClient::Bytes bytes(std::uint8_t value) {
    return std::make_shared<const std::vector<std::uint8_t>>(std::vector<std::uint8_t>{value});
  }
  std::vector<std::uint32_t> wanted_;
  FoxgloveHub hub_{
      "test", {{0, "/a", "A", ""}, {1, "/b", "B", ""}}, [this](std::uint32_t channel) { wanted_.push_back(channel); }};
  FoxgloveClient client_;
};

TEST_F(FoxgloveHubTest, EncodesOnlyWhatSomebodyWants) {
  EXPECT_FALSE(hub_.is_wanted(1));
  EXPECT_EQ(hub_.take(client_, FoxgloveSubscribe{{{10, 1}}}), "");
  EXPECT_TRUE(hub_.is_wanted(1));
  EXPECT_FALSE(hub_.is_wanted(0));
  EXPECT_EQ(wanted_, std::vector<std::uint32_t>{1});
  FoxgloveClient other;
  EXPECT_EQ(hub_.take(other, FoxgloveSubscribe{{{10, 1}}}), "");
  EXPECT_EQ(hub_.take(client_, FoxgloveUnsubscribe{{10}}), "");
  EXPECT_TRUE(hub_.is_wanted(1));
  hub_.leave(other);
  EXPECT_FALSE(hub_.is_wanted(1));
}

TEST_F(FoxgloveHubTest, ASlowClientGetsTheNewestMessageOfEachSubscription) {
  EXPECT_EQ(hub_.take(client_, FoxgloveSubscribe{{{7, 0}, {8, 1}}}), "");
  for (std::uint8_t i = 1; i <= 100; ++i) {
    client_.add(0, Time{i}, bytes(i));
    client_.add(1, Time{i}, bytes(static_cast<std::uint8_t>(i + 100)));
  }
  const auto first = client_.next();
  const auto second = client_.next();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->at(1), 7);
  EXPECT_EQ(first->back(), 100);
  EXPECT_EQ(static_cast<std::uint8_t>(second->back()), 200);
  EXPECT_FALSE(client_.next());
}

TEST_F(FoxgloveHubTest, TellsWhatItDoesNotDo) {
  EXPECT_NE(hub_.take(client_, FoxgloveOther{"advertise"}).find("advertise is not served"), std::string::npos);
  EXPECT_NE(hub_.take(client_, FoxgloveSubscribe{{{1, 9}}}).find("no channel 9"), std::string::npos);
  EXPECT_EQ(hub_.take(client_, FoxgloveSubscribe{{{1, 0}}}), "");
  EXPECT_NE(hub_.take(client_, FoxgloveSubscribe{{{1, 1}}}).find("taken"), std::string::npos);
  EXPECT_FALSE(hub_.is_wanted(1));
}

TEST_F(FoxgloveHubTest, IsBounded) {
  FoxgloveSubscribe many;
  for (std::uint32_t i = 0; i < kMostSubscriptions; ++i) many.subscriptions.push_back({i, 0});
  EXPECT_EQ(hub_.take(client_, many), "");
  EXPECT_NE(hub_.take(client_, FoxgloveSubscribe{{{9999, 0}}}), "");
}

}  // namespace
}  // namespace docent::telepresence
