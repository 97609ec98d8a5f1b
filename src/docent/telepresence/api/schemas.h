#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "docent/telepresence/document_json.h"

namespace docent::telepresence {

/// Documents as JSON Schema (2020-12), from their `visit`: the components of docs/openapi.json.
class Schemas {
 public:
  /// A reference to the schema of the document, which is added with those that it holds.
  template <Document T>
  nlohmann::json add() {
    if (!all_.contains(T::kName)) {
      all_[T::kName] = nullptr;
      Fields fields{*this, nlohmann::json::object(), nlohmann::json::array()};
      T document{};
      T::visit(document, fields);
      all_[T::kName] = {{"type", "object"}, {"properties", fields.properties}, {"additionalProperties", false}};
      if (!fields.required.empty()) all_[T::kName]["required"] = fields.required;
    }
    return {{"$ref", std::string{"#/components/schemas/"} + T::kName}};
  }
  [[nodiscard]] const nlohmann::json& all() const { return all_; }

 private:
  struct Fields {
    Schemas& schemas;
    nlohmann::json properties, required;
    template <class T>
    void operator()(const char* name, const T& field) {
      required.push_back(name);
      properties[name] = schemas.of(field);
    }
    template <class T>
    void maybe(const char* name, const std::optional<T>& /*field*/) {
      properties[name] = schemas.of(T{});
    }
  };

  template <class T>
  nlohmann::json of(const T& /*field*/) {
    if constexpr (Document<T>) {
      return add<T>();
    } else if constexpr (Worded<T>) {
      return {{"type", "string"}, {"enum", words_of(T{})}};
    } else if constexpr (std::is_same_v<T, bool>) {
      return {{"type", "boolean"}};
    } else if constexpr (std::is_integral_v<T>) {
      return {{"type", "integer"}};
    } else if constexpr (std::is_floating_point_v<T>) {
      return {{"type", "number"}};
    } else {
      static_assert(std::is_same_v<T, std::string>);
      return {{"type", "string"}};
    }
  }
  template <class T>
  nlohmann::json of(const std::vector<T>& /*items*/) {
    return {{"type", "array"}, {"items", of(T{})}};
  }
  template <class T>
  nlohmann::json of(const std::map<std::string, T>& /*entries*/) {
    return {{"type", "object"}, {"additionalProperties", of(T{})}};
  }
  template <class T, std::size_t N>
  nlohmann::json of(const std::array<T, N>& /*items*/) {
    return {{"type", "array"}, {"items", of(T{})}, {"minItems", N}, {"maxItems", N}};
  }
  template <class T>
  nlohmann::json of(const std::optional<T>& /*value*/) {
    return {{"anyOf", {of(T{}), {{"type", "null"}}}}};
  }

  nlohmann::json all_ = nlohmann::json::object();
};

}  // namespace docent::telepresence
