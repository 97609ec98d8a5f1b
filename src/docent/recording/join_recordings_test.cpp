#include "docent/recording/join_recordings.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/base/files.h"
#include "docent/recording/recorder.h"

namespace docent::recording {
namespace {

class JoinRecordings : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("docent_join_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Horns number `first` … `last`, one a second.
  std::filesystem::path record(const std::string& name, int first, int last) {
    auto recorder = Recorder::create(folder_ / name);
    EXPECT_TRUE(recorder.has_value());
    for (int i = first; i <= last; ++i) {
      docent_msgs::Horn horn;
      horn.reason = std::to_string(i);
      EXPECT_TRUE(recorder->write(transport::topic_info(topics::kHorn), time_from_seconds(i),
                                  std::make_shared<const docent_msgs::Horn>(horn)));
    }
    EXPECT_TRUE(recorder->close().has_value());
    return folder_ / name;
  }
  static std::string horns_of(const std::filesystem::path& file) {
    auto reader = McapReader::open(file);
    EXPECT_TRUE(reader.has_value());
    EXPECT_TRUE(reader->is_complete());
    std::string all;
    EXPECT_TRUE(read_recording(*reader, {}, [&](const RecordedMessage& message) {
      all += message.as(topics::kHorn)->reason + " ";
      return true;
    }));
    return all;
  }
  std::filesystem::path folder_;
};

TEST_F(JoinRecordings, OneAfterTheOther) {
  const auto first = record("a.mcap", 1, 3);
  const auto second = record("b.mcap", 4, 5);
  ASSERT_TRUE(join_recordings({first, second}, folder_ / "all.mcap").has_value());
  EXPECT_EQ(horns_of(folder_ / "all.mcap"), "1 2 3 4 5 ");
}

TEST_F(JoinRecordings, WhatAKilledRecorderLeftIsReadAsFarAsItGoes) {
  const auto first = record("a.mcap", 1, 400);
  auto bytes = read_file(first);
  ASSERT_TRUE(bytes.has_value());
  ASSERT_TRUE(write_file_atomically(folder_ / "a.mcap.part", bytes->substr(0, bytes->size() / 2)));
  std::filesystem::remove(first);
  const auto second = record("b.mcap", 401, 402);
  EXPECT_EQ(recordings_in(folder_), (std::set{first, second}));
  ASSERT_TRUE(join_recordings({first, second}, folder_ / "all.mcap").has_value());
  const std::string horns = horns_of(folder_ / "all.mcap");
  EXPECT_TRUE(horns.starts_with("1 2 3 ")) << horns;
  EXPECT_TRUE(horns.ends_with(" 401 402 ")) << horns;
}

TEST_F(JoinRecordings, NothingIsAFault) {
  EXPECT_FALSE(join_recordings({}, folder_ / "all.mcap").has_value());
  EXPECT_FALSE(join_recordings({folder_ / "none.mcap"}, folder_ / "all.mcap").has_value());
  EXPECT_TRUE(recordings_in(folder_ / "nowhere").empty());
}

}  // namespace
}  // namespace docent::recording
