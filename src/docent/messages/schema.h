#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "docent/messages/cdr.h"

// Descriptions of messages for others: the text that a recording embeds and the IDL that a DDS tool compiles. Both are
// derived from the one `visit` of each message, so they cannot drift from what is on the wire.

namespace docent {

struct FieldSchema {
  enum class Shape { single, sequence, array };
  std::string name;
  std::string type;  ///< "float64", "string", "byte", … or a message's "geometry_msgs/msg/Pose"
  bool is_message = false;
  Shape shape = Shape::single;
  std::size_t size = 0;  ///< of an array
};

struct MessageSchema {
  std::string type;  ///< "sensor_msgs/msg/LaserScan"
  std::vector<FieldSchema> fields;
};

/// A message and all that it nests, every one once, those that others need first; the message itself is the last.
using MessageSchemas = std::vector<MessageSchema>;

/// Collects schemas by visiting messages.
class SchemaCollector {
 public:
  template <Message T>
  void add() {
    if (contains(T::kType)) return;
    MessageSchema schema{T::kType, {}};
    FieldVisitor visitor{*this, schema};
    if constexpr (requires { T::kOctetField; }) visitor.octet_field = T::kOctetField;
    T message;
    T::visit(message, visitor);
    schemas_.push_back(std::move(schema));
  }
  [[nodiscard]] MessageSchemas take() { return std::move(schemas_); }

 private:
  struct FieldVisitor {
    SchemaCollector& collector;
    MessageSchema& schema;
    const char* octet_field = nullptr;  ///< the one that ROS 2 calls byte
    template <class F>
    void operator()(const char* name, const F& /*field*/) {
      FieldSchema field;
      field.name = name;
      describe(static_cast<const F*>(nullptr), field);
      if (octet_field != nullptr && field.name == octet_field) field.type = "byte";
      schema.fields.push_back(std::move(field));
    }
    template <class F>
    void describe(const F* /*type*/, FieldSchema& field) {
      if constexpr (Message<F>) {
        collector.add<F>();
        field.type = F::kType;
        field.is_message = true;
      } else {
        field.type = primitive_name<F>();
      }
    }
    template <class F>
    void describe(const std::vector<F>* /*type*/, FieldSchema& field) {
      field.shape = FieldSchema::Shape::sequence;
      describe(static_cast<const F*>(nullptr), field);
    }
    template <class F, std::size_t N>
    void describe(const std::array<F, N>* /*type*/, FieldSchema& field) {
      field.shape = FieldSchema::Shape::array;
      field.size = N;
      describe(static_cast<const F*>(nullptr), field);
    }
  };
  template <class F>
  static const char* primitive_name() {
    if constexpr (std::is_same_v<F, bool>) return "bool";
    if constexpr (std::is_same_v<F, std::int8_t>) return "int8";
    if constexpr (std::is_same_v<F, std::uint8_t>) return "uint8";
    if constexpr (std::is_same_v<F, std::int16_t>) return "int16";
    if constexpr (std::is_same_v<F, std::uint16_t>) return "uint16";
    if constexpr (std::is_same_v<F, std::int32_t>) return "int32";
    if constexpr (std::is_same_v<F, std::uint32_t>) return "uint32";
    if constexpr (std::is_same_v<F, std::int64_t>) return "int64";
    if constexpr (std::is_same_v<F, std::uint64_t>) return "uint64";
    if constexpr (std::is_same_v<F, float>) return "float32";
    if constexpr (std::is_same_v<F, double>) return "float64";
    if constexpr (std::is_same_v<F, std::string>) return "string";
  }
  [[nodiscard]] bool contains(const std::string& type) const;

  MessageSchemas schemas_;
};

template <Message T>
[[nodiscard]] MessageSchemas message_schemas() {
  SchemaCollector collector;
  collector.add<T>();
  return collector.take();
}

/// MCAP's schema encoding "ros2msg": the fields of the last message, then a block "MSG: pkg/Name" behind a line of '='
/// for each of the others.
[[nodiscard]] std::string ros2msg_text(const MessageSchemas& schemas);

/// IDL as ROS 2 names it on DDS: sensor_msgs/msg/LaserScan becomes sensor_msgs::msg::dds_::LaserScan_.
[[nodiscard]] std::string idl_text(const MessageSchemas& schemas);

/// "sensor_msgs/msg/LaserScan" to "sensor_msgs::msg::dds_::LaserScan_".
[[nodiscard]] std::string dds_type_name(const std::string& type);

}  // namespace docent
