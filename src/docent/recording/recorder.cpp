#include "docent/recording/recorder.h"

#include "docent/base/check.h"
#include "docent/messages/schema.h"
#include "docent/recording/older_layout.h"
#include "docent/transport/type_hash.h"
#include "docent/transport/wire_qos.h"

namespace docent::recording {
namespace {

// Numbers of rmw_qos_…_policy_t.
constexpr int kKeepLast = 1;
constexpr int kReliable = 1, kBestEffort = 2;
constexpr int kTransientLocal = 1, kVolatile = 2;
constexpr int kAutomatic = 1;

std::string lines(const char* key, int number) {
  return std::string{"  "} + key + ": " + std::to_string(number) + "\n";
}

std::string lines(const char* key, std::int64_t seconds, std::int64_t nanoseconds) {
  return std::string{"  "} + key + ":\n    sec: " + std::to_string(seconds) +
         "\n    nsec: " + std::to_string(nanoseconds) + "\n";
}

std::string lines(const char* key, Duration duration) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  if (duration.count() == 0) return lines(key, 9223372036, 854775807);  // RMW_DURATION_INFINITE
  return lines(key, duration.count() / kSecond, duration.count() % kSecond);
}

/// What rosbag2 keeps of a topic beside its type: with which quality of service it was offered, so that `ros2 bag play`
/// offers the same. Docent's is that of the wire; of a driver's topic nobody notes the driver's own, and what is
/// offered here matches every reader that the driver's did. As YAML, with the policies as numbers, which rosbag2 of
/// Humble and of Jazzy reads.
std::string offered_qos_profiles(const transport::TopicInfo& topic) {
  const transport::WireQos qos = transport::offered_qos(topic);
  return "- history: " + std::to_string(kKeepLast) + "\n" + lines("depth", qos.depth) +
         lines("reliability", qos.is_reliable ? kReliable : kBestEffort) +
         lines("durability", qos.is_latched ? kTransientLocal : kVolatile) + lines("deadline", Duration{0}) +
         lines("lifespan", Duration{0}) + lines("liveliness", kAutomatic) +
         lines("liveliness_lease_duration", qos.lease) + "  avoid_ros_namespace_conventions: false\n";
}

std::map<std::string, RecordedTopic, std::less<>> all_topics() {
  std::map<std::string, RecordedTopic, std::less<>> topics;
  const auto add = [&topics]<class T>(const Topic<T>& topic) {
    topics[topic.name] = {transport::topic_info(topic), ros2msg_text(message_schemas<T>())};
  };
  for_each_robot_topic(add);
  for_each_truth_topic(add);
  return topics;
}

/// A topic that had another type once. Only people looked at it, so that no reader of recordings misses it.
bool is_of_older_type(const McapChannel& channel) {
  return channel.topic == "/particle_cloud" && channel.type == geometry_msgs::PoseArray::kType;
}

/// Docent's own messages of a recording, by the schemas that it embeds.
class MessageDecoder {
 public:
  /// nullptr: damaged.
  std::shared_ptr<const void> decode(const McapMessage& message, const RecordedTopic& topic) {
    const auto& channel = message.channel;
    if (channel.schema == topic.schema || !channel.type.starts_with("docent_msgs/"))
      return topic.info.type->decode(message.data);
    const auto [place, is_new] = layouts_.try_emplace(channel.topic + "\n" + channel.schema);
    if (is_new) place->second = OlderLayout::between(channel.schema, topic.schema);
    if (!place->second) return topic.info.type->decode(message.data);
    const auto bytes = place->second->translated(message.data);
    return bytes ? topic.info.type->decode(*bytes) : nullptr;
  }

 private:
  std::map<std::string, std::optional<OlderLayout>> layouts_;  ///< by topic and schema; nullopt: ours
};

void subscribe(transport::Bus& bus, const transport::TopicInfo& info, const TopicHandler& handler) {
  bus.add_subscription(info, [info, handler](const std::shared_ptr<const void>& message) { handler(info, message); });
}

}  // namespace

void subscribe_robot_topics(transport::Bus& bus, const TopicHandler& handler, const TopicFilter& is_wanted) {
  for_each_robot_topic([&](const auto& topic) {
    const auto info = transport::topic_info(topic);
    if (!is_wanted || is_wanted(info)) subscribe(bus, info, handler);
  });
}

void subscribe_truth_topics(transport::Bus& truth, const TopicHandler& handler) {
  for_each_truth_topic([&](const auto& topic) { subscribe(truth, transport::topic_info(topic), handler); });
}

const RecordedTopic* find_recorded_topic(std::string_view name) {
  static const auto kTopics = all_topics();
  if (name.starts_with('/')) name.remove_prefix(1);
  const auto found = kTopics.find(name);
  return found == kTopics.end() ? nullptr : &found->second;
}

Result<Recorder> Recorder::create(const std::filesystem::path& path, const McapWriterOptions& options) {
  auto writer = McapWriter::create(path, options);
  if (!writer) return tl::unexpected<Error>(writer.error());
  return Recorder{std::move(*writer)};
}

Result<void> Recorder::write(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  auto place = channels_.find(std::string_view{topic.name});
  if (place == channels_.end()) {
    const RecordedTopic* known = find_recorded_topic(topic.name);
    DOCENT_CHECK(known != nullptr);
    auto channel = writer_.add_channel({std::string{"/"} + topic.name,
                                        topic.type->name,
                                        "ros2msg",
                                        known->schema,
                                        "cdr",
                                        {{"offered_qos_profiles", offered_qos_profiles(topic)},
                                         {"topic_type_hash", transport::type_hash_of(topic.type->name)}}});
    if (!channel) return tl::unexpected<Error>(channel.error());
    place = channels_.emplace(topic.name, *channel).first;
  }
  return writer_.write(place->second, time, time, topic.type->encode(message.get()));
}

Result<void> read_recording(McapReader& reader, const McapReader::Selection& selection,
                            const std::function<bool(const RecordedMessage&)>& handler) {
  Result<void> decoded;
  MessageDecoder decoder;
  const auto read = reader.read(selection, [&](const McapMessage& message) {
    const RecordedTopic* topic = find_recorded_topic(message.channel.topic);
    if (topic == nullptr) return true;
    const auto at = [&] { return " at " + std::to_string(to_seconds(message.log_time)) + " s"; };
    if (is_of_older_type(message.channel)) return true;
    if (message.channel.type != topic->info.type->name) {
      decoded = fail(message.channel.topic + ": the recording has " + message.channel.type + ", not " +
                     topic->info.type->name);
      return false;
    }
    auto content = decoder.decode(message, *topic);
    if (!content) {
      if (selection.skip_damaged) return true;
      decoded = fail(message.channel.topic + ": damaged " + topic->info.type->name + at());
      return false;
    }
    return handler({topic->info, message.log_time, std::move(content)});
  });
  return decoded ? read : decoded;
}

}  // namespace docent::recording
