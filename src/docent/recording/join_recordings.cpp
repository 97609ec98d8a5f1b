#include "docent/recording/join_recordings.h"

#include <map>
#include <optional>
#include <system_error>

#include "docent/recording/mcap/reader.h"
#include "docent/recording/mcap/writer.h"

namespace docent::recording {

std::set<std::filesystem::path> recordings_in(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator{folder, error}) {
    std::filesystem::path path = entry.path();
    if (path.extension() == ".part") path.replace_extension();
    if (path.extension() == ".mcap") found.insert(path);
  }
  return found;
}

Result<void> join_recordings(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out) {
  auto writer = McapWriter::create(out);
  if (!writer) return tl::unexpected<Error>(writer.error());
  std::map<std::string, McapWriter::Channel> channels;  // by topic, type and schema
  std::optional<Error> fault;
  bool is_any_good = false;
  for (const auto& file : files) {
    auto reader = McapReader::open(file);
    if (!reader) {
      fault = reader.error();
      continue;
    }
    is_any_good = true;
    Result<void> written;
    const auto read = reader->read({{}, {}, {}, true}, [&](const McapMessage& message) {
      const std::string key = message.channel.topic + ' ' + message.channel.type + '\n' + message.channel.schema;
      auto place = channels.find(key);
      if (place == channels.end()) {
        const auto channel = writer->add_channel(message.channel);
        if (!channel) {
          written = tl::unexpected<Error>(channel.error());
          return false;
        }
        place = channels.emplace(key, *channel).first;
      }
      written = writer->write(place->second, message.log_time, message.publish_time, message.data);
      return written.has_value();
    });
    if (!written) return written;
    if (!read) fault = read.error();  // what lay before the damage is in
  }
  if (!is_any_good) return tl::unexpected<Error>(fault.value_or(Error{out.string() + ": nothing was recorded"}));
  return writer->close();
}

}  // namespace docent::recording
