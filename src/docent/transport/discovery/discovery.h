#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "docent/transport/bus.h"

namespace docent::transport {

/// A program that DDS has found on the domain.
struct Participant {
  std::string id;         ///< 32 hexadecimal digits
  std::string vendor;     ///< of its DDS, by its id: "Cyclone DDS", "Fast DDS", …; "?" where that is not known
  std::string user_data;  ///< ROS 2: "enclave=/;"
};

/// One of its writers or readers.
struct Endpoint {
  bool writes = false;
  std::string participant;   ///< its id
  std::string topic;         ///< on the wire: "rt/scan_front"
  std::string type;          ///< on the wire: "sensor_msgs::msg::dds_::LaserScan_"
  std::string user_data;     ///< ROS 2: "typehash=RIHS01_…;"
  bool is_reliable = false;  ///< offered or asked for
  bool is_latched = false;   ///< transient local, or longer
  bool has_deadline = false;
  bool is_alive_by_hand = false;  ///< liveliness by participant or topic, not automatic
  bool has_partition = false;     ///< ROS 2 has none
};

struct Discovered {
  std::vector<Participant> participants;
  std::vector<Endpoint> endpoints;  ///< in the order of their topics
};

/// Asks Cyclone DDS whom it has found, the asking program itself left out.
/// @param participant  DdsBus::participant()
[[nodiscard]] Discovered discovered(std::int32_t participant);

/// Whether a program that tells its health commands a base: another robot of the same name.
/// @param health  docent/health and @param command  cmd_vel, both on the wire
[[nodiscard]] bool has_robot(const Discovered& heard, const std::string& health, const std::string& command);

/// As ROS 2 writes them: "/scan_front"; "sensor_msgs/msg/LaserScan". What has no such form stays as it is.
[[nodiscard]] std::string ros_topic(std::string_view wire);
[[nodiscard]] std::string ros_type(std::string_view wire);

/// Why Docent's own end of `topic` and this other end do not come together; empty: they do. The topics' names are
/// alike.
/// @param type  on the wire, of Docent's end
[[nodiscard]] std::string mismatch(const TopicInfo& topic, std::string_view type, const Endpoint& other);

}  // namespace docent::transport
