#pragma once

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/telepresence/document_json.h"

namespace docent::telepresence {

/// Reads a document strictly: each field that its `visit` names must be there and be of its kind, and no other. What it
/// reads is bounded by the body, which is.
class DocumentReader {
 public:
  explicit DocumentReader(const nlohmann::json& json) : json_{json} {
    if (!json.is_object()) fault_ = "not an object";
  }
  template <class T>
  void operator()(const char* name, T& field) {
    known_.insert(name);
    if (!fault_.empty()) return;
    const auto place = json_.find(name);
    if (place == json_.end()) return void(fault_ = std::string{name} + " is missing");
    take(name, *place, field);
  }
  template <class T>
  void maybe(const char* name, std::optional<T>& field) {
    known_.insert(name);
    if (!fault_.empty() || !json_.contains(name)) return;
    field.emplace();
    take(name, json_.at(name), *field);
  }
  /// What is wrong with it; empty: nothing.
  [[nodiscard]] std::string fault() const {
    if (!fault_.empty()) return fault_;
    for (const auto& [key, value] : json_.items())
      if (!known_.contains(key)) return "has a field too many";
    return "";
  }

 private:
  template <class T>
  void take(const char* name, const nlohmann::json& value, T& field) {
    if constexpr (Document<T>) {
      DocumentReader inner{value};
      if (inner.fault_.empty()) T::visit(field, inner);
      if (const std::string why = inner.fault(); !why.empty()) fault_ = std::string{name} + ": " + why;
    } else if constexpr (Worded<T>) {
      const auto word = value.is_string() ? parse<T>(value.get_ref<const std::string&>()) : std::nullopt;
      if (word) field = *word;
      if (!word) fault_ = std::string{name} + " is not what it should be";
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      if (is_of_kind<T>(value)) {
        field = value.get<T>();
      } else {
        fault_ = std::string{name} + " is not what it should be";
      }
    } else {
      take_list(name, value, field);
    }
  }
  template <class T>
  static bool is_of_kind(const nlohmann::json& value) {
    if constexpr (std::is_same_v<T, bool>)
      return value.is_boolean();
    else if constexpr (std::is_floating_point_v<T>)
      return value.is_number() && std::isfinite(value.get<double>());
    else if constexpr (std::is_integral_v<T>)
      return value.is_number_integer();
    else
      return value.is_string();
  }
  template <class T>
  void take_list(const char* name, const nlohmann::json& value, std::vector<T>& field) {
    if (!value.is_array()) return void(fault_ = std::string{name} + " is no list");
    for (const auto& item : value) {
      if (!fault_.empty()) return;
      field.emplace_back();
      take(name, item, field.back());
    }
  }
  template <class T>
  void take_list(const char* name, const nlohmann::json& value, std::map<std::string, T>& field) {
    if (!value.is_object()) return void(fault_ = std::string{name} + " is no object");
    for (const auto& [key, item] : value.items()) {
      if (!fault_.empty()) return;
      take(name, item, field[key]);
    }
  }
  template <class T, std::size_t N>
  void take_list(const char* name, const nlohmann::json& value, std::array<T, N>& field) {
    if (!value.is_array() || value.size() != N) return void(fault_ = std::string{name} + " has not so many parts");
    for (std::size_t i = 0; i < N; ++i) take(name, value[i], field[i]);
  }
  template <class T>
  void take_list(const char* name, const nlohmann::json& value, std::optional<T>& field) {
    if (value.is_null()) return;
    field.emplace();
    take(name, value, *field);
  }

  const nlohmann::json& json_;
  std::set<std::string> known_;
  std::string fault_;
};

/// Error: what of it is wrong, in English.
template <Document T>
[[nodiscard]] Result<T> from_json(const nlohmann::json& json) {
  T document{};
  DocumentReader reader{json};
  if (json.is_object()) T::visit(document, reader);
  if (std::string why = reader.fault(); !why.empty()) return fail(std::move(why));
  return document;
}

/// JSON from outside: nested no deeper than our documents are.
[[nodiscard]] Result<nlohmann::json> parse_json(std::string_view text);

}  // namespace docent::telepresence
