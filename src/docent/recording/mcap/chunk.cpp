#include "docent/recording/mcap/chunk.h"

#include <zlib.h>
#include <zstd.h>

#include <cstring>
#include <string>

#include "docent/recording/mcap/lz4.h"

namespace docent::recording::mcap {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t kMaxChunk = std::uint64_t{256} << 20U;

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
  (void)reader.bytes(8 + 8);
  const auto size = reader.number<std::uint64_t>();
  const auto crc = reader.number<std::uint32_t>();
  const std::string compression = reader.text();
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
    return fail("a chunk with unknown compression '" + compression.substr(0, 20) + "'");
  }
  if (crc != 0 && crc != crc_of(records)) return fail("a chunk with a wrong checksum");
  return records;
}

}  // namespace docent::recording::mcap
