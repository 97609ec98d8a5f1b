#include "docent/transport/discovery/ros_nodes.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "docent/messages/cdr.h"
#include "docent/transport/cdr_sertype.h"
#include "docent/transport/ros_graph.h"

namespace docent::transport {
namespace {

/// ParticipantEntitiesInfo with names on DDS of `Size` bytes.
template <std::size_t Size>
struct GraphMessage {
  static constexpr const char* kType = ParticipantEntitiesInfo::kType;
  struct Name {
    static constexpr const char* kType = Gid::kType;
    std::array<std::uint8_t, Size> data{};
    template <class Self, class V>
    static void visit(Self& m, V& v) {
      v("data", m.data);
    }
  };
  struct Node {
    static constexpr const char* kType = NodeEntitiesInfo::kType;
    std::string node_namespace, node_name;
    std::vector<Name> readers, writers;
    template <class Self, class V>
    static void visit(Self& m, V& v) {
      v("node_namespace", m.node_namespace);
      v("node_name", m.node_name);
      v("reader_gid_seq", m.readers);
      v("writer_gid_seq", m.writers);
    }
  };
  Name gid;
  std::vector<Node> nodes;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("gid", m.gid);
    v("node_entities_info_seq", m.nodes);
  }
};

/// A DDS name is its first 16 bytes, in either form.
std::string id_of(std::span<const std::uint8_t> name) {
  std::string text;
  std::array<char, 3> digits{};
  for (const auto byte : name.first(sizeof(dds_guid_t))) {
    std::snprintf(digits.data(), digits.size(), "%02x", byte);
    text += digits.data();
  }
  return text;
}

/// Error where the message is not of this form: it ends early, or goes on behind the end but for padding to four bytes.
template <std::size_t Size>
Result<std::vector<RosNode>> nodes_in_form(std::span<const std::uint8_t> bytes) {
  const auto message = decode_cdr<GraphMessage<Size>>(bytes);
  if (!message) return tl::unexpected<Error>(message.error());
  if (bytes.size() - encode_cdr(*message).size() >= 4) return fail("longer than it should be");
  std::vector<RosNode> nodes;
  for (const auto& node : message->nodes)
    nodes.push_back({id_of(message->gid.data),
                     node.node_namespace + (node.node_namespace.ends_with('/') ? "" : "/") + node.node_name,
                     node.readers.size(), node.writers.size()});
  return nodes;
}

}  // namespace

Result<std::vector<RosNode>> ros_nodes_of(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kSinceIron = 16, kHumble = 24;  // [bytes]
  auto nodes = nodes_in_form<kSinceIron>(bytes);
  return nodes ? nodes : nodes_in_form<kHumble>(bytes);
}

RosNodeListener::RosNodeListener(std::int32_t participant) {
  dds_guid_t own{};
  if (dds_get_guid(participant, &own) == DDS_RETCODE_OK) self_ = id_of(own.v);
  ddsi_sertype* type = make_cdr_sertype(dds_type_name(ParticipantEntitiesInfo::kType));
  const dds_entity_t topic = dds_create_topic_sertype(participant, kRosDiscovery, &type, nullptr, nullptr, nullptr);
  if (topic < 0) return;
  const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos{dds_create_qos(), dds_delete_qos};
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_INFINITY);
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 0);
  reader_ = dds_create_reader(participant, topic, qos.get(), nullptr);
}

std::vector<RosNode> RosNodeListener::heard() {
  std::array<ddsi_serdata*, 64> samples{};
  std::array<dds_sample_info_t, 64> infos{};
  int count = 0;
  while (reader_ > 0 &&
         (count = dds_takecdr(reader_, samples.data(), samples.size(), infos.data(), DDS_ANY_STATE)) > 0) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const auto nodes = infos[i].valid_data ? ros_nodes_of(cdr_bytes(samples[i])) : std::vector<RosNode>{};
      if (nodes && !nodes->empty()) nodes_[nodes->front().participant] = *nodes;
      ddsi_serdata_unref(samples[i]);
    }
  }
  std::vector<RosNode> all;
  for (const auto& [participant, nodes] : nodes_)
    if (participant != self_) all.insert(all.end(), nodes.begin(), nodes.end());
  std::sort(all.begin(), all.end(), [](const RosNode& a, const RosNode& b) { return a.name < b.name; });
  return all;
}

}  // namespace docent::transport
