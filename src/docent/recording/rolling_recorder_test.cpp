#include "docent/recording/rolling_recorder.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace docent::recording {
namespace {

class RollingFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("docent_rolling_" + std::to_string(getpid()));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator{folder_}) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }
  std::filesystem::path folder_;
};

TEST_F(RollingFolder, BeginsNewFilesThatStandAloneAndRemovesTheOldest) {
  RollingRecorderParams params;
  params.max_hours = 1.0;
  params.keep_files = 3;
  {
    RollingRecorder recorder{folder_, params};
    const auto limits = std::make_shared<docent_msgs::Limits>();
    ASSERT_TRUE(recorder.write(transport::topic_info(topics::kLimits), Time{0}, limits));
    for (int minute = 0; minute < 5 * 60; minute += 10)
      ASSERT_TRUE(recorder.write(transport::topic_info(topics::kHorn), time_from_seconds(60.0 * minute),
                                 std::make_shared<docent_msgs::Horn>()));
    EXPECT_EQ(recorder.file().filename(), "recording-19700101-044000.mcap");
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"recording-19700101-022000.mcap", "recording-19700101-033000.mcap",
                                               "recording-19700101-044000.mcap"}));
  auto reader = McapReader::open(folder_ / "recording-19700101-033000.mcap");
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->counts_by_topic(),
            (std::map<std::string, std::uint64_t>{{"/docent/horn", 7}, {"/docent/limits", 1}}));
}

TEST_F(RollingFolder, TwoRecordersOfOneSecondDoNotOverwriteEachOther) {
  for (int i = 0; i < 2; ++i) {
    RollingRecorder recorder{folder_, {}};
    ASSERT_TRUE(recorder.write(transport::topic_info(topics::kHorn), Time{5}, std::make_shared<docent_msgs::Horn>()));
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"recording-19700101-000000-2.mcap", "recording-19700101-000000.mcap"}));
}

TEST_F(RollingFolder, AFolderThatCannotBeMadeIsAnError) {
  RollingRecorder recorder{"/proc/nowhere", {}};
  const auto written =
      recorder.write(transport::topic_info(topics::kHorn), Time{5}, std::make_shared<docent_msgs::Horn>());
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("/proc/nowhere"), std::string::npos);
}

}  // namespace
}  // namespace docent::recording
