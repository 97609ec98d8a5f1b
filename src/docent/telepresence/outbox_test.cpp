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
  void TearDown() override {
    database_.reset();
    std::filesystem::remove_all(folder_);
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "web.sqlite"; }
  [[nodiscard]] Result<std::unique_ptr<Outbox>> open() {
    database_.reset();
    auto database = Database::open(file().string());
    if (!database) return tl::unexpected<Error>(database.error());
    database_ = std::move(*database);
    return Outbox::open(*database_);
  }
  std::filesystem::path folder_;
  std::unique_ptr<Database> database_;
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
    auto outbox = open();
    ASSERT_TRUE(outbox) << outbox.error().message;
    ASSERT_TRUE((*outbox)->put(request("b", 2)));
    ASSERT_TRUE((*outbox)->put(request("a", 1)));
    ASSERT_TRUE((*outbox)->put(request("c", 3)));
    ASSERT_TRUE((*outbox)->delivered("c"));
    EXPECT_EQ((*outbox)->pending()->size(), 2U);
  }
  auto outbox = open();
  ASSERT_TRUE(outbox);
  ASSERT_EQ((*outbox)->pending()->size(), 2U);
  const auto first = (*outbox)->pending()->front();
  EXPECT_EQ(first.id, "a");
  EXPECT_EQ(first.visitor, "Zo\xc3\xab");
  EXPECT_EQ(first.kind, "exhibit");
  EXPECT_EQ(first.target, "sputnik");
  EXPECT_EQ(first.viewpoint, 3);
  EXPECT_EQ(first.language, "de");
  EXPECT_EQ(from_message(first.stamp), time_from_seconds(1));
}

TEST_F(OutboxTest, AskingTwiceIsAskingOnce) {
  auto outbox = open();
  ASSERT_TRUE(outbox);
  EXPECT_EQ((*outbox)->put(request("a", 1)), true);
  EXPECT_EQ((*outbox)->put(request("a", 2)), false);
  EXPECT_EQ((*outbox)->pending()->size(), 1U);
  ASSERT_TRUE((*outbox)->delivered("a"));
  EXPECT_EQ((*outbox)->put(request("a", 3)), false);
  EXPECT_TRUE((*outbox)->pending()->empty());
}

TEST_F(OutboxTest, AnAcknowledgedRequestSurvivesAKill) {
  const pid_t child = ::fork();
  if (child == 0) {
    auto outbox = open();
    const bool is_stored = outbox && (*outbox)->put(request("a", 1));
    ::kill(::getpid(), is_stored ? SIGKILL : SIGTERM);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_EQ(WTERMSIG(status), SIGKILL);
  auto outbox = open();
  ASSERT_TRUE(outbox);
  ASSERT_EQ((*outbox)->pending()->size(), 1U);
}

TEST_F(OutboxTest, ForgetsTheOld) {
  auto outbox = open();
  ASSERT_TRUE(outbox);
  ASSERT_TRUE((*outbox)->put(request("a", 1)));
  ASSERT_TRUE((*outbox)->put(request("b", 20)));
  ASSERT_TRUE((*outbox)->forget_before(time_from_seconds(10)));
  ASSERT_EQ((*outbox)->pending()->size(), 1U);
  EXPECT_EQ((*outbox)->pending()->front().id, "b");
}

TEST_F(OutboxTest, TellsWhatAnotherGatewayTook) {
  auto outbox = open();
  ASSERT_TRUE(outbox);
  auto connection = Database::open(file().string());
  ASSERT_TRUE(connection);
  auto other = Outbox::open(**connection);
  ASSERT_TRUE(other);
  ASSERT_TRUE((*other)->put(request("a", 1)));
  ASSERT_EQ((*outbox)->pending()->size(), 1U);
  ASSERT_TRUE((*outbox)->delivered("a"));
  EXPECT_TRUE((*other)->pending()->empty());
}

}  // namespace
}  // namespace docent::telepresence
