#include "docent/recording/rosbag/bag_reader.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>

#include "docent/base/files.h"
#include "docent/recording/mcap/writer.h"
#include "docent/recording/rosbag/bag_metadata.h"
#include "docent/recording/rosbag/unpacking.h"

namespace docent::recording {
namespace {

namespace fs = std::filesystem;

std::string packed(const std::string& bytes) {
  std::string to(ZSTD_compressBound(bytes.size()), '\0');
  to.resize(ZSTD_compress(to.data(), to.size(), bytes.data(), bytes.size(), 3));
  return to;
}

class Bags : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  /// A database whose messages are the numbers from `from` on.
  void write_database(const fs::path& path, int from, int count, bool is_packed) {
    fs::remove(path);
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    sqlite3_exec(database,
                 "BEGIN; CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT); INSERT INTO topics "
                 "VALUES(1, '/n', 'x/msg/N');"
                 "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);",
                 nullptr, nullptr, nullptr);
    for (int i = from; i < from + count; ++i) {
      std::string data = std::to_string(i) + std::string(200, 'x');
      if (is_packed) data = packed(data);
      sqlite3_stmt* statement = nullptr;
      sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id, timestamp, data) VALUES(1, ?, ?)", -1, &statement,
                         nullptr);
      sqlite3_bind_int64(statement, 1, i);
      sqlite3_bind_blob(statement, 2, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
      EXPECT_EQ(sqlite3_step(statement), SQLITE_DONE);
      sqlite3_finalize(statement);
    }
    sqlite3_exec(database, "COMMIT", nullptr, nullptr, nullptr);
    sqlite3_close(database);
  }
  void write_mcap(const fs::path& path, int from, int count) {
    auto writer = McapWriter::create(path);
    const auto channel = *writer->add_channel({"/n", "x/msg/N", "ros2msg", "x", "cdr", {}});
    for (int i = from; i < from + count; ++i) {
      const std::string data = std::to_string(i) + "x";
      ASSERT_TRUE(
          writer->write(channel, Time{i}, Time{i}, {reinterpret_cast<const std::uint8_t*>(data.data()), data.size()}));
    }
    ASSERT_TRUE(writer->close());
  }
  std::vector<int> read(const fs::path& path) {
    notes_.clear();
    std::vector<int> numbers;
    const auto done = read_bag(
        path,
        [&](const Rosbag2Message& message) {
          numbers.push_back(std::atoi(std::string{message.data.begin(), message.data.end()}.c_str()));
          return true;
        },
        notes_);
    EXPECT_TRUE(done) << done.error().message;
    return numbers;
  }
  static std::vector<int> numbers(int from, int count) {
    std::vector<int> all;
    for (int i = from; i < from + count; ++i) all.push_back(i);
    return all;
  }
  fs::path folder_ = fs::temp_directory_path() / ("docent_bags_" + std::to_string(getpid()));
  std::vector<std::string> notes_;
};

TEST_F(Bags, BothCompressionsOfRosbag2) {
  write_database(folder_ / "b_0.db3", 0, 30, true);
  EXPECT_EQ(read(folder_), numbers(0, 30));
  write_database(folder_ / "b_0.db3", 5, 30, false);
  ASSERT_TRUE(write_file_atomically(folder_ / "b_0.db3.zstd", packed(*read_file(folder_ / "b_0.db3"))));
  EXPECT_EQ(read(folder_), numbers(5, 30)) << "not twice";
  fs::remove(folder_ / "b_0.db3");
  ASSERT_TRUE(write_file_atomically(folder_ / "metadata.yaml",
                                    "rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths: "
                                    "[b_0.db3.zstd]\n  compression_format: zstd\n  compression_mode: FILE\n"));
  EXPECT_EQ(read(folder_), numbers(5, 30));
  EXPECT_TRUE(notes_.empty());
  EXPECT_EQ(read(folder_ / "b_0.db3.zstd"), numbers(5, 30));
}

TEST_F(Bags, McapWhoseMessagesArePackedOneByOne) {
  auto writer = McapWriter::create(folder_ / "b_0.mcap");
  const auto channel = *writer->add_channel({"/n", "x/msg/N", "ros2msg", "x", "cdr", {}});
  for (int i = 0; i < 20; ++i) {
    const std::string data = packed(std::to_string(i) + std::string(200, 'x'));
    ASSERT_TRUE(
        writer->write(channel, Time{i}, Time{i}, {reinterpret_cast<const std::uint8_t*>(data.data()), data.size()}));
  }
  ASSERT_TRUE(writer->close());
  EXPECT_EQ(read(folder_), numbers(0, 20));
}

TEST_F(Bags, PartsInTheOrderOfTheMetadata) {
  write_mcap(folder_ / "late.mcap", 10, 10);
  write_mcap(folder_ / "soon.mcap", 0, 10);
  write_mcap(folder_ / "zz.mcap", 20, 5);
  ASSERT_TRUE(write_file_atomically(
      folder_ / "metadata.yaml",
      "rosbag2_bagfile_information:\n  relative_file_paths:\n    - bag/soon.mcap\n    - late.mcap\n    - gone.mcap\n"));
  EXPECT_EQ(read(folder_), numbers(0, 25));
  ASSERT_EQ(notes_.size(), 2U);
  EXPECT_NE(notes_[0].find("gone.mcap"), std::string::npos);
  EXPECT_NE(notes_[1].find("zz.mcap"), std::string::npos);
  ASSERT_TRUE(write_file_atomically(folder_ / "metadata.yaml", "nothing of the kind"));
  EXPECT_EQ(read(folder_).size(), 25U);
  EXPECT_EQ(notes_.size(), 1U);
}

TEST_F(Bags, ATornOrEmptyPartCostsThatPartAlone) {
  write_mcap(folder_ / "b_0.mcap", 0, 10);
  write_mcap(folder_ / "b_1.mcap", 10, 10);
  ASSERT_TRUE(write_file_atomically(folder_ / "b_2.mcap", ""));
  EXPECT_EQ(read(folder_), numbers(0, 20));
  EXPECT_EQ(notes_.size(), 1U);
  const std::string whole = *read_file(folder_ / "b_1.mcap");
  ASSERT_TRUE(write_file_atomically(folder_ / "b_1.mcap", whole.substr(0, 60)));
  EXPECT_EQ(read(folder_), numbers(0, 10));
  fs::remove(folder_ / "b_2.mcap");
  fs::remove(folder_ / "b_1.mcap");
  write_database(folder_ / "b_0.db3", 30, 500, false);
  const std::string database = *read_file(folder_ / "b_0.db3");
  ASSERT_TRUE(write_file_atomically(folder_ / "b_0.db3", database.substr(0, database.size() / 2)));
  EXPECT_GE(read(folder_).size(), 10U) << "the MCAP part stays";
  EXPECT_FALSE(notes_.empty());
}

TEST_F(Bags, OfADatabaseThatIsCutOrDamagedWhatIsWholeIsRead) {
  write_database(folder_ / "b.db3", 0, 2000, false);
  const std::string whole = *read_file(folder_ / "b.db3");
  for (const double share : {0.2, 0.6, 0.61, 0.95}) {
    ASSERT_TRUE(write_file_atomically(folder_ / "b.db3",
                                      whole.substr(0, static_cast<std::size_t>(share * double(whole.size())))));
    const std::vector<int> found = read(folder_ / "b.db3");
    EXPECT_GT(found.size(), 2000 * share - 60) << share;
    EXPECT_EQ(found, numbers(0, static_cast<int>(found.size())));
    ASSERT_EQ(notes_.size(), 1U);
    EXPECT_NE(notes_[0].find("ends early ("), std::string::npos) << notes_[0];
    EXPECT_NE(notes_[0].find("its " + std::to_string(found.size()) + " messages that are whole"), std::string::npos)
        << notes_[0];
  }
  std::string damaged = whole;  // a page in the middle
  std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2 / 4096 * 4096), 4096, '\xff');
  ASSERT_TRUE(write_file_atomically(folder_ / "b.db3", damaged));
  std::vector<int> found = read(folder_ / "b.db3");
  EXPECT_GT(found.size(), 1950U);
  EXPECT_LT(found.size(), 2000U);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(std::unique(found.begin(), found.end()), found.end()) << "each once";
  EXPECT_EQ(found.back(), 1999) << "behind it, too";
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_NE(notes_[0].find("is damaged"), std::string::npos) << notes_[0];
  for (const std::size_t size : {std::size_t{60}, std::size_t{1000}, std::size_t{4096}}) {
    ASSERT_TRUE(write_file_atomically(folder_ / "b.db3", whole.substr(0, size)));
    const auto done = read_bag(
        folder_ / "b.db3", [](const Rosbag2Message&) { return true; }, notes_);
    ASSERT_FALSE(done) << size;
    EXPECT_EQ(done.error().message.rfind((folder_ / "b.db3: ").string(), 0), 0U) << done.error().message;
  }
}

TEST_F(Bags, WhatIsNoRecordingIsAnError) {
  ASSERT_TRUE(write_file_atomically(folder_ / "a.mcap", "no recording"));
  const auto nothing = [](const Rosbag2Message&) { return true; };
  EXPECT_FALSE(read_bag(folder_ / "a.mcap", nothing, notes_));
  fs::remove(folder_ / "a.mcap");
  EXPECT_FALSE(read_bag(folder_, nothing, notes_));
  ASSERT_TRUE(write_file_atomically(folder_ / "old.orig", "#ROSRECORD V1.2\nand so on"));
  EXPECT_TRUE(is_bag(folder_ / "old.orig"));
  const auto old = read_bag(folder_ / "old.orig", nothing, notes_);
  ASSERT_FALSE(old);
  EXPECT_NE(old.error().message.find("rosbag migrate"), std::string::npos) << old.error().message;
  EXPECT_FALSE(is_bag(folder_ / "a.txt"));
  EXPECT_TRUE(is_bag(folder_));
}

TEST(Unpacking, ZstdOfAnySizeAndNoMore) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{200'000}, std::size_t{131'072}}) {
    const std::string text(size, 'a');
    const std::string bytes = packed(text);
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const auto whole = unpack_zstd({data, bytes.size()});
    ASSERT_TRUE(whole) << size;
    EXPECT_EQ(whole->size(), size);
    EXPECT_TRUE(is_zstd({data, bytes.size()}));
    EXPECT_FALSE(unpack_zstd({data, bytes.size() - 1})) << size;
  }
}

}  // namespace
}  // namespace docent::recording
