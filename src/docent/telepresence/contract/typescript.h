#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "docent/telepresence/document_json.h"

namespace docent::telepresence {

/// Writes documents as TypeScript: an interface for each, and a table `documents` of their fields, with which a test
/// can look at what is sent. Both come from the documents' `visit`.
///
/// A field of the table is "string", "number", "boolean", {words: […]}, {nullable: …}, {list: …}, {tuple: […]},
/// {map: …} or {document: NAME}.
class TypeScript {
 public:
  /// Adds the document, and before it those that it holds.
  template <Document T>
  void add() {
    if (table_.contains(T::kName)) return;
    table_[T::kName] = nullptr;
    Fields fields{*this, {}, nlohmann::json::object(), nlohmann::json::object()};
    if constexpr (requires { T::kType; }) fields.lines = "  type: '" + std::string{T::kType} + "';\n";
    T document{};
    T::visit(document, fields);
    interfaces_ += "export interface " + std::string{T::kName} + " {\n" + fields.lines + "}\n";
    nlohmann::json& entry = table_[T::kName] = {{"fields", fields.always}, {"maybe", fields.maybe_there}};
    if constexpr (requires { T::kType; }) entry["type"] = T::kType;
  }
  /// Adds the documents and a union of them.
  template <Document... T>
  void add_union(const std::string& name, const std::tuple<T...>* /*documents*/) {
    (add<T>(), ...);
    std::string members;
    ((members += std::string{members.empty() ? "" : " | "} + T::kName), ...);
    unions_ += "export type " + name + " = " + members + ";\n";
  }
  template <Document... T>
  void add_union(const std::string& name, const std::variant<T...>* /*documents*/) {
    add_union(name, static_cast<const std::tuple<T...>*>(nullptr));
  }
  [[nodiscard]] std::string text() const;

 private:
  /// A type as TypeScript and as an entry of the table.
  struct Type {
    std::string text;
    nlohmann::json entry;
  };
  struct Fields {
    TypeScript& writer;
    std::string lines;
    nlohmann::json always, maybe_there;
    template <class T>
    void operator()(const char* name, const T& /*field*/) {
      const Type type = writer.of(static_cast<const T*>(nullptr));
      lines += std::string{"  "} + name + ": " + type.text + ";\n";
      always[name] = type.entry;
    }
    template <class T>
    void maybe(const char* name, const std::optional<T>& /*field*/) {
      const Type type = writer.of(static_cast<const T*>(nullptr));
      lines += std::string{"  "} + name + "?: " + type.text + ";\n";
      maybe_there[name] = type.entry;
    }
  };

  template <class T>
  Type of(const T* /*type*/) {
    if constexpr (Document<T>) {
      add<T>();
      return {T::kName, {{"document", T::kName}}};
    } else if constexpr (Worded<T>) {
      constexpr auto kWords = words_of(T{});
      return words({kWords.begin(), kWords.end()});
    } else if constexpr (std::is_same_v<T, bool>) {
      return {"boolean", "boolean"};
    } else if constexpr (std::is_arithmetic_v<T>) {
      return {"number", "number"};
    } else {
      static_assert(std::is_same_v<T, std::string>);
      return {"string", "string"};
    }
  }
  template <class T>
  Type of(const std::optional<T>* /*type*/) {
    const Type inner = of(static_cast<const T*>(nullptr));
    return {inner.text + " | null", {{"nullable", inner.entry}}};
  }
  template <class T>
  Type of(const std::vector<T>* /*type*/) {
    const Type inner = of(static_cast<const T*>(nullptr));
    return {inner.text + "[]", {{"list", inner.entry}}};
  }
  template <class T>
  Type of(const std::map<std::string, T>* /*type*/) {
    const Type inner = of(static_cast<const T*>(nullptr));
    return {"Record<string, " + inner.text + ">", {{"map", inner.entry}}};
  }
  template <class T, std::size_t N>
  Type of(const std::array<T, N>* /*type*/) {
    return tuple(std::vector<Type>(N, of(static_cast<const T*>(nullptr))));
  }
  template <class... T>
  Type of(const std::tuple<T...>* /*type*/) {
    return tuple({of(static_cast<const T*>(nullptr))...});
  }
  [[nodiscard]] static Type words(const std::vector<std::string>& words);
  [[nodiscard]] static Type tuple(const std::vector<Type>& parts);

  std::string interfaces_, unions_;
  nlohmann::json table_ = nlohmann::json::object();
};

}  // namespace docent::telepresence
