#include "docent/recording/rosbag/ros1_bag.h"

#include <fstream>
#include <map>
#include <optional>
#include <span>
#include <string_view>

#include "docent/recording/mcap/format.h"
#include "docent/recording/mcap/lz4.h"
#include "docent/recording/rosbag/ros1_messages.h"
#include "docent/recording/rosbag/unpacking.h"

namespace docent::recording {
namespace {

using Bytes = std::span<const std::uint8_t>;
using mcap::ByteReader;  // lengths of four bytes before what they count, little endian, as here

constexpr std::string_view kMagic{"#ROSBAG V2.0\n"};
constexpr std::uint32_t kMostBytes = 1U << 30U;  ///< of one record

enum Op : std::uint8_t { kMessage = 0x02, kHead = 0x03, kChunk = 0x05, kConnection = 0x07 };

/// The fields of a record's head: "name=value", by name.
using Fields = std::map<std::string, std::string>;

std::optional<Fields> fields_of(Bytes head) {
  Fields fields;
  ByteReader reader{head};
  while (reader.good() && reader.left() > 0) {
    const std::string field = reader.text();
    const std::size_t equals = field.find('=');
    if (!reader.good() || equals == std::string::npos) return std::nullopt;
    fields[field.substr(0, equals)] = field.substr(equals + 1);
  }
  return reader.good() ? std::optional{std::move(fields)} : std::nullopt;
}

template <class T>
T number_of(const Fields& fields, const char* name) {
  T number{};
  const auto field = fields.find(name);
  if (field != fields.end() && field->second.size() == sizeof(T)) std::memcpy(&number, field->second.data(), sizeof(T));
  return number;
}
std::string text_of(const Fields& fields, const char* name) {
  const auto field = fields.find(name);
  return field == fields.end() ? std::string{} : field->second;
}

struct Connection {
  std::string topic, type;
};

class Ros1Bag {
 public:
  Ros1Bag(const std::filesystem::path& path, const std::function<bool(const Rosbag2Message&)>& handler,
          std::vector<std::string>& notes)
      : name_{path.string()}, file_{path, std::ios::binary}, handler_{handler}, notes_{notes} {}

  Result<void> read() {
    std::string magic(kMagic.size(), '\0');
    if (!file_.read(magic.data(), static_cast<std::streamsize>(magic.size()))) return fail(name_ + ": is no ROS 1 bag");
    if (magic != kMagic)
      return fail(name_ + ": a ROS 1 bag of another format than 2.0: `rosbag migrate` or `rosbag fix` makes one of it");
    std::vector<std::uint8_t> head, data;
    while (wants_more_ && file_.peek() != std::char_traits<char>::eof()) {
      const bool has_head = read_part(head);
      const bool is_cut = !has_head || !read_part(data);
      if (is_cut) notes_.push_back(name_ + ": ends early; what came before is used");
      if (!has_head) break;
      const auto fields = fields_of(head);
      if (is_cut) {
        if (fields && number_of<std::uint8_t>(*fields, "op") == kChunk) take_cut_chunk(*fields, data);
        break;
      }
      if (!fields) {
        notes_.push_back(name_ + ": a broken record; what came before is used");
        break;
      }
      const auto op = number_of<std::uint8_t>(*fields, "op");
      if (const std::string encryptor = text_of(*fields, "encryptor"); op == kHead && !encryptor.empty())
        return fail(name_ + ": is encrypted by " + encryptor.substr(0, 60) +
                    ": `rosbag decrypt` makes a plain one of it");
      if (op == kChunk)
        take_chunk(*fields, data);
      else
        take(*fields, data);
    }
    return {};
  }

 private:
  /// False where the file ends first; then what is there.
  bool read_part(std::vector<std::uint8_t>& bytes) {
    std::uint32_t size = 0;
    bytes.clear();
    if (!file_.read(reinterpret_cast<char*>(&size), sizeof size) || size > kMostBytes) return false;
    bytes.resize(size);
    const bool is_whole{file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))};
    if (!is_whole) bytes.resize(static_cast<std::size_t>(file_.gcount()));
    return is_whole;
  }

  void take_cut_chunk(const Fields& fields, const std::vector<std::uint8_t>& packed) {
    const std::string compression = text_of(fields, "compression");
    const auto size = number_of<std::uint32_t>(fields, "size");
    is_damage_said_ = true;  // that the file ends early is
    if (compression == "none" || compression.empty()) take_records(packed);
    if (compression == "bz2") take_records(unpack_cut_bz2(packed, size));
    if (compression == "lz4") take_records(mcap::unpack_cut_lz4(packed, size));
  }

  void take_chunk(const Fields& fields, const std::vector<std::uint8_t>& packed) {
    const std::string compression = text_of(fields, "compression");
    const auto size = number_of<std::uint32_t>(fields, "size");
    if (compression == "none" || compression.empty()) return take_records(packed);
    Result<std::vector<std::uint8_t>> records = fail("unknown compression '" + compression.substr(0, 20) + "'");
    if (compression == "bz2") records = unpack_bz2(packed, size);
    if (compression == "lz4") records = mcap::unpack_lz4(packed, size);
    if (!records) {
      if (!is_damage_said_) notes_.push_back(name_ + ": a chunk is left out: " + records.error().message);
      is_damage_said_ = true;
      return;
    }
    take_records(*records);
  }

  void take_records(Bytes records) {
    ByteReader reader{records};
    while (wants_more_ && reader.left() > 0) {
      const Bytes head = reader.bytes(reader.number<std::uint32_t>());
      const Bytes data = reader.bytes(reader.number<std::uint32_t>());
      const auto fields = reader.good() ? fields_of(head) : std::nullopt;
      if (!fields) {
        if (!is_damage_said_) notes_.push_back(name_ + ": the rest of a chunk is broken and left out");
        is_damage_said_ = true;
        return;
      }
      take(*fields, data);
    }
  }

  void take(const Fields& fields, Bytes data) {
    const auto op = number_of<std::uint8_t>(fields, "op");
    const auto id = number_of<std::uint32_t>(fields, "conn");
    if (op == kConnection) {
      const auto about = fields_of(data);
      connections_[id] = {text_of(fields, "topic"), about ? text_of(*about, "type") : std::string{}};
      if (!connections_[id].topic.starts_with('/')) connections_[id].topic.insert(0, "/");
    }
    if (op != kMessage) return;
    const auto connection = connections_.find(id);
    if (connection == connections_.end()) return;
    const ConvertedMessage message = converted_from_ros1(connection->second.type, data);
    const auto time = number_of<std::uint64_t>(fields, "time");  // seconds, then nanoseconds
    const auto seconds = static_cast<std::int64_t>(time & 0xffffffffU),
               nanoseconds = static_cast<std::int64_t>(time >> 32U);
    const std::string type =
        message.type != nullptr ? std::string{message.type} : ros2_name_of(connection->second.type);
    wants_more_ = handler_({connection->second.topic, type, Time{seconds * 1'000'000'000 + nanoseconds}, message.data});
  }

  const std::string name_;
  std::ifstream file_;
  const std::function<bool(const Rosbag2Message&)>& handler_;
  std::vector<std::string>& notes_;
  std::map<std::uint32_t, Connection> connections_;
  bool wants_more_ = true, is_damage_said_ = false;
};

}  // namespace

Result<void> read_ros1_bag(const std::filesystem::path& path, const std::function<bool(const Rosbag2Message&)>& handler,
                           std::vector<std::string>& notes) {
  return Ros1Bag{path, handler, notes}.read();
}

}  // namespace docent::recording
