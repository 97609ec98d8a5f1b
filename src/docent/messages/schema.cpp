#include "docent/messages/schema.h"

#include <algorithm>
#include <map>
#include <set>

#include "docent/base/check.h"

namespace docent {
namespace {

struct TypeParts {
  std::string package;
  std::string name;
};

TypeParts split(const std::string& type) {
  const auto first = type.find('/');
  const auto last = type.rfind('/');
  DOCENT_CHECK(first != std::string::npos);
  return {type.substr(0, first), type.substr(last + 1)};
}

std::string without_msg(const std::string& type) {
  const auto [package, name] = split(type);
  return package + "/" + name;
}

std::string fields_as_ros2msg(const MessageSchema& schema) {
  std::string text;
  for (const auto& field : schema.fields) {
    text += field.is_message ? without_msg(field.type) : field.type;
    if (field.shape == FieldSchema::Shape::sequence) text += "[]";
    if (field.shape == FieldSchema::Shape::array) text += "[" + std::to_string(field.size) + "]";
    text += " " + field.name + "\n";
  }
  return text;
}

std::string idl_type(const FieldSchema& field) {
  static const std::map<std::string, std::string> kNames{{"bool", "boolean"},    {"byte", "octet"},
                                                         {"int8", "int8"},       {"uint8", "octet"},
                                                         {"int16", "short"},     {"uint16", "unsigned short"},
                                                         {"int32", "long"},      {"uint32", "unsigned long"},
                                                         {"int64", "long long"}, {"uint64", "unsigned long long"},
                                                         {"float32", "float"},   {"float64", "double"},
                                                         {"string", "string"}};
  return field.is_message ? dds_type_name(field.type) : kNames.at(field.type);
}

/// A leading underscore says that the rest is a name, also where the rest is a keyword of IDL (of any case).
std::string idl_name(const std::string& name) {
  static const std::set<std::string> kKeywords{
      "abstract",  "alias",     "any",        "attribute",   "boolean",    "case",      "char",     "component",
      "connector", "const",     "consumes",   "context",     "custom",     "default",   "double",   "emits",
      "enum",      "eventtype", "exception",  "factory",     "false",      "finder",    "fixed",    "float",
      "getraises", "home",      "import",     "in",          "inout",      "interface", "local",    "long",
      "manages",   "map",       "mirrorport", "module",      "multiple",   "native",    "object",   "octet",
      "oneway",    "out",       "port",       "porttype",    "primarykey", "private",   "provides", "public",
      "publishes", "raises",    "readonly",   "sequence",    "setraises",  "short",     "string",   "struct",
      "supports",  "switch",    "true",       "truncatable", "typedef",    "typeid",    "typename", "typeprefix",
      "union",     "unsigned",  "uses",       "valuebase",   "valuetype",  "void",      "wchar",    "wstring"};
  return kKeywords.contains(name) ? "_" + name : name;
}

std::string struct_as_idl(const MessageSchema& schema) {
  const auto [package, name] = split(schema.type);
  std::string typedefs;
  std::string fields;
  for (const auto& field : schema.fields) {
    std::string type = idl_type(field);
    if (field.shape == FieldSchema::Shape::sequence) type = "sequence<" + type + ">";
    if (field.shape == FieldSchema::Shape::array) {  // an array in a struct needs a name of its own
      const std::string alias = name + "__" + field.name;
      typedefs += "  typedef " + type + " " + alias + "[" + std::to_string(field.size) + "];\n";
      type = alias;
    }
    fields += "    " + type + " " + idl_name(field.name) + ";\n";
  }
  return "module " + package + " { module msg { module dds_ {\n" + typedefs + "  struct " + name + "_ {\n" + fields +
         "  };\n}; }; };\n";
}

}  // namespace

bool SchemaCollector::contains(const std::string& type) const {
  return std::any_of(schemas_.begin(), schemas_.end(), [&](const auto& schema) { return schema.type == type; });
}

std::string ros2msg_text(const MessageSchemas& schemas) {
  DOCENT_CHECK(!schemas.empty());
  std::string text = fields_as_ros2msg(schemas.back());
  for (auto schema = schemas.begin(); schema != schemas.end() - 1; ++schema) {
    text += std::string(80, '=') + "\nMSG: " + without_msg(schema->type) + "\n" + fields_as_ros2msg(*schema);
  }
  return text;
}

std::string idl_text(const MessageSchemas& schemas) {
  std::string text;
  for (const auto& schema : schemas) text += struct_as_idl(schema);
  return text;
}

std::string dds_type_name(const std::string& type) {
  const auto [package, name] = split(type);
  // Of messages msg, of what actions and services send action and srv.
  const auto last = type.rfind('/');
  const std::string kind = last > package.size() ? type.substr(package.size() + 1, last - package.size() - 1) : "msg";
  return package + "::" + kind + "::dds_::" + name + "_";
}

}  // namespace docent
