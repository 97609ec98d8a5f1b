#include "docent/telepresence/uplink/uplink_door.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

using boost::asio::ip::tcp;
using namespace std::chrono_literals;

constexpr const char* kKey = "0123456789abcdef0123456789abcdef";

TEST(UplinkDoor, LetsInWhoeverHoldsTheKey) {
  for (const std::string key : {kKey, "fedcba9876543210fedcba9876543210"}) {
    boost::asio::io_context io{1};
    std::string came_from;
    std::unique_ptr<WebSocket> line;
    UplinkDoor door{io, {}, [&](std::unique_ptr<WebSocket> opened, const std::string& address) {
                      line = std::move(opened);
                      came_from = address;
                    }};
    ASSERT_TRUE(door.listen({boost::asio::ip::address_v4::loopback(), 0}, kKey));
    tcp::socket socket{io};
    socket.connect({boost::asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(door.port())});
    WebSocket client{std::move(socket), {}, pre_shared(key)};
    std::optional<WebSocket::Error> done;
    client.secure(false, [&](WebSocket::Error error) { done = error; });
    for (const auto end = std::chrono::steady_clock::now() + 5s; std::chrono::steady_clock::now() < end;) {
      io.run_one_for(100ms);
      if (done && (*done || !came_from.empty())) break;
    }
    ASSERT_TRUE(done);
    EXPECT_EQ(came_from, key == kKey ? "127.0.0.1" : "");
    EXPECT_EQ(line != nullptr, key == kKey);
  }
}

TEST(UplinkDoor, APortThatIsTakenIsNamed) {
  boost::asio::io_context io{1};
  UplinkDoor first{io, {}, {}}, second{io, {}, {}};
  const auto loopback = boost::asio::ip::address_v4::loopback();
  ASSERT_TRUE(first.listen({loopback, 0}, kKey));
  const auto taken = second.listen({loopback, static_cast<std::uint16_t>(first.port())}, kKey);
  ASSERT_FALSE(taken);
  EXPECT_NE(taken.error().message.find("in use"), std::string::npos);
}

TEST(SecondHolder, IsWhoeverGoesOnComingWhileOneIsIn) {
  SecondHolder second;
  const SecondHolder::Clock::time_point begin{};
  for (int i = 0; i <= 5; ++i) second.sent_away("192.0.2.7", begin + i * 1s);  // a line that was cut
  EXPECT_EQ(second.address(begin + 6s), "");
  second.came_in();
  for (int i = 20; i <= 35; ++i) second.sent_away("192.0.2.8", begin + i * 1s);
  EXPECT_EQ(second.address(begin + 36s), "192.0.2.8");
  EXPECT_EQ(second.address(begin + 100s), "") << "they have not come for a minute";
}

}  // namespace
}  // namespace docent::telepresence
