#include <cstddef>
#include <cstdint>

#include "docent/telepresence/uplink/envelope/envelope.h"
#include "docent/telepresence/uplink/envelope/picture_pieces.h"

// What comes over the line between museum and far gateway.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace docent::telepresence;
  const std::string_view frame{reinterpret_cast<const char*>(data), size};
  (void)decode_to_museum(frame);
  const auto message = decode_from_museum(frame);
  PictureJoiner joiner;
  if (message && std::holds_alternative<UplinkPiece>(*message)) (void)joiner.add(std::get<UplinkPiece>(*message));
  return 0;
}
