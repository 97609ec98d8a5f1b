#include "docent/recording/rosbag/ros1_bag.h"

#include <bzlib.h>
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <unistd.h>

#include <cstring>

#include "docent/base/files.h"
#include "docent/messages/cdr.h"
#include "docent/messages/conversions.h"

namespace docent::recording {
namespace {

/// Bytes as ROS 1 packs them.
struct Packed {
  std::string bytes;
  template <class T>
  Packed& number(T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Packed& text(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes += value;
    return *this;
  }
};

std::string field(const std::string& name, const std::string& value) { return Packed{}.text(name + "=" + value).bytes; }
template <class T>
std::string raw(T value) {
  return Packed{}.number(value).bytes;
}
std::string record(const std::string& head, const std::string& data) { return Packed{}.text(head).text(data).bytes; }

std::string connection(std::uint32_t id, const std::string& topic, const std::string& type) {
  return record(field("op", "\x07") + field("conn", raw(id)) + field("topic", topic),
                field("topic", topic) + field("type", type) + field("md5sum", "*") + field("message_definition", "x"));
}
std::string message(std::uint32_t id, std::uint32_t seconds, const std::string& data) {
  return record(
      field("op", "\x02") + field("conn", raw(id)) + field("time", raw(seconds) + raw(std::uint32_t{500'000'000})),
      data);
}
std::string chunk(const std::string& compression, const std::string& records) {
  std::string packed = records;
  if (compression == "bz2") {
    packed.resize(records.size() + 1000);
    auto size = static_cast<unsigned int>(packed.size());
    BZ2_bzBuffToBuffCompress(packed.data(), &size, const_cast<char*>(records.data()),
                             static_cast<unsigned int>(records.size()), 9, 0, 0);
    packed.resize(size);
  } else if (compression == "lz4") {
    packed.resize(LZ4F_compressFrameBound(records.size(), nullptr));
    packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), records.data(), records.size(), nullptr));
  }
  return record(field("op", "\x05") + field("compression", compression) +
                    field("size", raw(static_cast<std::uint32_t>(records.size()))),
                packed);
}
std::string head(std::uint32_t sequence, std::uint32_t seconds, const std::string& frame) {
  return Packed{}.number(sequence).number(seconds).number(std::uint32_t{250'000'000}).text(frame).bytes;
}
/// Of one beam 0.5 to 2.5 m away in steps.
std::string scan(std::uint32_t seconds) {
  Packed packed;
  packed.bytes = head(7, seconds, "laser");
  for (const float value : {-1.0F, 1.0F, 0.5F, 0.0F, 0.1F, 0.1F, 10.0F}) packed.number(value);
  packed.number(std::uint32_t{5});
  for (int i = 0; i < 5; ++i) packed.number(0.5F * static_cast<float>(i + 1));
  packed.number(std::uint32_t{0});
  return packed.bytes;
}
std::string odometry(std::uint32_t seconds, double x) {
  Packed packed;
  packed.bytes = head(8, seconds, "odom");
  packed.text("base_link");
  for (const double value : {x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) packed.number(value);
  for (int i = 0; i < 36 + 6 + 36; ++i) packed.number(0.0);
  return packed.bytes;
}

class Ros1Bags : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  std::string drive(const std::string& compression) {
    std::string records = connection(3, "scan", "sensor_msgs/LaserScan") + connection(4, "/odom", "nav_msgs/Odometry") +
                          connection(5, "/rosout", "rosgraph_msgs/Log");
    for (std::uint32_t i = 0; i < 20; ++i)
      records += message(4, 100 + i, odometry(100 + i, 0.1 * i)) + message(5, 100 + i, "abc") +
                 message(3, 100 + i, scan(100 + i));
    return "#ROSBAG V2.0\n" +
           record(field("op", "\x03") + field("index_pos", raw(std::uint64_t{0})), std::string(100, ' ')) +
           chunk(compression, records);
  }
  struct Seen {
    int scans = 0, readings = 0;
    std::vector<std::string> notes;
  };
  Seen read(const std::string& bytes) {
    EXPECT_TRUE(write_file_atomically(path_, bytes));
    Seen seen;
    const auto done = read_ros1_bag(
        path_,
        [&](const Rosbag2Message& message) {
          EXPECT_NEAR(to_seconds(message.time), 100.5 + seen.scans, 1e-9);
          if (message.type == sensor_msgs::LaserScan::kType) {
            const auto scan = decode_cdr<sensor_msgs::LaserScan>(message.data);
            EXPECT_TRUE(scan && scan->ranges.size() == 5 && scan->ranges[4] == 2.5F &&
                        scan->header.frame_id == "laser" && scan->range_max == 10.0F);
            EXPECT_EQ(message.topic, "/scan");
            ++seen.scans;
          } else if (message.type != nav_msgs::Odometry::kType) {
            EXPECT_EQ(message.type, "rosgraph_msgs/msg/Log");
            EXPECT_TRUE(message.data.empty());
          } else {
            const auto odometry = decode_cdr<nav_msgs::Odometry>(message.data);
            EXPECT_TRUE(odometry && odometry->child_frame_id == "base_link" &&
                        std::abs(odometry->pose.pose.position.x - 0.1 * seen.readings) < 1e-9);
            ++seen.readings;
          }
          return true;
        },
        seen.notes);
    EXPECT_TRUE(done) << done.error().message;
    return seen;
  }
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("docent_ros1_bag_" + std::to_string(getpid()) + ".bag");
};

TEST_F(Ros1Bags, AllCompressionsAreRead) {
  for (const char* compression : {"none", "bz2", "lz4"}) {
    const Seen seen = read(drive(compression));
    EXPECT_EQ(seen.scans, 20) << compression;
    EXPECT_EQ(seen.readings, 20) << compression;
    EXPECT_TRUE(seen.notes.empty()) << seen.notes.front();
  }
}

TEST_F(Ros1Bags, WhatIsTornCostsWhatItLacks) {
  const std::string first = drive("none"), second = chunk("none", message(3, 120, scan(120)));
  EXPECT_EQ(read(first + second).scans, 21);
  const Seen torn = read(first + second.substr(0, second.size() - 5));
  EXPECT_EQ(torn.scans, 20);
  EXPECT_EQ(torn.notes.size(), 1U);
  std::string damaged = drive("lz4") + second;
  damaged[damaged.size() / 2] ^= 0x55;
  damaged[damaged.size() / 3] ^= 0x55;
  ASSERT_TRUE(write_file_atomically(path_, damaged));
  std::vector<std::string> notes;
  EXPECT_TRUE(read_ros1_bag(
      path_, [](const Rosbag2Message&) { return true; }, notes));
  EXPECT_FALSE(notes.empty());
}

TEST_F(Ros1Bags, OfAChunkThatIsCutWhatCameBeforeIsRead) {
  for (const char* compression : {"none", "bz2", "lz4"}) {
    std::string records = connection(4, "/odom", "nav_msgs/Odometry");
    std::uint32_t noise = 1;
    for (std::uint32_t i = 0; i < 4000; ++i) {
      std::string data = odometry(100 + i, 0.1 * i);
      for (std::size_t at = data.size() - 36 * sizeof(double); at < data.size();
           ++at)  // covariances, which nobody reads
        data[at] = static_cast<char>((noise = 1664525U * noise + 1013904223U) >> 26U);
      records += message(4, 100, data);
    }
    const std::string whole = "#ROSBAG V2.0\n" + chunk(compression, records);
    const Seen seen = read(whole.substr(0, 6 * whole.size() / 10));
    // bzip2 is unpacked in blocks of 900 kB.
    EXPECT_GT(seen.readings, 1000) << compression;
    EXPECT_LT(seen.readings, 4000) << compression;
    ASSERT_EQ(seen.notes.size(), 1U) << compression;
    EXPECT_NE(seen.notes[0].find("ends early"), std::string::npos);
  }
}

TEST_F(Ros1Bags, OtherFormatsAreNamed) {
  ASSERT_TRUE(write_file_atomically(path_, "#ROSBAG V1.2\nabc"));
  std::vector<std::string> notes;
  const auto read = read_ros1_bag(
      path_, [](const Rosbag2Message&) { return true; }, notes);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("another format"), std::string::npos);
}

}  // namespace
}  // namespace docent::recording
