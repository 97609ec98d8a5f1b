#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "docent/base/result.h"
#include "docent/telepresence/api/exchange/exchange.h"

namespace docent::telepresence {

// From the museum:

/// The newest value of a slot of the live channel.
struct UplinkSlot {
  std::size_t slot = 0;
  std::string text;
};
/// To one viewer of the far gateway.
struct UplinkAnswer {
  std::uint64_t viewer = 0;
  std::string text;
};
struct UplinkReply {
  std::uint64_t call = 0;
  ApiReply reply;
};
/// Some bytes of a camera's picture.
struct UplinkPiece {
  std::string path;   ///< of the picture on the site
  std::string taken;  ///< when it was taken, which names it
  std::size_t total = 0;
  std::size_t offset = 0;
  std::string bytes;
};
using FromMuseum = std::variant<UplinkSlot, UplinkAnswer, UplinkReply, UplinkPiece>;

// To the museum:

struct UplinkMessage {
  std::uint64_t viewer = 0;
  std::string text;  ///< as the viewer sent it
};
struct UplinkCall {
  std::uint64_t call = 0;
  ApiRequest request;
};
/// Somebody opened the page at the far gateway.
struct UplinkArrival {
  std::string address;
};
using ToMuseum = std::variant<UplinkMessage, UplinkCall, UplinkArrival>;

inline constexpr std::size_t kLongestHead = 8192;        ///< bytes of the line of JSON
inline constexpr std::size_t kLongestToMuseum = 65'536;  ///< bytes of a whole frame
/// Whether the museum's end takes that frame; a longer one would cut the line.
[[nodiscard]] bool fits_museum(std::string_view frame);

/// A line of JSON, then what it is about.
[[nodiscard]] std::string encode(const FromMuseum& message);
[[nodiscard]] std::string encode(const ToMuseum& message);
/// Error: it is none.
[[nodiscard]] Result<FromMuseum> decode_from_museum(std::string_view frame);
[[nodiscard]] Result<ToMuseum> decode_to_museum(std::string_view frame);

}  // namespace docent::telepresence
