#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The bytes of an MCAP file: magic, records (one byte kind, eight bytes length, content), magic. All numbers little
// endian, strings with a length of four bytes in front, maps and arrays with their size in bytes in front.

namespace docent::recording::mcap {

inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class Kind : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

inline constexpr std::size_t kRecordHead = 9;  ///< kind and length
inline constexpr std::size_t kFooterSize = kRecordHead + 8 + 8 + 4;

/// Appends numbers and texts to a buffer.
class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::uint8_t>& bytes) : bytes_{bytes} {}

  void raw(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }
  template <class T>
  void number(T value) {
    raw(&value, sizeof value);
  }
  void text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    raw(value.data(), value.size());
  }
  void texts(const std::map<std::string, std::string>& entries) {
    std::vector<std::uint8_t> inner;
    ByteWriter writer{inner};
    for (const auto& [key, value] : entries) {
      writer.text(key);
      writer.text(value);
    }
    number(static_cast<std::uint32_t>(inner.size()));
    raw(inner.data(), inner.size());
  }
  /// Writes kind and a length to be filled in by `end`; returns what `end` wants.
  [[nodiscard]] std::size_t begin(Kind kind) {
    number(static_cast<std::uint8_t>(kind));
    number(std::uint64_t{0});
    return bytes_.size();
  }
  void end(std::size_t begun) {
    const std::uint64_t length = bytes_.size() - begun;
    std::memcpy(bytes_.data() + begun - sizeof length, &length, sizeof length);
  }

 private:
  std::vector<std::uint8_t>& bytes_;
};

/// Takes numbers and texts off a piece of memory. After the first piece that is not there everything reads as zero or
/// empty and good() is false.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : rest_{bytes} {}

  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }
  [[nodiscard]] std::span<const std::uint8_t> bytes(std::uint64_t size) {
    if (size > rest_.size()) {
      good_ = false;
      rest_ = {};
      return {};
    }
    const auto taken = rest_.first(static_cast<std::size_t>(size));
    rest_ = rest_.subspan(static_cast<std::size_t>(size));
    return taken;
  }
  template <class T>
  [[nodiscard]] T number() {
    T value{};
    const auto taken = bytes(sizeof(T));
    if (taken.size() == sizeof(T)) std::memcpy(&value, taken.data(), sizeof(T));
    return value;
  }
  [[nodiscard]] std::string text() {
    const auto taken = bytes(number<std::uint32_t>());
    return {taken.begin(), taken.end()};
  }
  [[nodiscard]] std::map<std::string, std::string> texts() {
    ByteReader inner{bytes(number<std::uint32_t>())};
    std::map<std::string, std::string> entries;
    while (inner.good() && inner.left() > 0) {
      std::string key = inner.text();
      entries[std::move(key)] = inner.text();
    }
    good_ = good_ && inner.good();
    return entries;
  }

 private:
  std::span<const std::uint8_t> rest_;
  bool good_ = true;
};

}  // namespace docent::recording::mcap
