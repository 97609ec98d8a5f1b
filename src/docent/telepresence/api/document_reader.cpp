#include "docent/telepresence/api/document_reader.h"

namespace docent::telepresence {

Result<nlohmann::json> parse_json(std::string_view text) {
  constexpr int kDeepest = 12;
  bool is_too_deep = false;
  const auto look = [&](int depth, nlohmann::json::parse_event_t /*event*/, nlohmann::json& /*parsed*/) {
    is_too_deep = is_too_deep || depth > kDeepest;
    return !is_too_deep;
  };
  auto json = nlohmann::json::parse(text.begin(), text.end(), look, false);
  if (is_too_deep) return fail("nested too deep");
  if (json.is_discarded()) return fail("not JSON");
  return json;
}

}  // namespace docent::telepresence
