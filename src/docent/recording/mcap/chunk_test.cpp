#include "docent/recording/mcap/chunk.h"

#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include "docent/recording/mcap/reader.h"

namespace docent::recording {
namespace {

using mcap::ByteWriter;
using mcap::Kind;
using Bytes = std::vector<std::uint8_t>;

constexpr int kMessages = 2000;

/// Channel 1 and its messages: message i at time i, 100 bytes that do not repeat.
Bytes records_of_chunk() {
  Bytes records;
  ByteWriter writer{records};
  const auto channel = writer.begin(Kind::channel);
  writer.number(std::uint16_t{1});
  writer.number(std::uint16_t{0});
  writer.text("/n");
  writer.text("cdr");
  writer.texts({});
  writer.end(channel);
  std::uint32_t noise = 1;
  for (int i = 0; i < kMessages; ++i) {
    const auto message = writer.begin(Kind::message);
    writer.number(std::uint16_t{1});
    writer.number(std::uint32_t{0});
    writer.number(static_cast<std::uint64_t>(i));
    writer.number(static_cast<std::uint64_t>(i));
    for (int k = 0; k < 25; ++k) writer.number(noise = 1664525U * noise + 1013904223U);
    writer.end(message);
  }
  return records;
}

Bytes packed(const Bytes& records, const std::string& compression) {
  if (compression.empty()) return records;
  const bool is_zstd = compression == "zstd";
  Bytes to(is_zstd ? ZSTD_compressBound(records.size()) : LZ4F_compressFrameBound(records.size(), nullptr));
  to.resize(is_zstd ? ZSTD_compress(to.data(), to.size(), records.data(), records.size(), 1)
                    : LZ4F_compressFrame(to.data(), to.size(), records.data(), records.size(), nullptr));
  return to;
}

/// A file of one chunk.
Bytes file_of(const std::string& compression) {
  Bytes file{mcap::kMagic.begin(), mcap::kMagic.end()};
  ByteWriter writer{file};
  const auto header = writer.begin(Kind::header);
  writer.text("ros2");
  writer.text("test");
  writer.end(header);
  const Bytes records = records_of_chunk();
  const Bytes content = packed(records, compression);
  const auto chunk = writer.begin(Kind::chunk);
  writer.number(std::uint64_t{0});
  writer.number(std::uint64_t{kMessages - 1});
  writer.number(static_cast<std::uint64_t>(records.size()));
  writer.number(mcap::crc_of(records));
  writer.text(compression);
  writer.number(static_cast<std::uint64_t>(content.size()));
  writer.raw(content.data(), content.size());
  writer.end(chunk);
  return file;
}

TEST(CutChunk, WhatStandsBeforeTheCutIsRead) {
  for (const std::string compression : {"", "zstd", "lz4"}) {
    const Bytes whole = file_of(compression);
    const Bytes records = records_of_chunk();
    for (const double share : {0.02, 0.3, 0.6, 0.99}) {
      const auto size = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
      auto reader = McapReader::from_bytes({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}, "cut");
      ASSERT_TRUE(reader);
      EXPECT_FALSE(reader->is_complete());
      int next = 0;
      const auto read = reader->read([&](const McapMessage& message) {
        EXPECT_EQ(message.log_time.nanoseconds, next++);
        EXPECT_EQ(message.data.size(), 100U);
        EXPECT_TRUE(std::equal(message.data.begin(), message.data.end(),
                               records.end() - 131 * (kMessages - message.log_time.nanoseconds) + 31));
        return true;
      });
      EXPECT_TRUE(read) << read.error().message;
      EXPECT_TRUE(reader->damage().empty()) << reader->damage().front();
      // zstd and LZ4 are unpacked block by block, of 128 and 64 KiB.
      EXPECT_GT(next, kMessages * share - (compression.empty() ? 20 : 1100)) << compression << " cut at " << share;
      EXPECT_LT(next, kMessages);
    }
  }
}

TEST(CutChunk, AHeadAloneIsNothingAndALieTakesNoMemory) {
  const Bytes whole = file_of("lz4");
  for (std::size_t size = 40; size < 120; ++size) {
    auto reader = McapReader::from_bytes({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}, "cut");
    if (!reader) continue;
    int read = 0;
    EXPECT_TRUE(reader->read([&](const McapMessage&) { return ++read > 0; }));
    EXPECT_EQ(read, 0);
  }
  EXPECT_FALSE(mcap::unpack_cut_chunk({}));
}

}  // namespace
}  // namespace docent::recording
