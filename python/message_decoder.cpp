#include "message_decoder.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "arguments.h"

namespace docent::python {
namespace {

struct Primitive {
  const char* name;
  const char* dtype;
  std::size_t width;
};
constexpr Primitive kPrimitives[] = {
    {"bool", "?", 1},     {"byte", "u1", 1},     {"char", "u1", 1},     {"int8", "i1", 1},    {"uint8", "u1", 1},
    {"int16", "<i2", 2},  {"uint16", "<u2", 2},  {"int32", "<i4", 4},   {"uint32", "<u4", 4}, {"int64", "<i8", 8},
    {"uint64", "<u8", 8}, {"float32", "<f4", 4}, {"float64", "<f8", 8}, {"string", "", 0},
};

const Primitive* find_primitive(std::string_view name) {
  const auto* const found =
      std::find_if(std::begin(kPrimitives), std::end(kPrimitives), [&](const Primitive& p) { return name == p.name; });
  return found == std::end(kPrimitives) ? nullptr : found;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The next line, which goes from `text`.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

bool is_separator(std::string_view line) {
  return line.size() >= 3 && line.find_first_not_of('=') == std::string_view::npos;
}

/// "sensor_msgs/msg/LaserScan" to "sensor_msgs/LaserScan".
std::string short_name(std::string_view type) {
  const std::size_t first = type.find('/');
  const std::size_t last = type.rfind('/');
  if (first == std::string_view::npos) return std::string{type};
  return std::string{type.substr(0, first)} + "/" + std::string{type.substr(last + 1)};
}

std::string package_of(const std::string& short_type) { return short_type.substr(0, short_type.find('/')); }

}  // namespace

Result<MessageDecoder> MessageDecoder::parse(const std::string& type, std::string_view text) {
  // First the names of all types, for they may be used before they are described.
  struct Block {
    std::string type;
    std::string lines;
  };
  std::vector<Block> blocks{{short_name(type), ""}};
  bool begins = false;
  while (!text.empty()) {
    const std::string_view line = trimmed(take_line(text));
    if (is_separator(line)) {
      begins = true;
    } else if (begins && line.starts_with("MSG:")) {
      blocks.push_back({short_name(trimmed(line.substr(4))), ""});
      begins = false;
    } else {
      blocks.back().lines += std::string{line} + "\n";
    }
  }
  MessageDecoder decoder;
  for (const Block& block : blocks) decoder.index_.emplace(block.type, static_cast<int>(decoder.index_.size()));
  decoder.types_.resize(decoder.index_.size());
  for (const Block& block : blocks) {
    Fields& fields = decoder.types_[static_cast<std::size_t>(decoder.index_[block.type])];
    if (!fields.empty()) continue;  // described twice
    if (auto added = decoder.add(package_of(block.type), block.lines, fields); !added)
      return fail(block.type + ": " + added.error().message);
  }
  return decoder;
}

Result<void> MessageDecoder::add(const std::string& package, std::string_view lines, Fields& fields) {
  while (!lines.empty()) {
    std::string_view line = take_line(lines);
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const std::size_t space = line.find_first_of(" \t");
    if (space == std::string_view::npos) return fail("'" + std::string{line} + "' is no field");
    const std::string_view rest = trimmed(line.substr(space));
    const std::size_t end = rest.find_first_of(" \t=");
    const std::string_view after = end == std::string_view::npos ? "" : trimmed(rest.substr(end));
    if (after.starts_with("=")) continue;  // a constant
    Field field;
    field.name = rest.substr(0, end);
    if (auto set = set_type(package, std::string{line.substr(0, space)}, field); !set) return set;
    fields.push_back(std::move(field));
  }
  return {};
}

Result<void> MessageDecoder::set_type(const std::string& package, std::string type, Field& field) {
  const std::string whole = type;
  if (const std::size_t bracket = type.find('['); bracket != std::string::npos) {
    if (!whole.ends_with(']')) return fail("'" + whole + "' is no type");
    const std::string_view inside = std::string_view{whole}.substr(bracket + 1, whole.size() - bracket - 2);
    field.shape = inside.empty() || inside.starts_with("<=") ? Shape::sequence : Shape::array;
    if (field.shape == Shape::array) {
      const auto [end, code] = std::from_chars(inside.data(), inside.data() + inside.size(), field.size);
      if (code != std::errc{} || end != inside.data() + inside.size()) return fail("'" + whole + "' is no type");
    }
    type.resize(bracket);
  }
  type.resize(std::min(type.find("<="), type.size()));  // string<=80
  if (const Primitive* primitive = find_primitive(type)) {
    field.type = primitive->dtype;
    field.width = primitive->width;
    return {};
  }
  auto found = index_.find(short_name(type));
  if (found == index_.end()) found = index_.find(package + "/" + type);
  if (found == index_.end() && type == "Header") found = index_.find("std_msgs/Header");
  if (found == index_.end()) return fail("the type '" + type + "' is not described");
  field.message = found->second;
  return {};
}

/// One message on its way through the bytes.
class MessageDecoder::Reading {
 public:
  Reading(const MessageDecoder& decoder, std::span<const std::uint8_t> bytes)
      : types_{decoder.types_}, bytes_{bytes}, left_{kValues + 16 * bytes.size()} {
    if (bytes.size() < kHeader || bytes[0] != 0 || bytes[1] != 1) throw Failed{"this is not CDR in little endian"};
  }

  py::object message(std::size_t type, int depth) {
    if (depth > kDeepest) throw Failed{"the type nests too deeply"};
    py::dict fields;
    for (const Field& field : types_[type]) fields[text_of(field.name)] = value(field, depth);
    return py::module_::import("types").attr("SimpleNamespace")(**fields);
  }

 private:
  static constexpr std::size_t kHeader = 4;
  static constexpr std::size_t kValues = 100000;  ///< that a message may hold beyond those that its bytes are
  static constexpr int kDeepest = 32;

  py::object value(const Field& field, int depth) {
    if (field.shape == Shape::single) return single(field, depth);
    const std::size_t count = field.shape == Shape::array ? field.size : number<std::uint32_t>();
    if (field.message < 0 && field.width > 0) return numbers(field, count);
    py::list items;
    for (std::size_t i = 0; i < count; ++i) items.append(single(field, depth));
    return items;
  }

  py::object single(const Field& field, int depth) {
    if (left_-- == 0) throw Failed{"the message holds more values than its bytes can be"};
    if (field.message >= 0) return message(static_cast<std::size_t>(field.message), depth + 1);
    if (field.width > 0) return numbers(field, 1).attr("item")(0);
    const std::size_t size = number<std::uint32_t>();
    const auto* const text = reinterpret_cast<const char*>(take(size, 1));
    return text_of(std::string_view{text, size == 0 ? 0 : size - 1});
  }

  py::array numbers(const Field& field, std::size_t count) {
    if (count > bytes_.size() / field.width) throw Failed{"the message ends early"};
    const std::uint8_t* const from = take(count * field.width, count > 0 ? field.width : 1);
    py::array array{py::dtype{field.type}, std::vector<py::ssize_t>{length(count)}};
    std::memcpy(array.mutable_data(), from, count * field.width);
    return array;
  }

  template <class T>
  T number() {
    T value{};
    std::memcpy(&value, take(sizeof(T), sizeof(T)), sizeof(T));
    return value;
  }

  const std::uint8_t* take(std::size_t size, std::size_t alignment) {
    at_ += (alignment - (at_ - kHeader) % alignment) % alignment;
    if (at_ > bytes_.size() || size > bytes_.size() - at_) throw Failed{"the message ends early"};
    const std::uint8_t* const from = bytes_.data() + at_;
    at_ += size;
    return from;
  }

  const std::vector<Fields>& types_;
  std::span<const std::uint8_t> bytes_;
  std::size_t left_;
  std::size_t at_ = kHeader;
};

py::object MessageDecoder::decode(std::span<const std::uint8_t> bytes) const {
  return Reading{*this, bytes}.message(0, 0);
}

}  // namespace docent::python
