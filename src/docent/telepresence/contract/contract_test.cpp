#include "docent/telepresence/contract/contract.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "docent/base/files.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/document_json.h"
#include "docent/telepresence/documents.h"

// The page's half of this test is web/src/contract/contract.test.ts.

namespace docent::telepresence {
namespace {

using Json = nlohmann::json;
const std::string kRenew = "is not what docent_web_contract writes: run build/dev/bin/docent_web_contract .";

TEST(Contract, ThePagesTypesAreOurs) {
  const auto file = read_file("web/src/contract/contract.ts");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(*file == contract_types()) << "web/src/contract/contract.ts " << kRenew;
}

TEST(Contract, TheSamplesAreWhatWeSend) {
  const std::filesystem::path folder = "tests/web_contract/server";
  const auto samples = contract_samples();
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator{folder})
    files += samples.contains(entry.path().filename()) ? 1 : 0;
  EXPECT_EQ(files, samples.size());
  for (const auto& [name, text] : samples) {
    const auto file = read_file(folder / name);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(*file == text + "\n") << folder / name << ' ' << kRenew;
  }
}

template <class... T>
std::set<std::string> types_of(const std::tuple<T...>* /*messages*/) {
  return {T::kType...};
}

TEST(Contract, ThereIsASampleOfEachMessage) {
  std::set<std::string> sent;
  for (const auto& [name, text] : contract_samples()) {
    if (name != "museum.json") sent.insert(Json::parse(text).at("type").get<std::string>());
  }
  EXPECT_EQ(sent, types_of(static_cast<const documents::ServerMessage*>(nullptr)));
}

TEST(Contract, WhatThePageSaysIsUnderstood) {
  const auto file = read_file("tests/web_contract/client.json");
  ASSERT_TRUE(file) << file.error().message;
  std::set<std::size_t> kinds;
  for (const Json& said : Json::parse(*file)) {
    const auto message = parse_client_message(said.dump());
    ASSERT_TRUE(message) << said << ": " << message.error().message;
    kinds.insert(message->index());
    // Nothing that the page says is lost on the way.
    const Json heard = std::visit([](const auto& part) { return to_json(part); }, *message);
    EXPECT_EQ(heard, said);
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<ClientMessage>);
}

}  // namespace
}  // namespace docent::telepresence
