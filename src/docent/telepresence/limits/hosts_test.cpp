#include "docent/telepresence/limits/hosts.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

namespace docent::telepresence {
namespace {

TEST(HostsTest, AddressesAndOwnNamesAreOurs) {
  std::array<char, 256> own{};
  ASSERT_EQ(::gethostname(own.data(), own.size() - 1), 0);
  const Hosts hosts{{"robot.museum.example", "https.museum.example:8443"}};
  for (const std::string host :
       {"localhost", "LOCALHOST:8080", "127.0.0.1:8080", "192.0.2.7", "[::1]:8080", "[2001:db8::1]",
        "robot.museum.example", "Robot.Museum.Example.:443", "https.museum.example", ""})
    EXPECT_TRUE(hosts.is_ours(host)) << host;
  EXPECT_TRUE(hosts.is_ours(own.data()));
  EXPECT_TRUE(hosts.is_ours(std::string{own.data()} + ".local:8080"));
}

TEST(HostsTest, NamesOfOthersAreNot) {
  const Hosts hosts{{"robot.museum.example"}};
  for (const std::string host :
       {"evil.example", "evil.example:8080", "museum.example", "robot.museum.example.evil.example",
        "127.0.0.1.evil.example", "localhost.evil.example", "evil.example#localhost", "1.2.3", "0x7f.1", "[::1",
        "[evil.example]", ":8080", " localhost", "localhost:80@evil.example", "[::1]evil.example:80", "127.0.0.1:x",
        "robot.museum.example:80.evil.example"})
    EXPECT_FALSE(hosts.is_ours(host)) << host;
}

}  // namespace
}  // namespace docent::telepresence
