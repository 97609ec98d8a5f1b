#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/robot/robot_config.h"

namespace docent::robot {

/// One key of robot.yaml: a value, or a part that holds the rows after it that are one deeper.
struct ParameterRow {
  int depth = 0;            ///< 0: a section
  std::string key;          ///< as it stands in robot.yaml
  std::string value;        ///< as YAML, in one line; empty: a part
  std::string declared_in;  ///< name of the struct that lists the key, without namespaces
  std::string holds;        ///< of a part: name of its struct
};
using ParameterRows = std::vector<ParameterRow>;

/// "a::(anonymous namespace)::Params" for the mangled name of that struct gives "Params".
[[nodiscard]] std::string struct_name(const char* mangled);
/// A value as a node of YAML; numbers in the fewest digits that read back as the same number.
[[nodiscard]] YAML::Node to_yaml(double value);
[[nodiscard]] YAML::Node to_yaml(float value);
[[nodiscard]] inline YAML::Node to_yaml(int value) { return YAML::Node{value}; }
[[nodiscard]] inline YAML::Node to_yaml(std::int64_t value) { return YAML::Node{value}; }
[[nodiscard]] inline YAML::Node to_yaml(std::uint64_t value) { return YAML::Node{value}; }
[[nodiscard]] inline YAML::Node to_yaml(bool value) { return YAML::Node{value}; }
[[nodiscard]] inline YAML::Node to_yaml(const std::string& value) { return YAML::Node{value}; }
/// In one line: lists and mappings in brackets, texts in quotes.
[[nodiscard]] std::string in_one_line(const YAML::Node& node);

/// Makes a node of a struct by its `visit`.
class YamlWriter {
 public:
  template <class T>
  void operator()(const char* key, const T& field) {
    node_[key] = write(field);
  }
  template <class T>
  [[nodiscard]] static YAML::Node write(const T& value) {
    if constexpr (requires(T copy, YamlWriter & writer) { copy.visit(writer); }) {
      YamlWriter inner;
      T copy = value;
      copy.visit(inner);
      return inner.node_;
    } else {
      return to_yaml(value);
    }
  }
  template <class T>
  [[nodiscard]] static YAML::Node write(const std::vector<T>& values) {
    YAML::Node list{YAML::NodeType::Sequence};
    for (const T& value : values) list.push_back(write(value));
    return list;
  }
  template <class T>
  [[nodiscard]] static YAML::Node write(const std::optional<T>& value) {
    return value ? write(*value) : YAML::Node{};
  }

 private:
  YAML::Node node_{YAML::NodeType::Map};
};

/// Lists the keys that a struct's `visit` names, with their values.
class ParameterLister {
 public:
  ParameterLister(ParameterRows& rows, int depth, std::string declared_in)
      : rows_{rows}, depth_{depth}, declared_in_{std::move(declared_in)} {}
  template <class T>
  void operator()(const char* key, T& field) {
    if constexpr (requires(ParameterLister & lister) { field.visit(lister); }) {
      const std::string holds = struct_name(typeid(T).name());
      rows_.push_back({depth_, key, "", declared_in_, holds});
      ParameterLister inner{rows_, depth_ + 1, holds};
      field.visit(inner);
    } else {
      rows_.push_back({depth_, key, in_one_line(YamlWriter::write(field)), declared_in_, ""});
    }
  }

 private:
  ParameterRows& rows_;
  int depth_;
  std::string declared_in_;
};

/// The keys of a section with the values that hold: what `config` says, else the defaults.
template <class Params>
[[nodiscard]] Result<ParameterRows> list_parameters(const RobotConfig& config, const std::string& section) {
  auto params = config.section<Params>(section);
  if (!params) return tl::unexpected<Error>(params.error());
  ParameterRows rows;
  const std::string holds = struct_name(typeid(Params).name());
  rows.push_back({0, section, "", "", holds});
  ParameterLister lister{rows, 1, holds};
  params->visit(lister);
  return rows;
}

}  // namespace docent::robot
