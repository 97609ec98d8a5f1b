#include "docent/telepresence/uplink/envelope/envelope.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(AnEnvelope, IsReadBackAsItWasWritten) {
  const auto slot = std::get<UplinkSlot>(*decode_from_museum(encode(FromMuseum{UplinkSlot{12, "{\"a\":\n1}"}})));
  EXPECT_EQ(slot.slot, 12U);
  EXPECT_EQ(slot.text, "{\"a\":\n1}");
  const auto answer = std::get<UplinkAnswer>(*decode_from_museum(encode(FromMuseum{UplinkAnswer{7, "x"}})));
  EXPECT_EQ(answer.viewer, 7U);
  const std::string bytes{"\xff\xd8\n\0z", 5};
  const auto piece =
      std::get<UplinkPiece>(*decode_from_museum(encode(FromMuseum{UplinkPiece{"/camera/a.jpg", "1.5", 10, 5, bytes}})));
  EXPECT_EQ(piece.bytes, bytes);
  EXPECT_EQ(piece.offset, 5U);
  const auto reply =
      std::get<UplinkReply>(*decode_from_museum(encode(FromMuseum{UplinkReply{3, {403, "{}", "c=1; HttpOnly"}}})));
  EXPECT_EQ(reply.reply.status, 403);
  EXPECT_EQ(reply.reply.set_cookie, "c=1; HttpOnly");
  const ApiRequest request{"PUT", "/api/v1/x?y=\"", "{\"b\":1}", "tok", "csrf", "192.0.2.1", true, false};
  const auto call = std::get<UplinkCall>(*decode_to_museum(encode(ToMuseum{UplinkCall{9, request}})));
  EXPECT_EQ(call.call, 9U);
  EXPECT_EQ(call.request.target, request.target);
  EXPECT_EQ(call.request.body, request.body);
  EXPECT_EQ(call.request.address, request.address);
  EXPECT_TRUE(call.request.is_json);
  EXPECT_FALSE(call.request.is_of_ours);
  EXPECT_EQ(std::get<UplinkMessage>(*decode_to_museum(encode(ToMuseum{UplinkMessage{4, "{}"}}))).text, "{}");
  EXPECT_EQ(std::get<UplinkArrival>(*decode_to_museum(encode(ToMuseum{UplinkArrival{"a"}}))).address, "a");
}

TEST(AnEnvelope, ThatIsNoneIsRefused) {
  for (const char* text : {"", "{}", "x\n", "[]\n", "{\"is\":\"nothing\"}\n", "{\"is\":3}\n"}) {
    EXPECT_FALSE(decode_from_museum(text)) << text;
    EXPECT_FALSE(decode_to_museum(text)) << text;
  }
  EXPECT_FALSE(decode_from_museum("{\"is\":\"piece\",\"total\":3,\"offset\":2}\nxx"));
  EXPECT_FALSE(decode_from_museum("{\"is\":\"piece\",\"total\":3000000000,\"offset\":0}\nxx"));
  EXPECT_FALSE(decode_from_museum(std::string(5000, ' ') + "{}\n"));
}

}  // namespace
}  // namespace docent::telepresence
