#include "docent/recording/rosbag/unpacking.h"

#include <bzlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <string>

namespace docent::recording {
namespace {

constexpr std::size_t kMost = std::size_t{1} << 30U;

struct FreeStream {
  void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
};
using Stream = std::unique_ptr<ZSTD_DStream, FreeStream>;

}  // namespace

bool is_zstd(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 4 && bytes[0] == 0x28 && bytes[1] == 0xb5 && bytes[2] == 0x2f && bytes[3] == 0xfd;
}

Result<std::vector<std::uint8_t>> unpack_zstd(std::span<const std::uint8_t> packed) {
  const Stream stream{ZSTD_createDStream()};
  std::vector<std::uint8_t> bytes;
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::size_t left = 1;
  while (in.pos < in.size && left != 0) {
    const std::size_t at = bytes.size();
    bytes.resize(at + ZSTD_DStreamOutSize());
    ZSTD_outBuffer out{bytes.data() + at, bytes.size() - at, 0};
    left = ZSTD_decompressStream(stream.get(), &out, &in);
    bytes.resize(at + out.pos);
    if (ZSTD_isError(left) != 0) return fail(std::string{"damaged zstd data: "} + ZSTD_getErrorName(left));
    if (bytes.size() > kMost) return fail("more than a gigabyte in one piece");
    // A full output may hold back more than it took in.
    if (in.pos == in.size && left != 0 && out.pos < out.size) break;
    while (in.pos == in.size && left != 0 && out.pos == out.size) {
      const std::size_t more = bytes.size();
      bytes.resize(more + ZSTD_DStreamOutSize());
      out = {bytes.data() + more, bytes.size() - more, 0};
      left = ZSTD_decompressStream(stream.get(), &out, &in);
      bytes.resize(more + out.pos);
      if (ZSTD_isError(left) != 0) return fail(std::string{"damaged zstd data: "} + ZSTD_getErrorName(left));
      if (bytes.size() > kMost) return fail("more than a gigabyte in one piece");
    }
  }
  if (left != 0) return fail("zstd data that ends early");
  return bytes;
}

Result<std::vector<std::uint8_t>> unpack_bz2(std::span<const std::uint8_t> packed, std::size_t size) {
  if (size > kMost) return fail("more than a gigabyte in one piece");
  std::vector<std::uint8_t> bytes(size);
  auto got = static_cast<unsigned int>(size);
  const int status = BZ2_bzBuffToBuffDecompress(reinterpret_cast<char*>(bytes.data()), &got,
                                                const_cast<char*>(reinterpret_cast<const char*>(packed.data())),
                                                static_cast<unsigned int>(packed.size()), 0, 0);
  if (status != BZ_OK || got != size) return fail("damaged bzip2 data");
  return bytes;
}

std::vector<std::uint8_t> unpack_cut_bz2(std::span<const std::uint8_t> packed, std::size_t size) {
  constexpr std::size_t kPiece = std::size_t{1} << 20U;  // the size may be a lie: memory is taken as it fills
  bz_stream stream{};
  std::vector<std::uint8_t> bytes;
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return bytes;
  stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(packed.data()));
  stream.avail_in = static_cast<unsigned int>(packed.size());
  size = std::min(size, kMost);
  for (bool goes_on = true; goes_on && bytes.size() < size;) {
    const std::size_t at = bytes.size();
    bytes.resize(at + std::min(kPiece, size - at));
    stream.next_out = reinterpret_cast<char*>(bytes.data() + at);
    stream.avail_out = static_cast<unsigned int>(bytes.size() - at);
    const int status = BZ2_bzDecompress(&stream);
    const std::size_t got = bytes.size() - at - stream.avail_out;
    bytes.resize(at + got);
    goes_on = status == BZ_OK && got > 0;
  }
  BZ2_bzDecompressEnd(&stream);
  return bytes;
}

Result<void> unpack_zstd_file(const std::filesystem::path& packed, const std::filesystem::path& to) {
  std::ifstream from{packed, std::ios::binary};
  if (!from) return fail(packed.string() + ": cannot be read");
  std::ofstream out_file{to, std::ios::binary | std::ios::trunc};
  const Stream stream{ZSTD_createDStream()};
  std::vector<char> in_bytes(ZSTD_DStreamInSize()), out_bytes(ZSTD_DStreamOutSize());
  std::size_t left = 1;
  while (from) {
    from.read(in_bytes.data(), static_cast<std::streamsize>(in_bytes.size()));
    ZSTD_inBuffer in{in_bytes.data(), static_cast<std::size_t>(from.gcount()), 0};
    bool is_full = false;
    while (in.pos < in.size || is_full) {
      ZSTD_outBuffer out{out_bytes.data(), out_bytes.size(), 0};
      left = ZSTD_decompressStream(stream.get(), &out, &in);
      if (ZSTD_isError(left) != 0) return fail(packed.string() + ": damaged zstd data: " + ZSTD_getErrorName(left));
      out_file.write(out_bytes.data(), static_cast<std::streamsize>(out.pos));
      is_full = out.pos == out.size;
    }
  }
  if (!out_file.flush()) return fail(to.string() + ": no room to unpack " + packed.string());
  if (left != 0) return fail(packed.string() + ": ends early");
  return {};
}

}  // namespace docent::recording
