#include "docent/telepresence/contract/typescript.h"

namespace docent::telepresence {

TypeScript::Type TypeScript::words(const std::vector<std::string>& words) {
  Type type{"", {{"words", words}}};
  for (const std::string& word : words) type.text += (type.text.empty() ? "'" : " | '") + word + "'";
  return type;
}

TypeScript::Type TypeScript::tuple(const std::vector<Type>& parts) {
  Type type;
  nlohmann::json entries = nlohmann::json::array();
  for (const Type& part : parts) {
    type.text += (type.text.empty() ? "" : ", ") + part.text;
    entries.push_back(part.entry);
  }
  return {"[" + type.text + "]", {{"tuple", std::move(entries)}}};
}

std::string TypeScript::text() const {
  return interfaces_ + unions_ + "export const documents = " + table_.dump(2) + " as const;\n";
}

}  // namespace docent::telepresence
