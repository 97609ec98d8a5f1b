#include "docent/modules/office/listening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

namespace docent::modules::listening_test {
namespace {

/// A microphone that a test feeds: levels [0..1] of a tone, each for a tenth of a second.
struct Fed {
  std::deque<float> levels;
  bool is_open = false;
  std::string fails;
};

class FedMicrophone final : public interaction::Microphone {
 public:
  explicit FedMicrophone(Fed& fed) : fed_{fed} {}
  Result<void> begin(Time /*now*/) override {
    if (!fed_.fails.empty()) return fail(fed_.fails);
    fed_.is_open = true;
    return {};
  }
  Result<interaction::Clip> read(Time /*now*/) override {
    if (!fed_.fails.empty()) return tl::unexpected<Error>(Error{fed_.fails});
    interaction::Clip sound;
    if (fed_.levels.empty()) return sound;
    for (int i = 0; i < interaction::kSampleRate / 10; ++i)
      sound.push_back(fed_.levels.front() * std::sin(0.1F * static_cast<float>(i)));
    fed_.levels.pop_front();
    return sound;
  }
  void end() override { fed_.is_open = false; }

 private:
  Fed& fed_;
};

class ListeningTest : public testing::Test {
 protected:
  void feed(float level, int tenths) { fed.levels.insert(fed.levels.end(), static_cast<std::size_t>(tenths), level); }
  /// @returns tenths of a second after which it was over
  int listen(int most = 100) {
    for (int i = 1; i <= most; ++i) {
      now_s += 0.1;
      if ((said = listening.listen(time_from_seconds(now_s)))) return i;
    }
    return -1;
  }
  Fed fed;
  double now_s = 100.0;
  Listening listening{{}, std::make_unique<FedMicrophone>(fed)};
  std::optional<interaction::Clip> said;
};

TEST_F(ListeningTest, HearsFromThePressToThePause) {
  EXPECT_FALSE(listening.listen(time_from_seconds(now_s))) << "nobody has pressed";
  EXPECT_FALSE(fed.is_open);
  feed(0.002F, 5), feed(0.3F, 12), feed(0.002F, 30);
  listening.press(time_from_seconds(now_s));
  EXPECT_TRUE(fed.is_open);
  EXPECT_NEAR(listen(), 26, 1);
  ASSERT_TRUE(said);
  EXPECT_NEAR(interaction::duration_s(*said), 2.6, 0.11);
  EXPECT_FALSE(fed.is_open) << "nobody listens any more";
  EXPECT_EQ(listening.fault(), "");
}

TEST_F(ListeningTest, WhoSpeaksWithoutEndIsHeardForSixSeconds) {
  feed(0.002F, 2), feed(0.3F, 200);
  listening.press(time_from_seconds(now_s));
  EXPECT_NEAR(listen(), 60, 1);
}

TEST_F(ListeningTest, SilenceIsNothingSaidAndNoFault) {
  feed(0.002F, 100);
  listening.press(time_from_seconds(now_s));
  EXPECT_NEAR(listen(), 25, 1);
  ASSERT_TRUE(said);
  EXPECT_TRUE(said->empty());
  EXPECT_EQ(listening.fault(), "");
}

TEST_F(ListeningTest, AMicrophoneThatFailsIsSaid) {
  fed.fails = "microphone 'default': No such file or directory";
  listening.press(time_from_seconds(now_s));
  EXPECT_FALSE(listening.is_open());
  EXPECT_EQ(listening.fault(), fed.fails);
  fed.fails.clear();
  feed(0.3F, 5);
  listening.press(time_from_seconds(now_s));
  EXPECT_EQ(listening.fault(), "");
  EXPECT_FALSE(listening.listen(time_from_seconds(now_s)));
  fed.fails = "microphone 'default': No such device";
  EXPECT_EQ(listen(), 1) << "unplugged while somebody speaks";
  EXPECT_EQ(listening.fault(), fed.fails);
  EXPECT_TRUE(said->empty());
}

TEST_F(ListeningTest, OneThatIsMutedOrGivesNothingIsSaidToo) {
  feed(0.0F, 100);
  listening.press(time_from_seconds(now_s));
  EXPECT_GT(listen(), 0);
  EXPECT_NE(listening.fault().find("muted"), std::string::npos);
  fed.levels.clear();
  listening.press(time_from_seconds(now_s));
  EXPECT_GT(listen(), 0);
  EXPECT_NE(listening.fault().find("nothing comes"), std::string::npos);
}

}  // namespace
}  // namespace docent::modules::listening_test
