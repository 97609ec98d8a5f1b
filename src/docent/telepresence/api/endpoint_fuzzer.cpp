#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "docent/telepresence/api/endpoint.h"
#include "docent/telepresence/client_message.h"

// Targets of requests.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace docent::telepresence;
  const std::string target = "/api/v1" + std::string{reinterpret_cast<const char*>(data), size};
  std::map<std::string, std::string> path;
  for (const char* method : {"GET", "POST", "PUT", "DELETE"}) {
    if (!find_endpoint(endpoints(), method, target, path)) continue;
    for (const auto& [name, value] : path)
      if (!is_identifier(value)) std::abort();
  }
  (void)parse_query(target);
  return 0;
}
