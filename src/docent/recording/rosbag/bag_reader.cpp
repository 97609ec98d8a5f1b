#include "docent/recording/rosbag/bag_reader.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string_view>

#include "docent/base/text.h"
#include "docent/recording/mcap/format.h"
#include "docent/recording/mcap/reader.h"
#include "docent/recording/rosbag/bag_metadata.h"
#include "docent/recording/rosbag/ros1_bag.h"
#include "docent/recording/rosbag/ros1_messages.h"
#include "docent/recording/rosbag/unpacking.h"

namespace docent::recording {
namespace {

namespace fs = std::filesystem;
using Handler = std::function<bool(const Rosbag2Message&)>;

bool is_mcap(const fs::path& path) {
  return begins_with(path, {reinterpret_cast<const char*>(mcap::kMagic.data()), mcap::kMagic.size()});
}
/// "#ROSRECORD V1.2" is the name of older ones.
bool is_ros1_bag(const fs::path& path) { return begins_with(path, "#ROSBAG V") || begins_with(path, "#ROSRECORD V"); }
bool is_database(const fs::path& path) { return begins_with(path, "SQLite format 3"); }

/// What was packed message by message, unpacked into `room`; nothing, where it is damaged.
std::span<const std::uint8_t> plain(std::span<const std::uint8_t> data, std::vector<std::uint8_t>& room) {
  if (!is_zstd(data)) return data;
  auto whole = unpack_zstd(data);
  room = whole ? std::move(*whole) : std::vector<std::uint8_t>{};
  return room;
}

Result<void> read_mcap(const fs::path& path, const Handler& handler, std::vector<std::string>& notes) {
  auto reader = McapReader::open(path);
  if (!reader) return tl::unexpected<Error>(reader.error());
  std::map<std::string, std::string> foreign;  // topic, encoding
  std::vector<std::uint8_t> unpacked;
  McapReader::Selection all;
  all.skip_damaged = true;
  auto read = reader->read(all, [&](const McapMessage& message) {
    const McapChannel& channel = message.channel;
    if (channel.encoding == "cdr" || channel.encoding.empty())
      return handler({channel.topic, channel.type, message.log_time, plain(message.data, unpacked)});
    if (channel.encoding != "ros1") {
      foreign[channel.topic] = channel.encoding;
      return true;
    }
    const ConvertedMessage converted = converted_from_ros1(channel.type, message.data);
    const std::string type = converted.type != nullptr ? std::string{converted.type} : ros2_name_of(channel.type);
    return handler({channel.topic, type, message.log_time, converted.data});
  });
  if (!reader->is_complete()) notes.push_back(path.string() + ": ends early; what came before is used");
  for (const auto& [topic, encoding] : foreign)
    notes.push_back("messages of " + topic + " are encoded as " + encoding + ", which is not read here: left out");
  if (const auto& damage = reader->damage(); !damage.empty())
    notes.push_back(damage.front() +
                    (damage.size() > 1 ? ", and at " + std::to_string(damage.size() - 1) + " more places" : "") +
                    ": left out");
  return read;
}

/// A folder that goes when it is left.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "docent-bag-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Result<void> read_file_of_bag(const fs::path& path, const Handler& handler, std::vector<std::string>& notes) {
  std::error_code code;
  if (fs::is_regular_file(path, code) && fs::file_size(path, code) == 0) return fail(path.string() + ": is empty");
  if (is_ros1_bag(path)) return read_ros1_bag(path, handler, notes);
  if (begins_with(path, "\x28\xb5\x2f\xfd")) {
    const Scratch scratch;
    if (scratch.path().empty()) return fail(path.string() + ": no folder to unpack it in");
    const fs::path unpacked = scratch.path() / path.stem();
    auto whole = unpack_zstd_file(path, unpacked);
    if (!whole && (!fs::exists(unpacked) || fs::file_size(unpacked) == 0)) return whole;
    if (!whole) notes.push_back(whole.error().message + ": what came before is used");
    return read_file_of_bag(unpacked, handler, notes);
  }
  if (is_database(path) || (path.extension() == ".db3" && !is_mcap(path)))
    return read_rosbag2_database(path, handler, notes);
  return read_mcap(path, handler, notes);
}

}  // namespace

bool is_bag(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return true;
  return is_part_of_bag(path) || path.extension() == ".bag" || is_mcap(path) || is_ros1_bag(path) ||
         (!fs::exists(path, error) && fs::exists(unfinished_path(path), error));
}

Result<void> read_bag(const fs::path& path, const Handler& handler, std::vector<std::string>& notes) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return read_file_of_bag(path, handler, notes);
  const auto parts = parts_of_bag(path, notes);
  if (parts.empty()) return fail(path.string() + ": holds no .mcap or .db3 file");
  std::size_t read = 0;
  bool wants_more = true;
  Result<void> first_fault;
  for (const fs::path& part : parts) {
    const auto done = read_file_of_bag(
        part, [&](const Rosbag2Message& message) { return wants_more = handler(message); }, notes);
    if (!wants_more) return {};
    if (done) {
      ++read;
      continue;
    }
    if (first_fault) first_fault = done;
    notes.push_back(done.error().message + ": what of it can be read is used");
  }
  if (read == 0 && parts.size() == 1) return first_fault;
  return {};
}

}  // namespace docent::recording
