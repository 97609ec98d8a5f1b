#include "docent/robot/parameter_list.h"

#include <cxxabi.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <memory>

namespace docent::robot {

namespace {

template <class Number>
YAML::Node shortest(Number value) {
  std::array<char, 64> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return YAML::Node{std::string(text.data(), error == std::errc{} ? end : text.data())};
}

void write(YAML::Emitter& out, const YAML::Node& node) {
  if (node.IsSequence()) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const auto& child : node) write(out, child);
    out << YAML::EndSeq;
  } else if (node.IsMap()) {
    out << YAML::Flow << YAML::BeginMap;
    for (const auto& child : node) {
      out << YAML::Key << child.first.as<std::string>() << YAML::Value;
      write(out, child.second);
    }
    out << YAML::EndMap;
  } else if (node.IsNull()) {
    out << YAML::Null;
  } else if (node.Scalar().empty()) {
    out << YAML::DoubleQuoted << "";
  } else {
    out << node.Scalar();
  }
}

}  // namespace

std::string struct_name(const char* mangled) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text{abi::__cxa_demangle(mangled, nullptr, nullptr, &status),
                                                         &std::free};
  const std::string full = status == 0 && text ? text.get() : mangled;
  const auto colon = full.rfind(':');
  return colon == std::string::npos ? full : full.substr(colon + 1);
}

YAML::Node to_yaml(double value) { return shortest(value); }
YAML::Node to_yaml(float value) { return shortest(value); }

std::string in_one_line(const YAML::Node& node) {
  YAML::Emitter out;
  write(out, node);
  return out.c_str();
}

}  // namespace docent::robot
