#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "docent/telepresence/api/exchange/exchange.h"

// Headers that a client chooses.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text{reinterpret_cast<const char*>(data), size};
  const auto value = docent::telepresence::cookie_value(text, docent::telepresence::kLoginCookie);
  if (value.find(';') != std::string_view::npos) std::abort();
  if (docent::telepresence::forwarded_address(text, "127.0.0.1").size() > 45) std::abort();
  return 0;
}
