#include "docent/modules/edge/record_module.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "docent/base/files.h"
#include "docent/recording/recorder.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

class RecordModuleFolder : public testing::Test {
 protected:
  void SetUp() override {
    state_ = std::filesystem::temp_directory_path() / ("docent_record_" + std::to_string(getpid()));
    std::filesystem::create_directories(state_);
  }
  void TearDown() override { std::filesystem::remove_all(state_); }
  [[nodiscard]] std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator{state_ / "recordings"}) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }
  std::filesystem::path state_;
  museum::Museum museum_;
  robot::RobotConfig config_;
};

TEST_F(RecordModuleFolder, RecordsTheRobotAndTheTruth) {
  transport::VirtualTimeHub hub;
  transport::VirtualTimeHub truth_hub;
  auto bus = hub.connect("record");
  auto robot = hub.connect("robot");
  auto truth = truth_hub.connect("record");
  auto world = truth_hub.connect("world");
  auto module = make_record({*bus, museum_, config_, state_, 1, false, truth.get()});
  ASSERT_TRUE(module) << module.error().message;
  const auto horn = robot->publisher(topics::kHorn);
  const auto contact = world->publisher(topics::kTrueContact);
  for (int i = 1; i <= 50; ++i) {
    horn.publish({});
    contact.publish({});
    truth_hub.run_until(time_from_seconds(0.1 * i));
    hub.run_until(time_from_seconds(0.1 * i));
  }
  EXPECT_EQ((*module)->health().state, "ready");
  module->reset();
  world->publisher(topics::kTrueContact).publish({});  // nobody is there any more
  truth_hub.run_until(time_from_seconds(6));
  ASSERT_EQ(files().size(), 1U);
  auto reader = recording::McapReader::open(files()[0]);
  ASSERT_TRUE(reader);
  EXPECT_TRUE(reader->is_complete());
  EXPECT_EQ(reader->counts_by_topic(),
            (std::map<std::string, std::uint64_t>{{"/docent/horn", 50}, {"/truth/contact", 50}}));
}

TEST_F(RecordModuleFolder, MakesWholeWhatAKilledOneLeft) {
  transport::VirtualTimeHub hub;
  auto robot = hub.connect("robot");
  const auto horn = robot->publisher(topics::kHorn);
  std::filesystem::create_directories(state_ / "recordings");
  const auto left = state_ / "recordings" / "recording-19600101-000000.mcap.part";
  const auto hopeless = state_ / "recordings" / "recording-19600101-000001.mcap.part";
  {
    auto bus = hub.connect("record");
    auto module = make_record({*bus, museum_, config_, state_, 1, false, nullptr});
    ASSERT_TRUE(module);
    for (int i = 1; i <= 50; ++i) {
      horn.publish({});
      hub.run_until(time_from_seconds(0.1 * i));
    }
    const auto unfinished = files();
    ASSERT_EQ(unfinished.size(), 1U);
    std::filesystem::copy_file(unfinished[0], left);  // as it is on the disk at this moment
  }
  ASSERT_TRUE(write_file_atomically(hopeless, "x"));
  auto bus = hub.connect("record");
  {
    auto module = make_record({*bus, museum_, config_, state_, 1, false, nullptr});
    ASSERT_TRUE(module);
    for (int i = 0; i < 500 && (std::filesystem::exists(left) || std::filesystem::exists(hopeless)); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
  }
  EXPECT_TRUE(std::filesystem::exists(hopeless.string() + ".unreadable"));
  auto reader = recording::McapReader::open(std::filesystem::path{left}.replace_extension());
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->is_complete());
  EXPECT_GE(reader->message_count().value_or(0), 40U);
}

TEST_F(RecordModuleFolder, ADiskThatIsGoneDegradesAndNamesTheReason) {
  ASSERT_TRUE(write_file_atomically(state_ / "recordings", "a file where the folder should be"));
  transport::VirtualTimeHub hub;
  auto bus = hub.connect("record");
  auto module = make_record({*bus, museum_, config_, state_, 1, false, nullptr});
  ASSERT_TRUE(module);
  bus->publisher(topics::kHorn).publish({});
  hub.run_until(time_from_seconds(1));
  EXPECT_EQ((*module)->health().state, "degraded");
  EXPECT_NE((*module)->health().reason.find("recordings"), std::string::npos);
}

TEST_F(RecordModuleFolder, ConfigurationIsChecked) {
  transport::VirtualTimeHub hub;
  auto bus = hub.connect("record");
  ASSERT_TRUE(config_.set("record.keep_files=0"));
  const auto module = make_record({*bus, museum_, config_, state_, 1, false, nullptr});
  ASSERT_FALSE(module);
  EXPECT_NE(module.error().message.find("keep_files"), std::string::npos);
}

TEST_F(RecordModuleFolder, DoesNothingInVirtualTime) {
  transport::VirtualTimeHub hub;
  auto bus = hub.connect("record");
  const auto module = make_record({*bus, museum_, config_, state_, 1, true, nullptr});
  ASSERT_TRUE(module);
  bus->publisher(topics::kHorn).publish({});
  hub.run_until(time_from_seconds(1));
  EXPECT_FALSE(std::filesystem::exists(state_ / "recordings"));
}

}  // namespace
}  // namespace docent::modules
