#include "docent/transport/type_hash.h"

#include <map>

#include "docent/base/check.h"
#include "docent/messages/topics.h"
#include "docent/transport/digest/sha256.h"
#include "docent/transport/ros_graph.h"

namespace docent::transport {
namespace {

// Numbers of type_description_interfaces/msg/FieldType.
constexpr int kNested = 1;
constexpr int kBoundedString = 21;
constexpr int kArray = 48;      // added to that of what it holds
constexpr int kSequence = 144;  // likewise, without a bound

constexpr std::string_view kBound = "string<=";

int number_of(const FieldSchema& field) {
  static const std::map<std::string, int, std::less<>> kNumbers{
      {"int8", 2},   {"uint8", 3},    {"int16", 4},    {"uint16", 5}, {"int32", 6}, {"uint32", 7}, {"int64", 8},
      {"uint64", 9}, {"float32", 10}, {"float64", 11}, {"bool", 15},  {"byte", 16}, {"string", 17}};
  if (field.is_message) return kNested;
  if (field.type.starts_with(kBound)) return kBoundedString;
  return kNumbers.at(field.type);
}

std::string description_of(const FieldSchema& field) {
  const bool is_array = field.shape == FieldSchema::Shape::array;
  const bool is_sequence = field.shape == FieldSchema::Shape::sequence;
  const int number = number_of(field) + (is_array ? kArray : 0) + (is_sequence ? kSequence : 0);
  const std::string bound = field.type.starts_with(kBound) ? field.type.substr(kBound.size()) : "0";
  return R"({"name": ")" + field.name + R"(", "type": {"type_id": )" + std::to_string(number) + R"(, "capacity": )" +
         std::to_string(is_array ? field.size : 0) + R"(, "string_capacity": )" + bound + R"(, "nested_type_name": ")" +
         (field.is_message ? field.type : "") + R"("}})";
}

std::string description_of(const MessageSchema& schema) {
  std::string fields;
  for (const FieldSchema& field : schema.fields) fields += (fields.empty() ? "" : ", ") + description_of(field);
  return R"({"type_name": ")" + schema.type + R"(", "fields": [)" + fields + "]}";
}

template <Message T>
void add(std::map<std::string, std::string, std::less<>>& hashes) {
  if (const auto [place, is_new] = hashes.try_emplace(T::kType); is_new)
    place->second = type_hash(message_schemas<T>());
}

std::map<std::string, std::string, std::less<>> all_hashes() {
  std::map<std::string, std::string, std::less<>> hashes;
  const auto add_type_of = [&hashes]<class T>(const Topic<T>&) { add<T>(hashes); };
  for_each_robot_topic(add_type_of);
  for_each_truth_topic(add_type_of);
  add<geometry_msgs::TwistStamped>(hashes);
  hashes[ParticipantEntitiesInfo::kType] = type_hash(schemas_of_participant_entities());
  return hashes;
}

}  // namespace

std::string type_hash(const MessageSchemas& schemas) {
  DOCENT_CHECK(!schemas.empty());
  std::map<std::string, std::string> nested;  // by name, which is their order
  for (auto schema = schemas.begin(); schema != schemas.end() - 1; ++schema)
    nested[schema->type] = description_of(*schema);
  std::string others;
  for (const auto& [name, description] : nested) others += (others.empty() ? "" : ", ") + description;
  return "RIHS01_" + sha256(R"({"type_description": )" + description_of(schemas.back()) +
                            R"(, "referenced_type_descriptions": [)" + others + "]}");
}

const std::string& type_hash_of(std::string_view type) {
  static const auto kHashes = all_hashes();
  static const std::string kNone;
  const auto found = kHashes.find(type);
  return found == kHashes.end() ? kNone : found->second;
}

std::string endpoint_user_data(std::string_view type) {
  const std::string& hash = type_hash_of(type);
  return hash.empty() ? std::string{} : "typehash=" + hash + ";";
}

}  // namespace docent::transport
