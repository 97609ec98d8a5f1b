#include "docent/recording/mcap/lz4.h"

#include <lz4frame.h>

#include <algorithm>
#include <string>

namespace docent::recording::mcap {
namespace {

constexpr std::size_t kMost = std::size_t{1} << 30U;
constexpr std::size_t kMostGain = 256;  // LZ4 packs no tighter: a lie takes no memory

/// How far unpacking came.
struct Unpacked {
  std::size_t size = 0;   ///< bytes
  bool is_whole = false;  ///< to the frame's end
  bool has_room = true;   ///< for its state
};

Unpacked unpack_into(std::span<std::uint8_t> bytes, std::span<const std::uint8_t> packed) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return {0, false, false};
  std::size_t in = 0, out = 0, hint = 1;
  while (in < packed.size() && hint != 0) {
    std::size_t taken = packed.size() - in, given = bytes.size() - out;
    hint = LZ4F_decompress(context, bytes.data() + out, &given, packed.data() + in, &taken, nullptr);
    if (LZ4F_isError(hint) != 0 || (taken == 0 && given == 0)) break;
    in += taken;
    out += given;
  }
  LZ4F_freeDecompressionContext(context);
  return {out, hint == 0, true};
}

}  // namespace

Result<std::vector<std::uint8_t>> unpack_lz4(std::span<const std::uint8_t> packed, std::size_t size) {
  if (size > kMost || size / kMostGain > packed.size()) return fail("LZ4 data that cannot be so large");
  std::vector<std::uint8_t> bytes(size + 1);  // one more: a frame that holds more than it should shows
  const Unpacked unpacked = unpack_into(bytes, packed);
  if (!unpacked.has_room) return fail("no memory for LZ4");
  if (!unpacked.is_whole || unpacked.size != size) return fail("damaged LZ4 data");
  bytes.resize(size);
  return bytes;
}

std::vector<std::uint8_t> unpack_cut_lz4(std::span<const std::uint8_t> packed, std::size_t size) {
  std::vector<std::uint8_t> bytes(std::min({size, kMost, packed.size() * kMostGain}));
  bytes.resize(unpack_into(bytes, packed).size);
  return bytes;
}

}  // namespace docent::recording::mcap
