#include "docent/recording/mcap/recovery.h"

#include <map>

#include "docent/base/destination.h"
#include "docent/recording/mcap/reader.h"
#include "docent/recording/mcap/writer.h"

namespace docent::recording {

Result<RecoveryReport> recover_mcap(const std::filesystem::path& path, const std::filesystem::path& out) {
  const auto to = destination_of(out);
  if (!to) return tl::unexpected<Error>(to.error());
  // Not beside `out` under the writer's usual name: that may be the very file that is read.
  const std::filesystem::path beside = to->is_stream ? out : std::filesystem::path{to->path.string() + ".recovering"};
  RecoveryReport report;
  {
    auto reader = McapReader::open(path);
    if (!reader) return tl::unexpected<Error>(reader.error());
    auto writer = McapWriter::create(beside);
    if (!writer) return tl::unexpected<Error>(writer.error());
    std::map<const McapChannel*, McapWriter::Channel> channels;
    Result<void> written;
    const auto copy = [&](const McapMessage& message) {
      auto place = channels.find(&message.channel);
      if (place == channels.end()) {
        const auto channel = writer->add_channel(message.channel);
        if (!channel) {
          written = tl::unexpected<Error>(channel.error());
          return false;
        }
        place = channels.emplace(&message.channel, *channel).first;
      }
      written = writer->write(place->second, message.log_time, message.publish_time, message.data);
      ++report.messages;
      return written.has_value();
    };
    McapReader::Selection everything;
    everything.skip_damaged = true;
    if (auto read = reader->read(everything, copy); !read) return tl::unexpected<Error>(read.error());
    if (!written) return tl::unexpected<Error>(written.error());
    if (!reader->is_complete()) report.damage.emplace_back("the file has no end: its last second may be lost");
    report.damage.insert(report.damage.end(), reader->damage().begin(), reader->damage().end());
    if (auto closed = writer->close(); !closed) return tl::unexpected<Error>(closed.error());
  }
  if (to->is_stream) return report;
  std::error_code error;
  std::filesystem::rename(beside, to->path, error);
  if (error) return fail(out.string() + ": cannot be named: " + error.message());
  std::filesystem::remove(unfinished_path(out), error);
  return report;
}

}  // namespace docent::recording
