#include "docent/recording/mcap/writer.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "docent/base/files.h"
#include "docent/base/random.h"
#include "docent/recording/mcap/format.h"
#include "docent/recording/mcap/reader.h"
#include "docent/recording/mcap/recovery.h"

namespace docent::recording {
namespace {

using std::filesystem::path;

class Mcap : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("docent_mcap_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  path folder_;
};

McapChannel channel_named(const std::string& topic) {
  return {topic, "std_msgs/msg/" + topic.substr(1), "ros2msg", "string data", "cdr", {{"key", "value of " + topic}}};
}

struct Written {
  std::string topic;
  std::int64_t time;
  std::vector<std::uint8_t> data;
  friend bool operator==(const Written&, const Written&) = default;
};

/// Three channels, random payloads, times that mostly rise.
std::vector<Written> write_random(McapWriter& writer, int count, std::uint64_t seed) {
  Rng rng{seed};
  std::vector<Written> messages;
  std::vector<McapWriter::Channel> channels;
  std::int64_t time = 0;
  for (int i = 0; i < count; ++i) {
    time += rng.integer(0, 20000000);
    const auto which = static_cast<std::size_t>(rng.integer(0, 2));
    while (channels.size() <= which)
      channels.push_back(*writer.add_channel(channel_named("/T" + std::to_string(channels.size()))));
    Written message{"/T" + std::to_string(which), time, {}};
    message.data.resize(static_cast<std::size_t>(rng.integer(0, 3000)));
    for (auto& byte : message.data) byte = static_cast<std::uint8_t>(rng.integer(0, 20));
    EXPECT_TRUE(writer.write(channels[which], Time{time}, Time{time + 5}, message.data));
    messages.push_back(std::move(message));
  }
  return messages;
}

std::vector<Written> read_all(McapReader& reader, const McapReader::Selection& selection = {}) {
  std::vector<Written> messages;
  const auto read = reader.read(selection, [&](const McapMessage& message) {
    EXPECT_EQ(message.publish_time.nanoseconds, message.log_time.nanoseconds + 5);
    EXPECT_EQ(message.channel, channel_named(message.channel.topic));
    messages.push_back(
        {message.channel.topic, message.log_time.nanoseconds, {message.data.begin(), message.data.end()}});
    return true;
  });
  EXPECT_TRUE(read) << read.error().message;
  return messages;
}

TEST_F(Mcap, WhatIsWrittenIsRead) {
  for (const bool compress : {true, false}) {
    McapWriterOptions options;
    options.compress = compress;
    options.chunk_bytes = 100000;
    auto writer = McapWriter::create(folder_ / "a.mcap", options);
    ASSERT_TRUE(writer);
    const auto written = write_random(*writer, 2000, 1);
    EXPECT_EQ(writer->messages(), 2000U);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mcap"));
    ASSERT_TRUE(writer->close());
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mcap.part"));
    auto reader = McapReader::open(folder_ / "a.mcap");
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_TRUE(reader->is_complete());
    EXPECT_EQ(reader->profile(), "ros2");
    EXPECT_EQ(reader->message_count(), 2000U);
    std::uint64_t sum = 0;
    for (const auto& [topic, count] : reader->counts_by_topic()) sum += count;
    EXPECT_EQ(sum, 2000U);
    EXPECT_EQ(read_all(*reader), written);
    std::filesystem::remove(folder_ / "a.mcap");
  }
}

TEST_F(Mcap, ALinkStaysAndItsFileIsWritten) {
  std::filesystem::create_directories(folder_ / "far");
  std::filesystem::create_symlink("far/b.mcap", folder_ / "a.mcap");
  auto writer = McapWriter::create(folder_ / "a.mcap");
  ASSERT_TRUE(writer);
  const auto written = write_random(*writer, 100, 1);
  EXPECT_EQ(unfinished_path(folder_ / "a.mcap"), folder_ / "far" / "b.mcap.part");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "far" / "b.mcap.part"));
  ASSERT_TRUE(writer->close());
  ASSERT_TRUE(recover_mcap(folder_ / "a.mcap", folder_ / "a.mcap"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "a.mcap"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder_ / "far"}, {}), 1);
  auto reader = McapReader::open(folder_ / "far" / "b.mcap");
  ASSERT_TRUE(reader);
  EXPECT_EQ(read_all(*reader), written);
}

/// What `write` writes to a pipe of this name, 64 kB at most.
std::vector<std::uint8_t> through_pipe(const path& pipe, const std::function<void()>& write) {
  EXPECT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int end = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  write();
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  std::vector<std::uint8_t> bytes(1U << 17U);
  std::size_t size = 0;
  for (ssize_t got = 0; (got = ::read(end, bytes.data() + size, bytes.size() - size)) > 0;)
    size += static_cast<std::size_t>(got);
  close(end);
  bytes.resize(size);
  return bytes;
}

TEST_F(Mcap, APipeIsWrittenIntoAndStays) {
  std::vector<Written> written;
  const auto streamed = through_pipe(folder_ / "pipe", [&] {
    auto writer = McapWriter::create(folder_ / "pipe");
    ASSERT_TRUE(writer);
    written = write_random(*writer, 20, 1);
    ASSERT_TRUE(writer->close());
  });
  auto reader = McapReader::from_bytes(streamed, "pipe");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->is_complete());
  EXPECT_EQ(read_all(*reader), written);

  auto file = McapWriter::create(folder_ / "a.mcap");
  write_random(*file, 20, 1);
  ASSERT_TRUE(file->close());
  const auto recovered = through_pipe(folder_ / "recovered",
                                      [&] { EXPECT_TRUE(recover_mcap(folder_ / "a.mcap", folder_ / "recovered")); });
  auto again = McapReader::from_bytes(recovered, "pipe");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(read_all(*again), written);
}

TEST_F(Mcap, ABrokenPipeFailsForGood) {
  const auto handled_before = std::signal(SIGPIPE, SIG_IGN);
  const path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int end = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  auto writer = McapWriter::create(pipe);
  ASSERT_TRUE(writer);
  close(end);
  const auto channel = writer->add_channel(channel_named("/T0"));
  ASSERT_TRUE(writer->write(*channel, Time{1}, Time{6}, {}));
  EXPECT_EQ(writer->flush().error().message, pipe.string() + ": cannot be written: Broken pipe");
  EXPECT_EQ(writer->close().error().message, pipe.string() + ": the recording has failed before");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  std::signal(SIGPIPE, handled_before);
}

TEST_F(Mcap, SelectsByTopicAndTimeAndStopsWhenTold) {
  auto writer = McapWriter::create(folder_ / "a.mcap");
  ASSERT_TRUE(writer);
  const auto written = write_random(*writer, 1000, 2);
  ASSERT_TRUE(writer->close());
  auto reader = McapReader::open(folder_ / "a.mcap");
  ASSERT_TRUE(reader);
  const std::int64_t from = written[300].time;
  const std::int64_t to = written[600].time;
  std::vector<Written> expected;
  for (const Written& message : written)
    if (message.topic == "/T1" && message.time >= from && message.time <= to) expected.push_back(message);
  McapReader::Selection selection;
  selection.topics = {"/T1"};
  selection.from = Time{from};
  selection.to = Time{to};
  EXPECT_EQ(read_all(*reader, selection), expected);
  int seen = 0;
  ASSERT_TRUE(reader->read([&](const McapMessage&) { return ++seen < 7; }));
  EXPECT_EQ(seen, 7);
}

TEST_F(Mcap, OverlappingChunksComeInTheOrderOfTime) {
  McapWriterOptions options;
  options.chunk_bytes = 1;  // a chunk a message
  auto writer = McapWriter::create(folder_ / "a.mcap", options);
  ASSERT_TRUE(writer);
  const auto channel = writer->add_channel(channel_named("/T0"));
  for (const std::int64_t time : {50, 10, 40, 20, 30})
    ASSERT_TRUE(writer->write(*channel, Time{time}, Time{time + 5}, {}));
  ASSERT_TRUE(writer->close());
  auto reader = McapReader::open(folder_ / "a.mcap");
  ASSERT_TRUE(reader);
  std::vector<std::int64_t> times;
  ASSERT_TRUE(reader->read([&](const McapMessage& message) {
    times.push_back(message.log_time.nanoseconds);
    return true;
  }));
  EXPECT_EQ(times, (std::vector<std::int64_t>{10, 20, 30, 40, 50}));
}

TEST_F(Mcap, AnEmptyRecordingIsARecording) {
  auto writer = McapWriter::create(folder_ / "a.mcap");
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->close());
  auto reader = McapReader::open(folder_ / "a.mcap");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->is_complete());
  EXPECT_TRUE(read_all(*reader).empty());
}

TEST_F(Mcap, AKilledRecorderLosesAtMostTheLastChunk) {
  const path file = folder_ / "killed.mcap";
  const pid_t child = fork();
  if (child == 0) {
    auto writer = McapWriter::create(file);
    write_random(*writer, 1000, 3);  // about 10 s of messages in chunks of at most 1 s
    raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));

  auto twin = McapWriter::create(folder_ / "whole.mcap");
  const auto written = write_random(*twin, 1000, 3);
  auto reader = McapReader::open(file);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_FALSE(reader->is_complete());
  const auto read = read_all(*reader);
  ASSERT_GT(read.size(), 800U);
  EXPECT_GE(read.back().time, written.back().time - 1100000000);
  EXPECT_TRUE(std::equal(read.begin(), read.end(), written.begin()));

  const auto report = recover_mcap(file, file);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->messages, read.size());
  EXPECT_EQ(report->damage.size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(unfinished_path(file)));
  auto recovered = McapReader::open(file);
  ASSERT_TRUE(recovered);
  EXPECT_TRUE(recovered->is_complete());
  EXPECT_EQ(recovered->message_count(), read.size());
  EXPECT_EQ(read_all(*recovered), read);
}

TEST_F(Mcap, ReadsWhatIsLeftOfAFileCutAnywhere) {
  McapWriterOptions options;
  options.chunk_bytes = 20000;
  auto writer = McapWriter::create(folder_ / "a.mcap", options);
  ASSERT_TRUE(writer);
  const auto written = write_random(*writer, 200, 4);
  ASSERT_TRUE(writer->close());
  const auto bytes = read_file(folder_ / "a.mcap");
  ASSERT_TRUE(bytes);
  Rng rng{5};
  std::size_t most = 0;
  for (int i = 0; i < 300; ++i) {
    const auto size = static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(bytes->size()) - 1));
    auto reader = McapReader::from_bytes({bytes->begin(), bytes->begin() + static_cast<std::ptrdiff_t>(size)}, "cut");
    if (!reader) {
      EXPECT_LT(size, 64U);
      continue;
    }
    EXPECT_FALSE(reader->is_complete());
    const auto read = read_all(*reader);
    EXPECT_TRUE(std::equal(read.begin(), read.end(), written.begin()));
    most = std::max(most, read.size());
  }
  EXPECT_EQ(most, 200U);
}

/// A chunk with these messages of channel 1, which it tells where `tells_channel`.
void append_chunk(std::vector<std::uint8_t>& file, std::vector<std::uint64_t> times, bool tells_channel) {
  using mcap::ByteWriter;
  using mcap::Kind;
  std::vector<std::uint8_t> records;
  ByteWriter inner{records};
  const McapChannel channel = channel_named("/T0");
  if (tells_channel) {
    const auto schema = inner.begin(Kind::schema);
    inner.number(std::uint16_t{1});
    inner.text(channel.type);
    inner.text(channel.schema_encoding);
    inner.text(channel.schema);
    inner.end(schema);
    const auto told = inner.begin(Kind::channel);
    inner.number(std::uint16_t{1});
    inner.number(std::uint16_t{1});
    inner.text(channel.topic);
    inner.text(channel.encoding);
    inner.texts(channel.metadata);
    inner.end(told);
  }
  for (const std::uint64_t time : times) {
    const auto message = inner.begin(Kind::message);
    inner.number(std::uint16_t{1});
    inner.number(std::uint32_t{0});
    inner.number(time);
    inner.number(time + 5);
    inner.number(static_cast<std::uint8_t>(time));
    inner.end(message);
  }
  ByteWriter writer{file};
  const auto chunk = writer.begin(Kind::chunk);
  writer.number(times.front());
  writer.number(times.back());
  writer.number(static_cast<std::uint64_t>(records.size()));
  writer.number(std::uint32_t{0});
  writer.text("");
  writer.number(static_cast<std::uint64_t>(records.size()));
  writer.raw(records.data(), records.size());
  writer.end(chunk);
}

TEST_F(Mcap, ChunksInAnotherOrderThanTheirTimesTellTheirChannelsOnce) {
  std::vector<std::uint8_t> file{mcap::kMagic.begin(), mcap::kMagic.end()};
  mcap::ByteWriter writer{file};
  const auto header = writer.begin(mcap::Kind::header);
  writer.text("ros2");
  writer.text("merged");
  writer.end(header);
  append_chunk(file, {70, 80}, true);
  append_chunk(file, {10, 90}, false);  // overlaps the first
  append_chunk(file, {20, 30}, false);
  auto reader = McapReader::from_bytes(file, "merged");
  ASSERT_TRUE(reader) << reader.error().message;
  for (int again = 0; again < 2; ++again) {
    std::vector<std::int64_t> times;
    for (const Written& message : read_all(*reader)) times.push_back(message.time);
    EXPECT_EQ(times, (std::vector<std::int64_t>{10, 20, 30, 70, 80, 90}));
  }
  EXPECT_TRUE(reader->damage().empty());
}

TEST_F(Mcap, DamageIsNamedOrLeftOut) {
  McapWriterOptions options;
  options.chunk_bytes = 20000;
  auto writer = McapWriter::create(folder_ / "a.mcap", options);
  ASSERT_TRUE(writer);
  const auto written = write_random(*writer, 200, 6);
  ASSERT_TRUE(writer->close());
  auto bytes = read_file(folder_ / "a.mcap");
  ASSERT_TRUE(bytes);
  (*bytes)[bytes->size() / 2] = static_cast<char>(~(*bytes)[bytes->size() / 2]);
  ASSERT_TRUE(write_file_atomically(folder_ / "b.mcap", *bytes));
  auto reader = McapReader::open(folder_ / "b.mcap");
  ASSERT_TRUE(reader);
  const auto strict = reader->read([](const McapMessage&) { return true; });
  ASSERT_FALSE(strict);
  EXPECT_EQ(strict.error().message.rfind((folder_ / "b.mcap").string() + ": ", 0), 0U);
  EXPECT_NE(strict.error().message.find("chunk"), std::string::npos) << strict.error().message;
  const auto report = recover_mcap(folder_ / "b.mcap", folder_ / "c.mcap");
  ASSERT_TRUE(report);
  EXPECT_EQ(report->damage.size(), 1U);
  EXPECT_LT(report->messages, written.size());
  EXPECT_GT(report->messages, written.size() - 60);
}

TEST_F(Mcap, WhatIsNoRecordingIsSaidSo) {
  ASSERT_TRUE(write_file_atomically(folder_ / "text", "hello"));
  ASSERT_TRUE(write_file_atomically(folder_ / "empty", ""));
  for (const path& file : {folder_ / "text", folder_ / "empty", folder_ / "absent", folder_}) {
    const auto reader = McapReader::open(file);
    ASSERT_FALSE(reader) << file;
    EXPECT_EQ(reader.error().message.rfind(file.string() + ": ", 0), 0U) << reader.error().message;
  }
  EXPECT_FALSE(McapWriter::create("/nowhere/at/all.mcap"));
}

TEST_F(Mcap, AFullDiskIsAnErrorAndTheFileStaysReadable) {
  const path file = folder_ / "full.mcap";
  const pid_t child = fork();
  if (child == 0) {
    // A limit on the file's size stands in for the full disk.
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{300000, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &limit);
    McapWriterOptions options;
    options.compress = false;
    auto writer = McapWriter::create(file, options);
    const auto channel = writer->add_channel(channel_named("/T0"));
    int failures = 0;
    for (int i = 0; i < 100; ++i)
      failures +=
          writer->write(*channel, Time{i * 200000000LL}, Time{i * 200000000LL + 5}, std::vector<std::uint8_t>(10000))
              ? 0
              : 1;
    _exit(failures > 0 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  auto reader = McapReader::open(file);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_GE(read_all(*reader).size(), 20U);
}

}  // namespace
}  // namespace docent::recording
