#include "docent/transport/discovery/discovery.h"

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <memory>
#include <set>

namespace docent::transport {
namespace {

/// RTPS: the first two bytes of an id are the vendor's; the list is OMG's.
const char* vendor_of(const dds_guid_t& id) {
  if (id.v[0] != 1) return "?";
  switch (id.v[1]) {
    case 0x01:
      return "RTI Connext";
    case 0x02:
      return "OpenSplice";
    case 0x03:
      return "OpenDDS";
    case 0x0f:
      return "Fast DDS";
    case 0x10:
      return "Cyclone DDS";
    case 0x11:
      return "GurumDDS";
    case 0x12:
      return "RustDDS";
    default:
      return "?";
  }
}

std::string text_of(const dds_guid_t& id) {
  std::string text;
  std::array<char, 3> digits{};
  for (const auto byte : id.v) {
    std::snprintf(digits.data(), digits.size(), "%02x", byte);
    text += digits.data();
  }
  return text;
}

std::string user_data_of(const dds_qos_t* qos) {
  void* bytes = nullptr;
  std::size_t size = 0;
  if (qos == nullptr || !dds_qget_userdata(qos, &bytes, &size) || bytes == nullptr) return {};
  std::string text{static_cast<const char*>(bytes), size};
  dds_free(bytes);
  return text;
}

bool has_partition(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  char** names = nullptr;
  if (!dds_qget_partition(qos, &count, &names)) return false;
  bool found = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    found = found || *names[i] != '\0';
    dds_free(names[i]);
  }
  dds_free(names);
  return found;
}

/// Calls `see` for each living instance of one of DDS's own topics.
template <class Sample>
void for_each_alive(dds_entity_t participant, dds_entity_t topic, const std::function<void(const Sample&)>& see) {
  constexpr std::uint32_t kMost = 4096;
  const dds_entity_t reader = dds_create_reader(participant, topic, nullptr, nullptr);
  if (reader < 0) return;
  std::vector<void*> samples(kMost, nullptr);
  std::vector<dds_sample_info_t> infos(kMost);
  const dds_return_t count = dds_read_mask(reader, samples.data(), infos.data(), kMost, kMost,
                                           DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
  for (dds_return_t i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (infos[k].valid_data) see(*static_cast<const Sample*>(samples[k]));
  }
  if (count > 0) dds_return_loan(reader, samples.data(), count);
  dds_delete(reader);
}

Endpoint endpoint_of(const dds_builtintopic_endpoint_t& seen, bool writes) {
  Endpoint endpoint;
  endpoint.writes = writes;
  endpoint.participant = text_of(seen.participant_key);
  endpoint.topic = seen.topic_name;
  endpoint.type = seen.type_name;
  if (seen.qos == nullptr) return endpoint;
  endpoint.user_data = user_data_of(seen.qos);
  dds_reliability_kind_t reliability{};
  dds_duration_t duration = 0;
  endpoint.is_reliable =
      dds_qget_reliability(seen.qos, &reliability, &duration) && reliability == DDS_RELIABILITY_RELIABLE;
  dds_durability_kind_t durability{};
  endpoint.is_latched = dds_qget_durability(seen.qos, &durability) && durability >= DDS_DURABILITY_TRANSIENT_LOCAL;
  endpoint.has_deadline = dds_qget_deadline(seen.qos, &duration) && duration != DDS_INFINITY;
  dds_liveliness_kind_t liveliness{};
  endpoint.is_alive_by_hand =
      dds_qget_liveliness(seen.qos, &liveliness, &duration) && liveliness != DDS_LIVELINESS_AUTOMATIC;
  endpoint.has_partition = has_partition(seen.qos);
  return endpoint;
}

}  // namespace

Discovered discovered(std::int32_t participant) {
  Discovered all;
  dds_guid_t own{};
  if (dds_get_guid(participant, &own) != DDS_RETCODE_OK) return all;
  const std::string self = text_of(own);
  for_each_alive<dds_builtintopic_participant_t>(
      participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, [&](const dds_builtintopic_participant_t& seen) {
        if (const std::string id = text_of(seen.key); id != self)
          all.participants.push_back({id, vendor_of(seen.key), user_data_of(seen.qos)});
      });
  for (const bool writes : {true, false})
    for_each_alive<dds_builtintopic_endpoint_t>(
        participant, writes ? DDS_BUILTIN_TOPIC_DCPSPUBLICATION : DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION,
        [&](const dds_builtintopic_endpoint_t& seen) {
          if (Endpoint endpoint = endpoint_of(seen, writes); endpoint.participant != self)
            all.endpoints.push_back(std::move(endpoint));
        });
  std::stable_sort(all.endpoints.begin(), all.endpoints.end(), [](const Endpoint& a, const Endpoint& b) {
    return std::pair{a.topic, a.participant} < std::pair{b.topic, b.participant};
  });
  return all;
}

bool has_robot(const Discovered& heard, const std::string& health, const std::string& command) {
  std::set<std::string> healthy;
  for (const Endpoint& one : heard.endpoints)
    if (one.writes && one.topic == health) healthy.insert(one.participant);
  return std::any_of(heard.endpoints.begin(), heard.endpoints.end(), [&](const Endpoint& one) {
    return one.writes && one.topic == command && healthy.contains(one.participant);
  });
}

std::string ros_topic(std::string_view wire) { return std::string{wire.starts_with("rt/") ? wire.substr(2) : wire}; }

std::string ros_type(std::string_view wire) {
  constexpr std::string_view kFolder = "::dds_::";
  std::string text{wire};
  const auto at = text.find(kFolder);
  if (at == std::string::npos || !text.ends_with('_')) return text;
  text.pop_back();
  text.replace(at, kFolder.size(), "::");
  for (auto colons = text.find("::"); colons != std::string::npos; colons = text.find("::"))
    text.replace(colons, 2, "/");
  return text;
}

std::string mismatch(const TopicInfo& topic, std::string_view type, const Endpoint& other) {
  if (other.type != type) return "its type is " + ros_type(other.type) + ", not " + ros_type(type);
  if (other.has_partition) return "it is in a partition, which ROS 2 does not have";
  if (other.writes) {  // Docent asks
    if (topic.qos != Qos::sensor && !other.is_reliable) return "it is offered best effort, and asked for reliable";
    if (topic.qos == Qos::state && !other.is_latched) return "it is offered volatile, and asked for transient local";
    return {};
  }
  if (topic.qos != Qos::state && other.is_latched) return "it is offered volatile, and asked for transient local";
  if (other.has_deadline) return "a deadline is asked for, and none is offered";
  if (other.is_alive_by_hand) return "liveliness by hand is asked for, and automatic liveliness is offered";
  return {};
}

}  // namespace docent::transport
