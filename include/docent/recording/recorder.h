#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "docent/recording/mcap/reader.h"
#include "docent/recording/mcap/writer.h"
#include "docent/transport/bus.h"

namespace docent::recording {

/// A topic of Docent as a recording knows it.
struct RecordedTopic {
  transport::TopicInfo info;  ///< as the bus knows it
  std::string schema;         ///< text of the type, encoding ros2msg
};
/// By the bus's name ("scan_front") or the recording's ("/scan_front"); nullptr for a topic that Docent does not have.
[[nodiscard]] const RecordedTopic* find_recorded_topic(std::string_view name);

/// Gets each message.
using TopicHandler = std::function<void(const transport::TopicInfo& topic, const std::shared_ptr<const void>& message)>;
/// Whether a topic is to be subscribed to.
using TopicFilter = std::function<bool(const transport::TopicInfo& topic)>;
/// Subscribes to every topic of the robot, or to those that `is_wanted` names; or to those of the truth, which live on
/// a bus of their own.
void subscribe_robot_topics(transport::Bus& bus, const TopicHandler& handler, const TopicFilter& is_wanted = {});
/// Likewise.
void subscribe_truth_topics(transport::Bus& truth, const TopicHandler& handler);

/// Writes messages of the bus to an MCAP file, for `docent simulate --record` and the record module.
class Recorder {
 public:
  /// Error: the file cannot be written.
  [[nodiscard]] static Result<Recorder> create(const std::filesystem::path& path,
                                               const McapWriterOptions& options = {});

  /// @pre the topic is one of Docent's. Error: the disk is full or gone.
  [[nodiscard]] Result<void> write(const transport::TopicInfo& topic, Time time,
                                   const std::shared_ptr<const void>& message);
  [[nodiscard]] Result<void> flush() { return writer_.flush(); }               ///< what was written is in the file
  [[nodiscard]] Result<void> close() { return writer_.close(); }               ///< the file is whole
  [[nodiscard]] std::uint64_t messages() const { return writer_.messages(); }  ///< written so far
  [[nodiscard]] std::uint64_t bytes_written() const { return writer_.bytes_written(); }  ///< so far

 private:
  explicit Recorder(McapWriter writer) : writer_{std::move(writer)} {}
  McapWriter writer_;
  std::map<std::string, McapWriter::Channel, std::less<>> channels_;
};

/// A message of a recording that is one of Docent's, decoded.
struct RecordedMessage {
  const transport::TopicInfo& topic;    ///< of Docent
  Time time;                            ///< when it was recorded
  std::shared_ptr<const void> message;  ///< of the topic's type
  /// Of the topic of this name.
  [[nodiscard]] bool is(const char* name) const { return std::string_view{topic.name} == name; }
  /// The message of this topic; null: of another.
  template <class T>
  [[nodiscard]] const T* as(const Topic<T>& wanted) const {
    return is(wanted.name) ? static_cast<const T*>(message.get()) : nullptr;
  }
};

/// Hands over Docent's messages of a recording in the order of their times until `handler` returns false. Channels that
/// Docent does not know are passed over. Error: damage, a message that does not decode, or a known topic of another
/// type.
[[nodiscard]] Result<void> read_recording(McapReader& reader, const McapReader::Selection& selection,
                                          const std::function<bool(const RecordedMessage&)>& handler);

}  // namespace docent::recording
