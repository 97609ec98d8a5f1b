#include "docent/telepresence/client_message.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

const std::string kId = "018f3a6c-5b2e-7c3d-9a4b-0123456789ab";

TEST(ClientMessage, ReadsARequest) {
  const auto message =
      parse_client_message(R"({"type":"request","id":")" + kId +
                           R"(","kind":"exhibit","target":"sputnik","viewpoint":2,"name":" Ada\n ","language":"de"})");
  ASSERT_TRUE(message) << message.error().message;
  const auto& request = std::get<RequestMessage>(*message);
  EXPECT_EQ(request.id, kId);
  EXPECT_EQ(request.kind, RequestKind::exhibit);
  EXPECT_EQ(request.target, "sputnik");
  EXPECT_EQ(request.viewpoint, 2);
  EXPECT_EQ(request.name, "Ada");
  EXPECT_EQ(request.language, "de");
}

TEST(ClientMessage, ReadsTheOtherKinds) {
  const auto cancel = parse_client_message(R"({"type":"cancel","id":")" + kId + R"(","request":")" + kId + R"("})");
  ASSERT_TRUE(cancel);
  EXPECT_EQ(std::get<CancelMessage>(*cancel).request, kId);
  const auto choice =
      parse_client_message(R"({"type":"choice","id":")" + kId + R"(","prompt":"dep-1/more","choice":"more"})");
  ASSERT_TRUE(choice);
  EXPECT_EQ(std::get<ChoiceMessage>(*choice).choice, "more");
  EXPECT_EQ(std::get<ChoiceMessage>(*choice).prompt, "dep-1/more") << "as the executive names its questions";
  const auto watch = parse_client_message(R"({"type":"watch","details":true})");
  ASSERT_TRUE(watch);
  EXPECT_TRUE(std::get<WatchMessage>(*watch).details);
}

TEST(ClientMessage, ReadsWhatTheRobotsScreenSays) {
  const auto lamps = parse_client_message(R"({"type":"lamps","lit":[1,3,4]})");
  ASSERT_TRUE(lamps);
  EXPECT_EQ(std::get<LampsMessage>(*lamps).lit, (std::vector<int>{1, 3, 4}));
  EXPECT_TRUE(parse_client_message(R"({"type":"lamps","lit":[]})"));
  const auto help = parse_client_message(R"({"type":"help","id":")" + kId + R"(","language":"fr"})");
  ASSERT_TRUE(help);
  EXPECT_EQ(std::get<HelpMessage>(*help).language, "fr");
  const auto answer = parse_client_message(R"({"type":"answer","id":")" + kId +
                                           R"(","question":"intelligence","answer":"dog","language":"en"})");
  ASSERT_TRUE(answer);
  EXPECT_EQ(std::get<AnswerMessage>(*answer).question, PollQuestion::intelligence);
  EXPECT_EQ(std::get<AnswerMessage>(*answer).answer, PollAnswer::dog);
}

TEST(ClientMessage, ReadsWhatAnOperatorSays) {
  const auto of = [](const std::string& rest) { return parse_client_message(R"({"id":")" + kId + "\"," + rest); };
  EXPECT_TRUE(std::get<LeaseMessage>(*of(R"("type":"lease","wants":true})")).wants);
  EXPECT_TRUE(std::get<StopMessage>(*of(R"("type":"stop","stopped":true})")).stopped);
  EXPECT_EQ(std::get<StopMessage>(*of(R"("type":"stop","stopped":false,"number":7})")).number, 7);
  EXPECT_EQ(std::get<SetHoursMessage>(*of(R"("type":"set_hours","mode":"web"})")).mode, OperatingMode::web);
  const auto steer = std::get<SteerMessage>(*of(R"("type":"steer","pressed":true,"forward":-0.5,"turn":1})"));
  EXPECT_TRUE(steer.pressed);
  EXPECT_EQ(steer.forward, -0.5);
  EXPECT_EQ(steer.turn, 1.0);
  for (const char* wrong :
       {R"("type":"lease"})", R"("type":"lease","wants":1})", R"("type":"stop","stopped":"yes"})",
        R"("type":"stop","stopped":false})", R"("type":"stop","stopped":false,"number":-1})",
        R"("type":"stop","stopped":false,"number":1e12})", R"("type":"stop","stopped":false,"number":99999999999})",
        R"("type":"set_hours","mode":"never"})", R"("type":"steer","pressed":true,"forward":1.1,"turn":0})",
        R"("type":"steer","pressed":true,"forward":1e999,"turn":0})", R"("type":"steer","pressed":true,"forward":0})"})
    EXPECT_FALSE(of(wrong)) << wrong;
  EXPECT_FALSE(parse_client_message(R"({"type":"stop","stopped":true})")) << "it needs an id";
}

TEST(ClientMessage, TheQuestionsOfATourCanBeAnswered) {
  // The executive names its questions TASK/more.
  const auto choice =
      parse_client_message(R"({"type":"choice","id":")" + kId + R"(","prompt":"3-17/more","choice":"more"})");
  ASSERT_TRUE(choice) << choice.error().message;
  EXPECT_EQ(std::get<ChoiceMessage>(*choice).prompt, "3-17/more");
  for (const char* id : {"", "/", "a/", "/a", "a//b", "a b"}) EXPECT_FALSE(is_prompt_id(id)) << id;
  EXPECT_FALSE(is_prompt_id(std::string(40, 'a') + "/" + std::string(40, 'a')));
}

TEST(ClientMessage, RefusesEverythingElse) {
  const std::string uuid = R"("id":")" + kId + "\"";
  const std::vector<std::string> bad = {
      "",
      "{",
      "[]",
      "null",
      "\xff\xfe",
      R"({"type":1})",
      R"({"type":"drive","linear":1})",
      R"({"type":"request"})",
      R"({"type":"request","id":"1","kind":"exhibit","target":"a"})",
      R"({"type":"request","id":"018F3A6C-5B2E-7C3D-9A4B-0123456789AB","kind":"exhibit","target":"a"})",
      R"({"type":"request","id":"018f3a6c-5b2e-4c3d-9a4b-0123456789ab","kind":"exhibit","target":"a"})",
      R"({"type":"request",)" + uuid + R"(,"kind":"cancel","target":"a"})",
      R"({"type":"request",)" + uuid + R"(,"kind":"exhibit","target":"../a"})",
      R"({"type":"request",)" + uuid + R"(,"kind":"exhibit","target":7})",
      R"({"type":"request",)" + uuid + R"(,"kind":"exhibit","target":"a","viewpoint":1.5})",
      R"({"type":"request",)" + uuid + R"(,"kind":"exhibit","target":"a","viewpoint":-9})",
      R"({"type":"request",)" + uuid + R"(,"kind":"exhibit","target":"a","viewpoint":18446744073709551615})",
      R"({"type":"request",)" + uuid + R"(,"kind":"exhibit","target":"a","language":"english"})",
      R"({"type":"cancel",)" + uuid + R"(,"request":"all"})",
      R"({"type":"choice",)" + uuid + R"(,"prompt":"p","choice":""})",
      R"({"type":"choice",)" + uuid + R"(,"prompt":"a/../b/","choice":"more"})",
      R"({"type":"lamps"})",
      R"({"type":"lamps","lit":[0]})",
      R"({"type":"lamps","lit":[5]})",
      R"({"type":"lamps","lit":[-1]})",
      R"({"type":"lamps","lit":[2,1]})",
      R"({"type":"lamps","lit":[1,1]})",
      R"({"type":"lamps","lit":[1.5]})",
      R"({"type":"lamps","lit":[1,2,3,4,5]})",
      R"({"type":"help","language":"en"})",
      R"({"type":"skip","exhibit":"zuse"})",
      R"({"type":"skip",)" + uuid + R"(})",
      R"({"type":"skip",)" + uuid + R"(,"exhibit":"../zuse"})",
      R"({"type":"request",)" + uuid + R"(,"kind":"skip","target":"zuse"})",
      R"({"type":"help",)" + uuid + R"(,"language":"english"})",
      R"({"type":"answer",)" + uuid + R"(,"question":"liked","answer":"dog","language":"en"})",
      R"({"type":"answer",)" + uuid + R"(,"question":"intelligence","answer":"yes","language":"en"})",
      R"({"type":"answer",)" + uuid + R"(,"question":"age","answer":"yes","language":"en"})",
      R"({"type":"answer",)" + uuid + R"(,"question":"liked","answer":"yes","language":"="})",
      R"({"type":"choice",)" + uuid + R"(,"prompt":"/p","choice":"more"})",
      R"({"type":"choice",)" + uuid + R"(,"prompt":"a//p","choice":"more"})",
      R"({"type":"choice",)" + uuid + R"(,"prompt":"p/","choice":"more"})",
      std::string(3000, '['),
  };
  for (const auto& text : bad) {
    const auto message = parse_client_message(text);
    ASSERT_FALSE(message) << text;
    EXPECT_FALSE(message.error().message.empty());
    EXPECT_LE(message.error().message.size(), 120U);
  }
}

TEST(ClientMessage, NamesAreOneVisibleLine) {
  EXPECT_EQ(clean_name("  Grete   und\tHans \n"), "Grete und Hans");
  EXPECT_EQ(clean_name("a\x01\x1b[31mb"), "a[31mb");
  EXPECT_EQ(clean_name("ab\xe2\x80\xae"
                       "cd"),
            "abcd");  // right-to-left override
  EXPECT_EQ(clean_name("Zo\xc3\xab \xf0\x9f\xa4\x96"), "Zo\xc3\xab \xf0\x9f\xa4\x96");
  EXPECT_EQ(clean_name(std::string(100, 'x')).size(), 40U);
  std::string umlauts;
  for (int i = 0; i < 60; ++i) umlauts += "\xc3\xbc";
  EXPECT_EQ(clean_name(umlauts).size(), 80U);  // 40 characters of two bytes, none cut in half
  EXPECT_EQ(clean_name("\xe2\x80\x8b \xe2\x80\x8b"), "");
}

}  // namespace
}  // namespace docent::telepresence
