#include "docent/interaction/speech/speaker.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/base/files.h"

namespace docent::interaction::speaker_test {
namespace {

const Say kHello{"t1/short", "Hello.", "en", Mood::neutral};
const Say kMore{"t1/long", "More.", "en", Mood::neutral};

void say(Speaker& speaker, const Say& line, double duration_s, Time now) {
  ASSERT_EQ(speaker.judge(line), Speaker::Verdict::fresh);
  speaker.expect(line);
  EXPECT_EQ(speaker.judge(line), Speaker::Verdict::under_way);
  speaker.begin(duration_s, "", now);
}

TEST(Speaker, SaysALineOnce) {
  Speaker speaker{{}, {}};
  say(speaker, kHello, 2.0, time_from_seconds(10));
  EXPECT_EQ(speaker.judge(kHello), Speaker::Verdict::under_way);
  EXPECT_FALSE(speaker.finish_if_over(time_from_seconds(11.9)));
  EXPECT_TRUE(speaker.finish_if_over(time_from_seconds(12)));
  EXPECT_FALSE(speaker.finish_if_over(time_from_seconds(13)));
  EXPECT_EQ(speaker.judge(kHello), Speaker::Verdict::finished);
}

TEST(Speaker, ANewerLineReplacesTheOldOneForGood) {
  Speaker speaker{{}, {}};
  say(speaker, kHello, 20.0, time_from_seconds(0));
  say(speaker, kMore, 5.0, time_from_seconds(1));
  EXPECT_EQ(speaker.present().id, "t1/long");
  EXPECT_EQ(speaker.judge(kHello), Speaker::Verdict::finished);
}

TEST(Speaker, GoesOnAfterARestart) {
  const auto path = std::filesystem::temp_directory_path() / ("docent_speaker_" + std::to_string(getpid()) + ".json");
  std::filesystem::remove(path);
  EXPECT_TRUE(load_speaker_checkpoint(path)->present.id.empty());
  Speaker speaker{{}, {}};
  say(speaker, kHello, 2.0, time_from_seconds(0));
  speaker.finish_if_over(time_from_seconds(5));
  say(speaker, kMore, 20.0, time_from_seconds(10));
  ASSERT_TRUE(save_checkpoint(path, speaker.memory()));

  const auto memory = load_speaker_checkpoint(path);
  ASSERT_TRUE(memory);
  Speaker in_time{*memory, time_from_seconds(15)};
  EXPECT_TRUE(in_time.present().is_speaking);
  EXPECT_EQ(in_time.judge(kMore), Speaker::Verdict::under_way);
  EXPECT_EQ(in_time.judge(kHello), Speaker::Verdict::finished);
  EXPECT_FALSE(Speaker(*memory, time_from_seconds(40)).present().is_speaking);
  EXPECT_FALSE(Speaker(*memory, time_from_seconds(1)).present().is_speaking) << "the clock began anew";

  ASSERT_TRUE(write_file_atomically(path, "{\"id\": 3}"));
  EXPECT_FALSE(load_speaker_checkpoint(path));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace docent::interaction::speaker_test
