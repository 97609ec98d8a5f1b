#include <cstdlib>

#include "docent/telepresence/foxglove/protocol.h"

// Whatever a client says, the parser neither fails nor lets through more than a client may ask for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace docent::telepresence;
  const auto request = parse_foxglove_request({reinterpret_cast<const char*>(data), size});
  if (!request) return 0;
  if (const auto* subscribe = std::get_if<FoxgloveSubscribe>(&*request))
    if (subscribe->subscriptions.size() > kMostSubscriptions) std::abort();
  if (const auto* other = std::get_if<FoxgloveOther>(&*request))
    if (other->operation.size() > 64 || encode_status(1, other->operation).empty()) std::abort();
  return 0;
}
