#include "docent/recording/mcap/lz4.h"

#include <lz4frame.h>

#include <string>

namespace docent::recording::mcap {

Result<std::vector<std::uint8_t>> unpack_lz4(std::span<const std::uint8_t> packed, std::size_t size) {
  constexpr std::size_t kMost = std::size_t{1} << 30U;
  constexpr std::size_t kMostGain = 256;  // LZ4 packs no tighter: a lie takes no memory
  if (size > kMost || size / kMostGain > packed.size()) return fail("LZ4 data that cannot be so large");
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return fail("no memory for LZ4");
  std::vector<std::uint8_t> bytes(size + 1);  // one more: a frame that holds more than it should shows
  std::size_t in = 0, out = 0, hint = 1;
  while (in < packed.size() && hint != 0) {
    std::size_t taken = packed.size() - in, given = bytes.size() - out;
    hint = LZ4F_decompress(context, bytes.data() + out, &given, packed.data() + in, &taken, nullptr);
    if (LZ4F_isError(hint) != 0 || (taken == 0 && given == 0)) break;
    in += taken;
    out += given;
  }
  const bool is_damaged = LZ4F_isError(hint) != 0;
  LZ4F_freeDecompressionContext(context);
  if (is_damaged || hint != 0 || out != size) return fail("damaged LZ4 data");
  bytes.resize(size);
  return bytes;
}

}  // namespace docent::recording::mcap
