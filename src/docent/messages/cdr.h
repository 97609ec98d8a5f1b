#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "docent/base/result.h"

// CDR as ROS 2 sends it: XCDR1, little endian, a header of four bytes; alignment counts from behind the header.

namespace docent {

static_assert(std::endian::native == std::endian::little, "payloads are written in the machine's order");

template <class T>
concept Message = requires {
  T::kType;
};

class CdrWriter {
 public:
  CdrWriter() : bytes_{0x00, 0x01, 0x00, 0x00} {}

  template <class T>
  void operator()(const char* /*name*/, const T& field) {
    write(field);
  }
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  template <class T>
  void write(const T& field) {
    if constexpr (Message<T>) {
      T::visit(field, *this);
    } else if constexpr (std::is_same_v<T, bool>) {
      bytes_.push_back(field ? 1 : 0);
    } else {
      static_assert(std::is_arithmetic_v<T>);
      append(&field, sizeof(T), 1);
    }
  }
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
  }
  template <class T>
  void write(const std::vector<T>& items) {
    write(static_cast<std::uint32_t>(items.size()));
    write_items(std::span<const T>{items});
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& items) {
    write_items(std::span<const T>{items});
  }
  template <class T>
  void write_items(std::span<const T> items) {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (!items.empty()) append(items.data(), sizeof(T), items.size());
    } else {
      for (const auto& item : items) write(item);
    }
  }
  void append(const void* data, std::size_t size, std::size_t count) {
    while ((bytes_.size() - 4) % size != 0) bytes_.push_back(0);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + size * count);
    std::memcpy(bytes_.data() + at, data, size * count);
  }
  std::vector<std::uint8_t> bytes_;
};

/// Reads what CdrWriter (or any ROS 2 peer on a little-endian machine) wrote. After a fault all reads do nothing.
class CdrReader {
 public:
  /// @param may_be_older  the bytes may end between two fields of the message itself, behind the first one: whoever
  /// wrote them did not know the later fields, which keep what they are (messages only grow)
  explicit CdrReader(std::span<const std::uint8_t> bytes, bool may_be_older = false)
      : bytes_{bytes}, may_be_older_{may_be_older} {
    if (bytes.size() < 4 || bytes[0] != 0 || bytes[1] != 1) good_ = false;
    at_ = 4;
  }

  template <class T>
  void operator()(const char* /*name*/, T& field) {
    if (may_be_older_ && depth_ == 0 && at_ > 4 && at_ == bytes_.size()) return;
    read(field);
  }
  [[nodiscard]] bool good() const { return good_; }

 private:
  template <class T>
  void read(T& field) {
    if constexpr (Message<T>) {
      ++depth_;
      T::visit(field, *this);
      --depth_;
    } else if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      read(byte);
      field = byte != 0;
    } else {
      take(&field, sizeof(T), 1);
    }
  }
  void read(std::string& text) {
    std::uint32_t size = 0;
    read(size);
    if (!good_ || size > bytes_.size() - at_) return spoil();
    text.assign(reinterpret_cast<const char*>(bytes_.data() + at_), size == 0 ? 0 : size - 1);
    at_ += size;
  }
  template <class T>
  void read(std::vector<T>& items) {
    std::uint32_t count = 0;
    read(count);
    items.clear();
    // Every element takes at least a byte, so a longer count is a lie: do not allocate for it.
    if (!good_ || count > bytes_.size() - at_) return spoil();
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (count > (bytes_.size() - at_) / sizeof(T)) return spoil();
      items.resize(count);
      if (count > 0) take(items.data(), sizeof(T), count);
    } else {
      for (std::uint32_t i = 0; i < count && good_; ++i) {
        items.emplace_back();
        read(items.back());
      }
    }
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& items) {
    for (auto& item : items) read(item);
  }
  void take(void* data, std::size_t size, std::size_t count) {
    if (!good_) return;
    const std::size_t start = at_ + (size - (at_ - 4) % size) % size;
    if (start > bytes_.size() || size * count > bytes_.size() - start) return spoil();
    std::memcpy(data, bytes_.data() + start, size * count);
    at_ = start + size * count;
  }
  void spoil() { good_ = false; }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 4;
  int depth_ = 0;  ///< of the message that is being read in the message
  bool may_be_older_ = false;
  bool good_ = true;
};

template <Message T>
[[nodiscard]] std::vector<std::uint8_t> encode_cdr(const T& message) {
  CdrWriter writer;
  T::visit(message, writer);
  return writer.take();
}

/// Error when the bytes end early or lie about a length. Docent's own messages may have been written by an older
/// Docent.
template <Message T>
[[nodiscard]] Result<T> decode_cdr(std::span<const std::uint8_t> bytes) {
  CdrReader reader{bytes, std::string_view{T::kType}.starts_with("docent_msgs/")};
  T message;
  T::visit(message, reader);
  if (!reader.good()) return fail(std::string{"damaged "} + T::kType);
  return message;
}

}  // namespace docent
