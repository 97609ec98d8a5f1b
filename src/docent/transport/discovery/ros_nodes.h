#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::transport {

/// A node of ROS 2, as its program says on ros_discovery_info.
struct RosNode {
  std::string participant;  ///< id of its program, as Participant has it
  std::string name;         ///< "/minerva/docent_avoid"
  std::size_t readers = 0;  ///< that the program says are this node's
  std::size_t writers = 0;  ///< likewise
};

/// The nodes of one program. Names on DDS have 16 bytes there from ROS 2 Iron on, and 24 in Humble and before: both are
/// read. Error: neither fits.
/// @param bytes  a message on ros_discovery_info, CDR
[[nodiscard]] Result<std::vector<RosNode>> ros_nodes_of(std::span<const std::uint8_t> bytes);

/// Listens to ros_discovery_info, from its making on.
class RosNodeListener {
 public:
  /// @param participant  DdsBus::participant(); it owns what is made here
  explicit RosNodeListener(std::int32_t participant);

  /// All that other programs have said so far, in the order of their names.
  [[nodiscard]] std::vector<RosNode> heard();

 private:
  std::int32_t reader_ = 0;
  std::string self_;                                   ///< id of the program that listens
  std::map<std::string, std::vector<RosNode>> nodes_;  ///< by program, its last word
};

}  // namespace docent::transport
