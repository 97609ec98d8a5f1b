#include "docent/recording/older_layout.h"

#include <algorithm>
#include <cstring>
#include <sstream>

namespace docent::recording {
namespace {

constexpr std::size_t kHeader = 4;  // [bytes] before a message; alignment counts from behind them
constexpr int kDeepest = 8;         // messages in messages; a schema that names itself would never end

/// [bytes]; 0: no primitive of fixed size.
std::size_t size_of(const std::string& type) {
  static const std::map<std::string, std::size_t> kSizes{{"bool", 1},   {"int8", 1},   {"uint8", 1},  {"int16", 2},
                                                         {"uint16", 2}, {"int32", 4},  {"uint32", 4}, {"float32", 4},
                                                         {"int64", 8},  {"uint64", 8}, {"float64", 8}};
  const auto found = kSizes.find(type);
  return found == kSizes.end() ? 0 : found->second;
}

bool is_same(const FieldSchema& a, const FieldSchema& b) {
  return a.name == b.name && a.type == b.type && a.shape == b.shape && a.size == b.size;
}

/// nullopt: it is no line of a schema.
std::optional<FieldSchema> field_of(const std::string& line) {
  FieldSchema field;
  std::istringstream parts{line};
  if (!(parts >> field.type >> field.name) || field.name.find('=') != std::string::npos) return std::nullopt;
  if (const std::size_t open = field.type.find('['); open != std::string::npos) {
    const std::string count = field.type.substr(open + 1, field.type.size() - open - 2);
    const bool is_number = !count.empty() && count.size() < 6 && count.find_first_not_of("0123456789") == count.npos;
    if (!count.empty() && !is_number) return std::nullopt;
    field.shape = count.empty() ? FieldSchema::Shape::sequence : FieldSchema::Shape::array;
    if (is_number) field.size = std::stoul(count);
    field.type.resize(open);
  }
  field.is_message = field.type.find('/') != std::string::npos;
  if (!field.is_message && field.type != "string" && size_of(field.type) == 0) return std::nullopt;
  return field;
}

}  // namespace

/// One message on its way from their layout to ours.
class LayoutTranslator {
 public:
  LayoutTranslator(const OlderLayout& layout, std::span<const std::uint8_t> bytes) : layout_{layout}, bytes_{bytes} {
    good_ = bytes.size() >= kHeader;
    if (good_) out_.assign(bytes.begin(), bytes.begin() + kHeader);
  }
  std::optional<std::vector<std::uint8_t>> run() {
    if (good_) carry("", 0);
    return good_ ? std::optional{std::move(out_)} : std::nullopt;
  }

 private:
  using Fields = OlderLayout::Fields;
  void spoil() { good_ = false; }
  const Fields& fields_of(const OlderLayout::Types& types, const std::string& type) {
    static const Fields kNone;
    const auto found = types.find(type);
    if (found != types.end()) return found->second;
    spoil();
    return kNone;
  }

  /// The bytes of a value that stands here, behind its padding.
  std::span<const std::uint8_t> take(std::size_t size, std::size_t alignment) {
    const std::size_t start = at_ + (alignment - (at_ - kHeader) % alignment) % alignment;
    if (!good_ || start > bytes_.size() || size > bytes_.size() - start) {
      spoil();
      return {};
    }
    at_ = start + size;
    return bytes_.subspan(start, size);
  }
  void put(std::span<const std::uint8_t> value, std::size_t alignment) {
    while ((out_.size() - kHeader) % alignment != 0) out_.push_back(0);
    out_.insert(out_.end(), value.begin(), value.end());
  }
  /// A length, which is also put if `is_wanted`.
  std::size_t take_count(bool is_wanted) {
    const auto bytes = take(4, 4);
    std::uint32_t count = 0;
    if (bytes.size() == 4) std::memcpy(&count, bytes.data(), 4);
    // Every element takes at least a byte: a longer count is a lie.
    if (!good_ || count > bytes_.size() - at_) {
      spoil();
      return 0;
    }
    if (is_wanted) put(bytes, 4);
    return count;
  }

  /// Passes a field of theirs over, or takes it along.
  void pass(const FieldSchema& field, bool is_wanted, int depth) {
    const std::size_t count = field.shape == FieldSchema::Shape::single  ? 1
                              : field.shape == FieldSchema::Shape::array ? field.size
                                                                         : take_count(is_wanted);
    for (std::size_t i = 0; i < count && good_; ++i) pass_one(field.type, field.is_message, is_wanted, depth);
  }
  void pass_one(const std::string& type, bool is_message, bool is_wanted, int depth) {
    if (depth > kDeepest) return spoil();
    if (is_message && is_wanted) return carry(type, depth + 1);
    if (is_message) {
      for (const FieldSchema& field : fields_of(layout_.theirs_, type)) pass(field, false, depth + 1);
      return;
    }
    const bool is_text = type == "string";
    const std::size_t size = is_text ? take_count(is_wanted) : size_of(type);
    const std::size_t alignment = is_text ? 1 : size;
    const auto value = take(size, alignment);
    if (is_wanted) put(value, alignment);
  }

  /// A field of ours that they do not have.
  void put_nothing(const FieldSchema& field, int depth) {
    static constexpr std::uint8_t kZeros[8]{};
    if (depth > kDeepest) return spoil();
    if (field.shape == FieldSchema::Shape::sequence) return put({kZeros, 4}, 4);
    const std::size_t count = field.shape == FieldSchema::Shape::array ? field.size : 1;
    for (std::size_t i = 0; i < count && good_; ++i) {
      if (field.is_message) {
        for (const FieldSchema& inner : fields_of(layout_.ours_, field.type)) put_nothing(inner, depth + 1);
      } else if (field.type == "string") {
        static constexpr std::uint8_t kEmpty[5]{1, 0, 0, 0, 0};  // its end counts
        put(kEmpty, 4);
      } else {
        put({kZeros, size_of(field.type)}, size_of(field.type));
      }
    }
  }

  /// A whole message of this type.
  void carry(const std::string& type, int depth) {
    const Fields& theirs = fields_of(layout_.theirs_, type);
    const Fields& ours = fields_of(layout_.ours_, type);
    std::map<std::string, std::size_t> begins;
    for (const FieldSchema& field : theirs) {
      begins[field.name] = at_;
      pass(field, false, depth);
    }
    const std::size_t end = at_;
    const auto have = [&](const FieldSchema& field) {
      return std::any_of(theirs.begin(), theirs.end(), [&](const FieldSchema& other) { return is_same(field, other); });
    };
    // Behind the last one that they have, the message's own fields keep their defaults: the bytes may end there.
    const auto last = std::find_if(ours.rbegin(), ours.rend(), have).base();
    for (auto field = ours.begin(); field != (depth == 0 ? last : ours.end()) && good_; ++field) {
      if (!have(*field)) {
        put_nothing(*field, depth);
        continue;
      }
      at_ = begins[field->name];
      pass(*field, true, depth);
    }
    at_ = end;
  }

  const OlderLayout& layout_;
  std::span<const std::uint8_t> bytes_;
  std::vector<std::uint8_t> out_;
  std::size_t at_ = kHeader;
  bool good_ = true;
};

OlderLayout::Types OlderLayout::parse(const std::string& schema) {
  Types types;
  std::string type;
  std::istringstream lines{schema};
  for (std::string line; std::getline(lines, line);) {
    line.resize(std::min(line.find('#'), line.size()));
    if (line.starts_with("MSG: ")) {
      type = line.substr(5);
      types[type];
    } else if (const auto field = field_of(line)) {
      types[type].push_back(*field);
    } else if (line.find_first_not_of(" =\t\r") != std::string::npos) {
      return {};
    }
  }
  return types;
}

std::optional<OlderLayout> OlderLayout::between(const std::string& theirs, const std::string& ours) {
  OlderLayout layout;
  layout.theirs_ = parse(theirs);
  layout.ours_ = parse(ours);
  if (layout.theirs_.empty() || layout.ours_.empty()) return std::nullopt;
  const auto is_alike = [](const auto& a, const auto& b) {
    return a.first == b.first &&
           std::equal(a.second.begin(), a.second.end(), b.second.begin(), b.second.end(), is_same);
  };
  if (std::equal(layout.theirs_.begin(), layout.theirs_.end(), layout.ours_.begin(), layout.ours_.end(), is_alike))
    return std::nullopt;
  return layout;
}

std::optional<std::vector<std::uint8_t>> OlderLayout::translated(std::span<const std::uint8_t> bytes) const {
  return LayoutTranslator{*this, bytes}.run();
}

}  // namespace docent::recording
