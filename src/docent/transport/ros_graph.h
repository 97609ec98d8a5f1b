#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "docent/messages/schema.h"

struct ddsi_sertype;

// How programs of ROS 2 tell one another which node has which readers and writers (package rmw_dds_common): DDS itself
// knows no nodes. `ros2 node list` and `node info` come of it.

namespace docent::transport {

/// A participant's or an endpoint's name on DDS, as it is from ROS 2 Iron on; before, it had 24 bytes.
struct Gid {
  static constexpr const char* kType = "rmw_dds_common/msg/Gid";
  std::array<std::uint8_t, 16> data{};  ///< twelve bytes of the participant, then four of the endpoint
  friend bool operator==(const Gid&, const Gid&) = default;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("data", m.data);
  }
};

/// A node and what it reads and writes.
struct NodeEntitiesInfo {
  static constexpr const char* kType = "rmw_dds_common/msg/NodeEntitiesInfo";
  std::string node_namespace;  ///< begins with a slash
  std::string node_name;       ///< letters, digits and underscores
  std::vector<Gid> reader_gid_seq;
  std::vector<Gid> writer_gid_seq;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("node_namespace", m.node_namespace);
    v("node_name", m.node_name);
    v("reader_gid_seq", m.reader_gid_seq);
    v("writer_gid_seq", m.writer_gid_seq);
  }
};

/// All nodes of one participant, whole each time.
struct ParticipantEntitiesInfo {
  static constexpr const char* kType = "rmw_dds_common/msg/ParticipantEntitiesInfo";
  Gid gid;
  std::vector<NodeEntitiesInfo> node_entities_info_seq;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("gid", m.gid);
    v("node_entities_info_seq", m.node_entities_info_seq);
  }
};

}  // namespace docent::transport

namespace docent::transport {

/// Of ParticipantEntitiesInfo, with the bounds of its strings, which `visit` does not tell.
[[nodiscard]] MessageSchemas schemas_of_participant_entities();

/// The topic as it is called on DDS; it has no prefix.
inline constexpr const char* kRosDiscovery = "ros_discovery_info";

/// What a node may be called in ROS 2, of any text: other letters become underscores.
[[nodiscard]] std::string node_name_of(const std::string& text);

/// Says on `ros_discovery_info` that one participant is one node with these readers and writers.
class RosGraph {
 public:
  /// @param participant  of DDS; it owns what is made here
  /// @param prefix       of the robot's topics, "" or "minerva": the node's name space
  RosGraph(std::int32_t participant, const std::string& prefix, const std::string& node);

  /// Of DDS; the next `publish` names it.
  void add_reader(std::int32_t reader);
  /// One that is about to be deleted.
  void remove_reader(std::int32_t reader);
  /// Likewise.
  void add_writer(std::int32_t writer);
  /// Whether there is anything new since the last `publish`.
  [[nodiscard]] bool is_new() const { return is_new_; }
  void publish();

 private:
  std::int32_t writer_ = 0;
  const ddsi_sertype* type_ = nullptr;
  ParticipantEntitiesInfo info_;
  bool is_new_ = true;
};

}  // namespace docent::transport
