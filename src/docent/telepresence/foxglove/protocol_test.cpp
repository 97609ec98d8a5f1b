#include "docent/telepresence/foxglove/protocol.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace docent::telepresence {
namespace {

using Json = nlohmann::json;

TEST(FoxgloveProtocol, TellsItsChannelsWithTheirSchemas) {
  const std::vector<FoxgloveChannel> channels{{7, "/pose", "geometry_msgs/msg/Pose", "float64 x\n"}};
  const Json told = Json::parse(encode_advertise(channels));
  EXPECT_EQ(told["op"], "advertise");
  const Json& channel = told["channels"].at(0);
  EXPECT_EQ(channel["id"], 7);
  EXPECT_EQ(channel["topic"], "/pose");
  EXPECT_EQ(channel["encoding"], "cdr");
  EXPECT_EQ(channel["schemaName"], "geometry_msgs/msg/Pose");
  EXPECT_EQ(channel["schemaEncoding"], "ros2msg");
  EXPECT_EQ(Json::parse(encode_server_info("Docent", "1"))["op"], "serverInfo");
}

TEST(FoxgloveProtocol, LaysAMessageOutInLittleEndian) {
  const std::vector<std::uint8_t> message{0xAA, 0xBB};
  const std::string bytes = encode_message_data(0x01020304, Time{0x1122334455667788}, message);
  const std::string expected{"\x01\x04\x03\x02\x01\x88\x77\x66\x55\x44\x33\x22\x11\xAA\xBB", 15};
  EXPECT_EQ(bytes, expected);
}

TEST(FoxgloveProtocol, ReadsWhatAClientWants) {
  const auto request =
      parse_foxglove_request(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":1,"channelId":5}]})");
  ASSERT_TRUE(request);
  const auto& subscribe = std::get<FoxgloveSubscribe>(*request);
  ASSERT_EQ(subscribe.subscriptions.size(), 2U);
  EXPECT_EQ(subscribe.subscriptions[1].channel, 5U);
  const auto end = parse_foxglove_request(R"({"op":"unsubscribe","subscriptionIds":[1]})");
  ASSERT_TRUE(end);
  EXPECT_EQ(std::get<FoxgloveUnsubscribe>(*end).subscriptions, std::vector<std::uint32_t>{1});
  const auto other = parse_foxglove_request(R"({"op":"advertise","channels":[]})");
  ASSERT_TRUE(other);
  EXPECT_EQ(std::get<FoxgloveOther>(*other).operation, "advertise");
}

TEST(FoxgloveProtocol, RefusesNonsense) {
  for (const char* text :
       {"", "[]", "{", R"({"op":1})", R"({"op":"subscribe"})", R"({"op":"subscribe","subscriptions":[1]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":3}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":3}]})",
        R"({"op":"unsubscribe","subscriptionIds":["a"]})"})
    EXPECT_FALSE(parse_foxglove_request(text)) << text;
  Json many{{"op", "unsubscribe"}, {"subscriptionIds", std::vector<int>(kMostSubscriptions + 1, 1)}};
  EXPECT_FALSE(parse_foxglove_request(many.dump()));
}

}  // namespace
}  // namespace docent::telepresence
