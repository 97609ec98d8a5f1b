#include "docent/recording/recorder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/messages/random_message.h"

namespace docent::recording {
namespace {

class RecorderFile : public testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() / ("docent_recorder_" + std::to_string(getpid()) + ".mcap");
  }
  void TearDown() override { std::filesystem::remove(file_); }
  std::filesystem::path file_;
};

TEST_F(RecorderFile, EveryTopicComesBackAsItWas) {
  auto recorder = Recorder::create(file_);
  ASSERT_TRUE(recorder);
  std::vector<std::pair<std::string, std::vector<std::uint8_t>>> written;
  std::int64_t time = 0;
  const auto write = [&]<class T>(const Topic<T>& topic) {
    const auto message = std::make_shared<const T>(random_message<T>(static_cast<std::uint64_t>(time) + 1));
    ASSERT_TRUE(recorder->write(transport::topic_info(topic), Time{time += 1000000}, message));
    written.emplace_back(topic.name, encode_cdr(*message));
  };
  for_each_robot_topic(write);
  for_each_truth_topic(write);
  ASSERT_TRUE(recorder->close());

  auto reader = McapReader::open(file_);
  ASSERT_TRUE(reader);
  std::size_t next = 0;
  const auto read = read_recording(*reader, {}, [&](const RecordedMessage& message) {
    EXPECT_EQ(message.topic.name, written[next].first);
    EXPECT_EQ(message.topic.type->encode(message.message.get()), written[next].second);
    ++next;
    return true;
  });
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(next, written.size());
  EXPECT_GE(next, 30U);
}

TEST_F(RecorderFile, ATopicOfAnotherTypeIsAnError) {
  auto writer = McapWriter::create(file_);
  const auto channel = writer->add_channel({"/scan_front", "std_msgs/msg/String", "ros2msg", "string data", "cdr", {}});
  const auto foreign = writer->add_channel({"/image", "sensor_msgs/msg/Image", "ros2msg", "uint8[] data", "cdr", {}});
  ASSERT_TRUE(writer->write(*foreign, Time{1}, Time{1}, {}));
  ASSERT_TRUE(writer->write(*channel, Time{2}, Time{2}, {}));
  ASSERT_TRUE(writer->close());
  auto reader = McapReader::open(file_);
  const auto read = read_recording(*reader, {}, [](const RecordedMessage&) { return true; });
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("/scan_front"), std::string::npos);
}

TEST_F(RecorderFile, ADamagedMessageIsAnError) {
  auto writer = McapWriter::create(file_);
  const RecordedTopic& topic = *find_recorded_topic("/docent/belief");
  const auto channel =
      writer->add_channel({"/docent/belief", topic.info.type->name, "ros2msg", topic.schema, "cdr", {}});
  const std::vector<std::uint8_t> bytes{0, 1, 0, 0, 9};
  ASSERT_TRUE(writer->write(*channel, Time{2000000000}, Time{2}, bytes));
  ASSERT_TRUE(writer->close());
  auto reader = McapReader::open(file_);
  const auto read = read_recording(*reader, {}, [](const RecordedMessage&) { return true; });
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("damaged docent_msgs/msg/Belief"), std::string::npos) << read.error().message;
}

TEST(RecordedTopics, AreKnownByBothNames) {
  ASSERT_NE(find_recorded_topic("scan_front"), nullptr);
  EXPECT_EQ(find_recorded_topic("scan_front"), find_recorded_topic("/scan_front"));
  EXPECT_NE(find_recorded_topic("/truth/state"), nullptr);
  EXPECT_EQ(find_recorded_topic("rosout"), nullptr);
  EXPECT_NE(find_recorded_topic("odom")->schema.find("MSG: geometry_msgs/TwistWithCovariance"), std::string::npos);
}

}  // namespace
}  // namespace docent::recording
