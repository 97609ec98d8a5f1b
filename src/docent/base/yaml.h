#pragma once

#include <yaml-cpp/yaml.h>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent {

/// A YAML file, parsed. Every fault found later is reported as "FILE:LINE: …".
class YamlFile {
 public:
  [[nodiscard]] static Result<YamlFile> load(const std::filesystem::path& path);
  /// From memory; `name` stands where the file's name would.
  [[nodiscard]] static Result<YamlFile> parse(const std::string& text, std::string name);

  [[nodiscard]] const YAML::Node& root() const { return root_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Error fault(const YAML::Node& at, const std::string& what) const;

 private:
  YamlFile(const YAML::Node& root, std::string name) : root_{root}, name_{std::move(name)} {}
  YAML::Node root_;
  std::string name_;
};

/// Thrown inside readers of YAML and caught at their border; never leaves a function that returns a Result.
struct YamlFault {
  Error error;
};

/// Reads one mapping into a plain struct: `reader("key", field)` for every field, then `reader.finish()`.
/// Absent keys keep their defaults; an unknown key, a wrong type or a wrong shape is a fault with file and line.
///
/// A struct with `template <class V> void visit(V& v) { v("max_speed", max_speed); }` is read by `read_yaml`.
class YamlReader {
 public:
  YamlReader(const YamlFile& file, const YAML::Node& node);

  template <class T>
  void operator()(const char* key, T& field) {
    known_.insert(key);
    const YAML::Node child = node_[key];
    if (child.IsDefined() && !child.IsNull()) read(child, field);
  }
  template <class T>
  void required(const char* key, T& field) {
    known_.insert(key);
    const YAML::Node child = node_[key];
    if (child.IsDefined() && !child.IsNull()) {
      read(child, field);
    } else {
      missing_.emplace_back(key);
    }
  }
  /// The node under `key`, undefined when absent, for what is not read into a struct.
  [[nodiscard]] YAML::Node node(const char* key);
  /// Keys that nobody asked for. Refuses the absence of required ones.
  [[nodiscard]] std::vector<std::string> unknown() const;
  /// Refuses keys that nobody asked for, then the absence of required ones: a misspelt key is both.
  void finish() const;

 private:
  template <class T>
  void read(const YAML::Node& node, T& field) {
    if constexpr (requires(T value, YamlReader & reader) { value.visit(reader); }) {
      YamlReader inner{file_, node};
      field.visit(inner);
      inner.finish();
    } else {
      read_value(node, field);
    }
  }
  template <class T>
  void read_value(const YAML::Node& node, std::vector<T>& field) {
    if (!node.IsSequence()) throw YamlFault{file_.fault(node, "expected a list")};
    field.clear();
    for (const auto& child : node) {
      field.emplace_back();
      read(child, field.back());
    }
  }
  template <class T>
  void read_value(const YAML::Node& node, std::optional<T>& field) {
    field.emplace();
    read(node, *field);
  }
  void read_value(const YAML::Node& node, double& field);
  void read_value(const YAML::Node& node, float& field);
  void read_value(const YAML::Node& node, int& field);
  void read_value(const YAML::Node& node, std::int64_t& field);
  void read_value(const YAML::Node& node, std::uint64_t& field);
  void read_value(const YAML::Node& node, bool& field);
  void read_value(const YAML::Node& node, std::string& field);

  const YamlFile& file_;
  YAML::Node node_;
  std::set<std::string> known_;
  std::vector<std::string> missing_;
};

/// Reads `node` of `file` over the defaults in `value`.
template <class T>
[[nodiscard]] Result<void> read_yaml(const YamlFile& file, const YAML::Node& node, T& value) {
  try {
    YamlReader reader{file, node};
    value.visit(reader);
    reader.finish();
    return {};
  } catch (const YamlFault& fault) {
    return tl::unexpected<Error>(fault.error);
  }
}

/// The same of a file that other programs write, who may add keys of their own: which those are.
template <class T>
[[nodiscard]] Result<std::vector<std::string>> read_yaml_leniently(const YamlFile& file, const YAML::Node& node,
                                                                   T& value) {
  try {
    YamlReader reader{file, node};
    value.visit(reader);
    return reader.unknown();
  } catch (const YamlFault& fault) {
    return tl::unexpected<Error>(fault.error);
  }
}

}  // namespace docent
