#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "docent/base/result.h"

namespace docent::python {

/// Decodes messages of any type whose text a recording holds (ros2msg), from CDR, little endian: fields become those of
/// a types.SimpleNamespace, sequences of numbers become arrays.
class MessageDecoder {
 public:
  /// `text`: the type's fields and, behind lines of '=', those of all types that it nests. Error: not understood.
  [[nodiscard]] static Result<MessageDecoder> parse(const std::string& type, std::string_view text);

  /// Raises Failed where the bytes are too few, or nest or hold more than bytes can.
  [[nodiscard]] pybind11::object decode(std::span<const std::uint8_t> bytes) const;

 private:
  enum class Shape { single, sequence, array };
  struct Field {
    std::string name;
    std::string type;       ///< of a primitive
    int message = -1;       ///< index in types_; -1: a primitive
    std::size_t width = 0;  ///< [bytes] of a primitive; 0: a string
    Shape shape = Shape::single;
    std::size_t size = 0;  ///< of an array
  };
  using Fields = std::vector<Field>;
  class Reading;

  [[nodiscard]] Result<void> add(const std::string& package, std::string_view lines, Fields& fields);
  [[nodiscard]] Result<void> set_type(const std::string& package, std::string type, Field& field);

  std::map<std::string, int> index_;  ///< by "package/Name"
  std::vector<Fields> types_;         ///< the message itself is the first
};

}  // namespace docent::python
