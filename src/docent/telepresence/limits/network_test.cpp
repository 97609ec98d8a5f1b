#include "docent/telepresence/limits/network.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(Network, AnAddressOfTheOldKindIsOneCaller) {
  EXPECT_EQ(network_of("192.0.2.7"), "192.0.2.7");
  EXPECT_EQ(network_of("::ffff:192.0.2.7"), "192.0.2.7") << "however it is written";
}

TEST(Network, AllAddressesOfAHouseholdAreOneCaller) {
  EXPECT_EQ(network_of("2001:db8:1:2:3:4:5:6"), "2001:db8:1:2::/64");
  EXPECT_EQ(network_of("2001:db8:1:2:ffff::1"), network_of("2001:0db8:0001:0002::2"));
  EXPECT_NE(network_of("2001:db8:1:3::1"), network_of("2001:db8:1:2::1"));
  EXPECT_EQ(network_of("fe80::1%wlan0"), "fe80::/64");
}

TEST(Network, WhatIsNoAddressStaysAsItIs) {
  EXPECT_EQ(network_of(""), "");
  EXPECT_EQ(network_of("unknown"), "unknown");
}

}  // namespace
}  // namespace docent::telepresence
