#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "docent/telepresence/api/exchange/exchange.h"
#include "docent/telepresence/api/exchange/forwarding.h"

// Headers that a client chooses.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text{reinterpret_cast<const char*>(data), size};
  const auto value = docent::telepresence::cookie_value(text, docent::telepresence::kLoginCookie);
  if (value.find(';') != std::string_view::npos) std::abort();
  const auto called = docent::telepresence::as_called({text, text, text, text}, true, "127.0.0.1", "localhost");
  if (called.address.size() > 45 || called.host.find_first_of("\r\n;") != std::string::npos) std::abort();
  if (!called.prefix.empty() && !docent::telepresence::is_path_prefix(called.prefix)) std::abort();
  const std::string cookie = docent::telepresence::cookie_for(called, "a=b; Path=/; HttpOnly");
  if (cookie.find_first_of("\r\n") != std::string::npos) std::abort();
  const auto below = docent::telepresence::below_prefix(text, "/robot");
  if (below && !below->empty() && below->front() != '/') std::abort();
  return 0;
}
