#include "docent/interaction/kiosk/poll.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/base/files.h"

namespace docent::interaction {
namespace {

class PollTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("docent-poll-" + std::to_string(::getpid()) + ".csv");
};

TEST_F(PollTest, AnAnswerIsALineThatTellsNobody) {
  const Time noon = time_from_seconds(1'795'521'600.0 + 59.0);  // 2026-11-24 12:00:59
  ASSERT_TRUE(Poll{file_}.add({"id-1", PollQuestion::liked, PollAnswer::yes, "en"}, noon));
  Poll poll{file_};  // after a restart
  ASSERT_TRUE(poll.add({"id-2", PollQuestion::intelligence, PollAnswer::dog, "fr"}, noon + seconds(3600.0 * 13)));
  EXPECT_EQ(*read_file(file_),
            "day,hour,language,question,answer\n2026-11-24,12,en,liked,yes\n2026-11-25,01,fr,intelligence,dog\n");
}

TEST_F(PollTest, SayingItTwiceIsSayingItOnce) {
  Poll poll{file_};
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(poll.add({"id-1", PollQuestion::liked, PollAnswer::no, "de"}, Time{}));
  ASSERT_TRUE(poll.add({"id-2", PollQuestion::liked, PollAnswer::no, "de"}, Time{}));
  const std::string text = *read_file(file_);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
}

TEST_F(PollTest, AFolderThatIsNotThereIsSaid) {
  Poll poll{file_ / "nowhere.csv"};
  const auto added = poll.add({"id-1", PollQuestion::liked, PollAnswer::yes, "en"}, Time{});
  ASSERT_FALSE(added);
  EXPECT_NE(added.error().message.find("nowhere.csv"), std::string::npos);
}

}  // namespace
}  // namespace docent::interaction
