#include "docent/telepresence/api/openapi.h"

#include <gtest/gtest.h>

#include "docent/base/files.h"

namespace docent::telepresence {
namespace {

TEST(OpenApi, IsWhatTheDocumentationHolds) {
  const auto committed = read_file("docs/openapi.json");
  ASSERT_TRUE(committed) << committed.error().message;
  EXPECT_EQ(*committed, openapi_of(endpoints())) << "run docent_openapi docs/openapi.json";
}

TEST(OpenApi, NamesEveryEndpointAndEverySchemaThatItRefersTo) {
  const std::string text = openapi_of(endpoints());
  const auto document = nlohmann::json::parse(text);
  std::size_t operations = 0;
  for (const auto& [path, methods] : document.at("paths").items()) operations += methods.size();
  EXPECT_EQ(operations, endpoints().size());
  const std::string begin = "\"#/components/schemas/";
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t from = at + begin.size();
    EXPECT_TRUE(document.at("components").at("schemas").contains(text.substr(from, text.find('"', from) - from)));
  }
}

}  // namespace
}  // namespace docent::telepresence
