#pragma once

#include <memory>
#include <string>

#include "docent/transport/bus.h"

struct dds_qos;

namespace docent::transport {

/// What of a quality of service decides whether a reader matches a writer, and how much is kept for one that is late.
struct WireQos {
  bool is_reliable = true;
  bool is_latched = false;  ///< transient local
  int depth = 1;            ///< samples
  Duration lease{};         ///< of automatic liveliness; 0: for ever
  friend bool operator==(const WireQos&, const WireQos&) = default;
};

/// What Docent's writers offer, on the wire and in a recording.
[[nodiscard]] WireQos offered_qos(const TopicInfo& topic);
/// What its readers ask for.
[[nodiscard]] WireQos requested_qos(const TopicInfo& topic);

struct DeleteQos {
  void operator()(dds_qos* qos) const;
};
using DdsQos = std::unique_ptr<dds_qos, DeleteQos>;
/// The same for DDS, with the type's hash in USER_DATA. @param type  on the wire
[[nodiscard]] DdsQos dds_writer_qos(const TopicInfo& topic, const std::string& type);
[[nodiscard]] DdsQos dds_reader_qos(const TopicInfo& topic, const std::string& type);
/// Of a reader that nobody listens to: it matches every writer of the topic.
[[nodiscard]] DdsQos dds_probe_qos(const TopicInfo& topic, const std::string& type);

/// The name of a policy of DDS, for a person.
[[nodiscard]] const char* policy_name(std::uint32_t policy);

}  // namespace docent::transport
