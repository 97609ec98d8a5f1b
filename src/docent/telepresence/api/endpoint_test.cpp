#include "docent/telepresence/api/endpoint.h"

#include <gtest/gtest.h>

#include <set>

namespace docent::telepresence {
namespace {

std::string found(const std::string& method, const std::string& target) {
  std::map<std::string, std::string> path;
  const auto endpoint = find_endpoint(endpoints(), method, target, path);
  if (!endpoint) return to_text(endpoint.error().reason);
  std::string text = (*endpoint)->name;
  for (const auto& [name, value] : path) text += " " + name + "=" + value;
  return text;
}

TEST(Endpoints, AreFoundByMethodAndPath) {
  EXPECT_EQ(found("GET", "/api/v1/login"), "who_am_i");
  EXPECT_EQ(found("POST", "/api/v1/forum/0190-a"), "write_post thread=0190-a");
  EXPECT_EQ(found("GET", "/api/v1/forum?before=3"), "list_threads");
  EXPECT_EQ(found("PUT", "/api/v1/login"), "wrong_method");
  EXPECT_EQ(found("GET", "/api/v1/nothing"), "not_found");
  EXPECT_EQ(found("GET", "/api/v1"), "not_found");
  EXPECT_EQ(found("GET", "/api/v1/login/"), "not_found");
}

TEST(Endpoints, TakeNothingAsANameThatIsNone) {
  for (const char* name : {"", "..%2f..%2fetc", "a'b", "a b", "%00", "<b>"})
    EXPECT_EQ(found("GET", std::string{"/api/v1/forum/"} + name), "not_found") << name;
  EXPECT_EQ(found("GET", "/api/v1/forum/" + std::string(65, 'a')), "not_found");
  EXPECT_EQ(found("GET", "/api/v1/forum/../login"), "not_found");
  EXPECT_EQ(found("GET", "/api/v1/../v1/login"), "not_found");
}

TEST(Endpoints, HaveEachANameAndAPlaceOfTheirOwn) {
  std::set<std::string> names, places;
  for (const Endpoint& endpoint : endpoints()) {
    EXPECT_TRUE(names.insert(endpoint.name).second) << endpoint.name;
    EXPECT_TRUE(places.insert(std::string{endpoint.method} + endpoint.path).second) << endpoint.path;
  }
}

TEST(AQuery, IsDecodedOrRefused) {
  const auto query = parse_query("/x?a=1&b=%C3%A9+%26&c");
  ASSERT_TRUE(query);
  EXPECT_EQ(query->at("a"), "1");
  EXPECT_EQ(query->at("b"), "\xC3\xA9 &");
  EXPECT_EQ(query->at("c"), "");
  EXPECT_TRUE(parse_query("/x")->empty());
  EXPECT_FALSE(parse_query("/x?a=%4"));
  EXPECT_FALSE(parse_query("/x?a=%zz"));
  EXPECT_FALSE(parse_query("/x?a=1&a=2"));
  EXPECT_FALSE(parse_query("/x?" + std::string(600, 'a')));
}

}  // namespace
}  // namespace docent::telepresence
