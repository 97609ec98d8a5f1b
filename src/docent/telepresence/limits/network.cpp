#include "docent/telepresence/limits/network.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>

namespace docent::telepresence {

std::string network_of(const std::string& address) {
  std::array<unsigned char, 16> bytes{};
  const std::string bare = address.substr(0, address.find('%'));  // without the interface
  if (::inet_pton(AF_INET6, bare.c_str(), bytes.data()) != 1) return address;
  constexpr std::array<unsigned char, 12> kMapped{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff};
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (std::equal(kMapped.begin(), kMapped.end(), bytes.begin())) {
    ::inet_ntop(AF_INET, bytes.data() + kMapped.size(), text.data(), text.size());
    return text.data();
  }
  std::fill(bytes.begin() + 8, bytes.end(), static_cast<unsigned char>(0));
  ::inet_ntop(AF_INET6, bytes.data(), text.data(), text.size());
  return std::string{text.data()} + "/64";
}

}  // namespace docent::telepresence
