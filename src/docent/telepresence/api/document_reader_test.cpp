#include "docent/telepresence/api/document_reader.h"

#include <gtest/gtest.h>

#include "docent/telepresence/api/api_documents.h"

namespace docent::telepresence {
namespace {

template <class T>
std::string fault_of(const std::string& text) {
  const auto json = parse_json(text);
  if (!json) return json.error().message;
  const auto document = from_json<T>(*json);
  return document ? "" : document.error().message;
}

TEST(ADocument, IsReadStrictly) {
  using documents::NewLogin;
  EXPECT_EQ(fault_of<NewLogin>(R"({"name":"a","password":"b"})"), "");
  EXPECT_EQ(fault_of<NewLogin>(R"({"name":"a"})"), "password is missing");
  EXPECT_EQ(fault_of<NewLogin>(R"({"name":"a","password":3})"), "password is not what it should be");
  EXPECT_EQ(fault_of<NewLogin>(R"({"name":"a","password":"b","rank":"operator"})"), "has a field too many");
  EXPECT_EQ(fault_of<NewLogin>(R"(["name"])"), "not an object");
  EXPECT_EQ(fault_of<NewLogin>(R"({"name":)"), "not JSON");
  EXPECT_EQ(fault_of<NewLogin>(""), "not JSON");
  EXPECT_EQ(fault_of<NewLogin>("{\"name\":\"\xff\",\"password\":\"\"}"), "not JSON") << "no UTF-8";
  EXPECT_EQ(fault_of<NewLogin>(std::string(1000, '[')), "nested too deep");
  EXPECT_EQ(fault_of<documents::Verdict>(R"({"state":"shown"})"), "");
  EXPECT_EQ(fault_of<documents::Verdict>(R"({"state":"deleted"})"), "state is not what it should be");
}

TEST(ADocument, IsReadBackAsItWasWritten) {
  documents::StatisticsDays days;
  days.days = {{"2026-11-25", "open", 3, {{"tours", 2.5}, {"web", 0.0}}}};
  const auto again = from_json<documents::StatisticsDays>(to_json(days));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(json_text(*again), json_text(days));
}

}  // namespace
}  // namespace docent::telepresence
