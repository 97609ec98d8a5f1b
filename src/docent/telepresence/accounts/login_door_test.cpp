#include "docent/telepresence/accounts/login_door.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

class LoginDoorTest : public testing::Test {
 protected:
  bool tries(const std::string& caller, bool is_wrong = true) {
    const bool may = door_.may_try("ada", caller, now_);
    if (may && is_wrong) door_.was_wrong(caller, now_);
    return may;
  }
  Time now_ = time_from_seconds(100.0);
  LoginDoor door_{LoginDoorParams{}};
};

TEST_F(LoginDoorTest, WhoeverGuessesIsSlowedDown) {
  int tried = 0;
  for (int i = 0; i < 100; ++i) tried += tries("192.0.2.66") ? 1 : 0;
  EXPECT_LE(tried, 7) << "six of its own, and no more";
  now_ = now_ + seconds(60.0);
  for (int i = 0; i < 100; ++i) tried += tries("192.0.2.66") ? 1 : 0;
  EXPECT_LE(tried, 13);
  EXPECT_GE(tried, 12);
}

TEST_F(LoginDoorTest, StrangersWhoGuessShutNobodyOut) {
  door_.know("ada", "192.0.2.1");
  int let_in = 0;
  int from_elsewhere = 0;
  for (int minute = 0; minute < 25; ++minute) {
    for (int stranger = 0; stranger < 200; ++stranger)
      for (int i = 0; i < 6; ++i) (void)tries("198.51.100." + std::to_string(stranger));
    let_in += tries("192.0.2.1", false) ? 1 : 0;
    from_elsewhere += tries("203.0.113." + std::to_string(minute), false) ? 1 : 0;
    now_ = now_ + seconds(60.0);
  }
  EXPECT_EQ(let_in, 25) << "from where she was right before";
  EXPECT_EQ(from_elsewhere, 25) << "and with the first try from anywhere";
}

TEST_F(LoginDoorTest, ManyWhoGuessOneNameGuessItSlowlyTogether) {
  for (int stranger = 0; stranger < 200; ++stranger) ASSERT_TRUE(tries("198.51.100." + std::to_string(stranger)));
  int tried = 0;
  for (int minute = 0; minute < 10; ++minute) {
    now_ = now_ + seconds(60.0);
    for (int stranger = 0; stranger < 200; ++stranger) tried += tries("198.51.100." + std::to_string(stranger)) ? 1 : 0;
  }
  EXPECT_LE(tried, 70) << "six a minute of all of them";
}

TEST_F(LoginDoorTest, WhoWasRightIsHeardBeforeWhoIsNewAndBothBeforeWhoWasWrong) {
  door_.know("ada", "192.0.2.1");
  (void)tries("198.51.100.1");
  (void)tries("198.51.100.2");
  (void)tries("198.51.100.2");
  EXPECT_LT(door_.rank("ada", "192.0.2.1"), door_.rank("ada", "203.0.113.1"));
  EXPECT_LT(door_.rank("ada", "203.0.113.1"), door_.rank("ada", "198.51.100.1"));
  EXPECT_LT(door_.rank("ada", "198.51.100.1"), door_.rank("ada", "198.51.100.2"));
  EXPECT_EQ(door_.rank("grace", "192.0.2.1"), door_.rank("grace", "203.0.113.1")) << "that was another name";
}

TEST_F(LoginDoorTest, RemembersOnlySoMany) {
  LoginDoor door{{.most = 100}};
  for (int i = 0; i < 10'000; ++i) door.was_wrong(std::to_string(i), now_ + seconds(i));
  EXPECT_EQ(door.rank("ada", "9999"), 2) << "the newest";
  EXPECT_EQ(door.rank("ada", "0"), 1) << "long forgotten";
}

}  // namespace
}  // namespace docent::telepresence
