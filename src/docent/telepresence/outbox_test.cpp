#include "docent/telepresence/outbox.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "docent/messages/conversions.h"

namespace docent::telepresence {
namespace {

class OutboxTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("docent-outbox-" + std::to_string(::getpid()) + "-" +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "web.sqlite"; }
  std::filesystem::path folder_;
};

docent_msgs::Request request(const std::string& id, double created) {
  docent_msgs::Request made;
  made.id = id;
  made.stamp = to_message(time_from_seconds(created));
  made.source = "web";
  made.visitor = "Zo\xc3\xab";
  made.kind = "exhibit";
  made.target = "sputnik";
  made.viewpoint = 3;
  made.language = "de";
  return made;
}

TEST_F(OutboxTest, KeepsWhatWasNotDeliveredOverARestart) {
  {
    auto outbox = Outbox::open(file());
    ASSERT_TRUE(outbox) << outbox.error().message;
    ASSERT_TRUE((*outbox)->put(request("b", 2)));
    ASSERT_TRUE((*outbox)->put(request("a", 1)));
    ASSERT_TRUE((*outbox)->put(request("c", 3)));
    (*outbox)->delivered("c");
    EXPECT_EQ((*outbox)->pending().size(), 2U);
  }
  auto outbox = Outbox::open(file());
  ASSERT_TRUE(outbox);
  ASSERT_EQ((*outbox)->pending().size(), 2U);
  const auto& first = (*outbox)->pending().front();
  EXPECT_EQ(first.id, "a");
  EXPECT_EQ(first.visitor, "Zo\xc3\xab");
  EXPECT_EQ(first.kind, "exhibit");
  EXPECT_EQ(first.target, "sputnik");
  EXPECT_EQ(first.viewpoint, 3);
  EXPECT_EQ(first.language, "de");
  EXPECT_EQ(from_message(first.stamp), time_from_seconds(1));
  EXPECT_FALSE((*outbox)->was_damaged());
}

TEST_F(OutboxTest, AskingTwiceIsAskingOnce) {
  auto outbox = Outbox::open(file());
  ASSERT_TRUE(outbox);
  ASSERT_TRUE((*outbox)->put(request("a", 1)));
  ASSERT_TRUE((*outbox)->put(request("a", 2)));
  EXPECT_EQ((*outbox)->pending().size(), 1U);
  (*outbox)->delivered("a");
  ASSERT_TRUE((*outbox)->put(request("a", 3)));
  EXPECT_TRUE((*outbox)->pending().empty());
}

TEST_F(OutboxTest, AnAcknowledgedRequestSurvivesAKill) {
  const pid_t child = ::fork();
  if (child == 0) {
    auto outbox = Outbox::open(file());
    const bool is_stored = outbox && (*outbox)->put(request("a", 1));
    ::kill(::getpid(), is_stored ? SIGKILL : SIGTERM);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_EQ(WTERMSIG(status), SIGKILL);
  auto outbox = Outbox::open(file());
  ASSERT_TRUE(outbox);
  ASSERT_EQ((*outbox)->pending().size(), 1U);
}

TEST_F(OutboxTest, ForgetsTheOld) {
  auto outbox = Outbox::open(file());
  ASSERT_TRUE(outbox);
  ASSERT_TRUE((*outbox)->put(request("a", 1)));
  ASSERT_TRUE((*outbox)->put(request("b", 20)));
  (*outbox)->forget_before(time_from_seconds(10));
  ASSERT_EQ((*outbox)->pending().size(), 1U);
  EXPECT_EQ((*outbox)->pending().front().id, "b");
}

TEST_F(OutboxTest, ADamagedFileIsSetAside) {
  std::ofstream{file()} << std::string(5000, 'x');
  auto outbox = Outbox::open(file());
  ASSERT_TRUE(outbox) << outbox.error().message;
  EXPECT_TRUE((*outbox)->was_damaged());
  EXPECT_TRUE(std::filesystem::exists(file().string() + ".damaged"));
  EXPECT_TRUE((*outbox)->put(request("a", 1)));
}

TEST_F(OutboxTest, AFolderThatIsMissingIsAnError) {
  const auto outbox = Outbox::open(folder_ / "nowhere" / "web.sqlite");
  ASSERT_FALSE(outbox);
  EXPECT_NE(outbox.error().message.find("web.sqlite"), std::string::npos);
}

}  // namespace
}  // namespace docent::telepresence
