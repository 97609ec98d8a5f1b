#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {

template <class T>
concept Document = requires {
  T::kName;
};

template <class T>
[[nodiscard]] nlohmann::json to_json(const T& value);

/// Writes the fields that a document's `visit` names.
class DocumentWriter {
 public:
  template <class T>
  void operator()(const char* name, const T& field) {
    json[name] = to_json(field);
  }
  template <class T>
  void maybe(const char* name, const std::optional<T>& field) {
    if (field) json[name] = to_json(*field);
  }
  nlohmann::json json = nlohmann::json::object();
};

namespace document_json {

template <class T>
nlohmann::json of(const std::optional<T>& value) {
  return value ? to_json(*value) : nlohmann::json{};
}
template <class Items>
nlohmann::json list_of(const Items& items) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& item : items) list.push_back(to_json(item));
  return list;
}
template <class T>
nlohmann::json of(const std::vector<T>& items) {
  return list_of(items);
}
template <class T, std::size_t N>
nlohmann::json of(const std::array<T, N>& items) {
  return list_of(items);
}
template <class... T>
nlohmann::json of(const std::tuple<T...>& items) {
  nlohmann::json list = nlohmann::json::array();
  std::apply([&list](const auto&... item) { (list.push_back(to_json(item)), ...); }, items);
  return list;
}
template <class T>
nlohmann::json of(const std::map<std::string, T>& entries) {
  nlohmann::json object = nlohmann::json::object();
  for (const auto& [key, value] : entries) object[key] = to_json(value);
  return object;
}

}  // namespace document_json

/// A document or a part of one as JSON. A message has its `type`.
template <class T>
nlohmann::json to_json(const T& value) {
  if constexpr (Document<T>) {
    DocumentWriter writer;
    if constexpr (requires { T::kType; }) writer.json["type"] = T::kType;
    T::visit(value, writer);
    return std::move(writer.json);
  } else if constexpr (Worded<T>) {
    return to_text(value);
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    return value;
  } else {
    return document_json::of(value);
  }
}

/// Whatever bytes it carries, the text is valid UTF-8; a number that is not finite is null.
template <Document T>
[[nodiscard]] std::string json_text(const T& document) {
  return to_json(document).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Bytes as text: RFC 4648, 4, with padding.
[[nodiscard]] std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace docent::telepresence
