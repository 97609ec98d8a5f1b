#include "docent/recording/mcap/chunk.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "docent/recording/mcap/lz4.h"

namespace docent::recording::mcap {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t kMaxChunk = std::uint64_t{256} << 20U;

/// A zstd frame as far as it goes, at most `size` bytes.
std::vector<std::uint8_t> unpack_cut_zstd(Bytes packed, std::uint64_t size) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream{ZSTD_createDStream(), &ZSTD_freeDStream};
  std::vector<std::uint8_t> bytes;
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  for (bool goes_on = true; goes_on && bytes.size() < size;) {
    const std::size_t at = bytes.size();
    bytes.resize(at + static_cast<std::size_t>(std::min<std::uint64_t>(ZSTD_DStreamOutSize(), size - at)));
    ZSTD_outBuffer out{bytes.data() + at, bytes.size() - at, 0};
    const std::size_t left = ZSTD_decompressStream(stream.get(), &out, &in);
    bytes.resize(at + out.pos);
    goes_on = ZSTD_isError(left) == 0 && left != 0 && out.pos > 0;
  }
  return bytes;
}

/// What stands before a chunk's records.
struct ChunkHead {
  std::uint64_t size = 0;  ///< unpacked
  std::uint32_t crc = 0;
  std::string compression;
};
ChunkHead head_of(ByteReader& reader) {
  ChunkHead head;
  (void)reader.bytes(8 + 8);
  head.size = reader.number<std::uint64_t>();
  head.crc = reader.number<std::uint32_t>();
  head.compression = reader.text();
  return head;
}

Error unknown(const std::string& compression) {
  return {"a chunk with unknown compression '" + compression.substr(0, 20) + "'"};
}

}  // namespace

std::uint32_t crc_of(Bytes bytes) { return static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size())); }

Record record_at(Bytes bytes, std::size_t offset) {
  if (offset > bytes.size() || bytes.size() - offset < kRecordHead) return {};
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data() + offset + 1, sizeof length);
  if (length > bytes.size() - offset - kRecordHead) return {};
  const auto size = static_cast<std::size_t>(length);
  return {bytes[offset], bytes.subspan(offset + kRecordHead, size), kRecordHead + size};
}

Result<std::vector<std::uint8_t>> unpack_chunk(Bytes content) {
  ByteReader reader{content};
  const auto [size, crc, compression] = head_of(reader);
  const Bytes packed = reader.bytes(reader.number<std::uint64_t>());
  if (!reader.good()) return fail("a broken chunk");
  if (size > kMaxChunk) return fail("a chunk of more than 256 MiB");
  std::vector<std::uint8_t> records;
  if (compression.empty()) {
    if (packed.size() != size) return fail("a chunk with a wrong size");
    records.assign(packed.begin(), packed.end());
  } else if (compression == "zstd") {
    // The frame says its size too; believing only both keeps a lie from taking memory.
    const unsigned long long declared = ZSTD_getFrameContentSize(packed.data(), packed.size());
    if (declared != ZSTD_CONTENTSIZE_UNKNOWN && declared != size) return fail("a chunk with a wrong size");
    if (size / 20000 > packed.size()) return fail("a chunk that cannot be so large");
    records.resize(static_cast<std::size_t>(size));
    const std::size_t unpacked = ZSTD_decompress(records.data(), records.size(), packed.data(), packed.size());
    if (ZSTD_isError(unpacked) != 0 || unpacked != size) return fail("a chunk that cannot be unpacked");
  } else if (compression == "lz4") {
    auto unpacked = unpack_lz4(packed, static_cast<std::size_t>(size));
    if (!unpacked) return fail("a chunk that cannot be unpacked");
    records = std::move(*unpacked);
  } else {
    return tl::unexpected<Error>(unknown(compression));
  }
  if (crc != 0 && crc != crc_of(records)) return fail("a chunk with a wrong checksum");
  return records;
}

Result<std::vector<std::uint8_t>> unpack_cut_chunk(Bytes content) {
  ByteReader reader{content};
  const ChunkHead head = head_of(reader);
  const auto packed_size = reader.number<std::uint64_t>();
  if (!reader.good()) return fail("a chunk that is cut before its records");
  const Bytes packed = reader.bytes(std::min<std::uint64_t>(packed_size, reader.left()));
  const std::uint64_t size = std::min(head.size, kMaxChunk);
  if (head.compression.empty()) return std::vector<std::uint8_t>(packed.begin(), packed.end());
  if (head.compression == "zstd") return unpack_cut_zstd(packed, size);
  if (head.compression == "lz4") return unpack_cut_lz4(packed, static_cast<std::size_t>(size));
  return tl::unexpected<Error>(unknown(head.compression));
}

}  // namespace docent::recording::mcap
