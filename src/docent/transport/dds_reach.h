#pragma once

#include <functional>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::transport {

/// How far a program of Docent reaches over DDS, and by whose word.
struct DdsReach {
  int domain = 0;
  std::string interface;  ///< what Docent itself asks Cyclone DDS for (DdsOptions)
  std::string uri;        ///< CYCLONEDDS_URI, which rules alone where it is set; empty: it is not
};
/// Of this process.
[[nodiscard]] DdsReach dds_reach(int domain, const std::string& interface);

/// A network interface of this computer that is up.
struct NetworkInterface {
  std::string name;
  std::string address;  ///< IPv4
  bool is_loopback = false;
};
[[nodiscard]] std::vector<NetworkInterface> network_interfaces();
/// Error: this computer has none of that name that is up; names those that it has.
[[nodiscard]] Result<void> check_interface(const std::string& name, const std::vector<NetworkInterface>& there);

/// Error: CYCLONEDDS_URI names a file that cannot be read; says which. Several may be parted by commas; XML may stand
/// there itself.
[[nodiscard]] Result<void> check_uri(const std::string& uri);

/// What Docent asks Cyclone DDS for. Another interface than loopback comes beside it, so that a robot whose network
/// fails goes on talking to itself.
[[nodiscard]] std::string dds_configuration(const std::string& interface);

/// One line for a person: what holds, and why.
[[nodiscard]] std::string in_words(const DdsReach& reach);

/// What the environment says to ROS 2's programs and Docent does not go by, for a person.
/// @param value_of  of a variable; null: it is not set
[[nodiscard]] std::vector<std::string> environment_notes(const DdsReach& reach,
                                                         const std::function<const char*(const char*)>& value_of);

/// What the processes of ROS 2 must be told, so that both sides hear each other: one line for a shell.
struct RosLine {
  std::string implementation;  ///< rmw_cyclonedds_cpp, rmw_fastrtps_cpp, or "any"
  std::string line;            ///< export …
};
/// @param shipped  the folder with loopback.xml and fastdds.xml
[[nodiscard]] std::vector<RosLine> ros_lines(const DdsReach& reach, const std::string& shipped);

/// How many programs of one computer may join a domain under Docent's own setting.
inline constexpr int kMostParticipants = 121;
/// Those that have joined it here, by the ports that they hold (RTPS 9.6.1.1).
/// @param udp_table  what /proc/net/udp says
[[nodiscard]] int participants_here(int domain, const std::string& udp_table);
/// Why a domain could not be joined, and the cure. @param why  what DDS says
[[nodiscard]] std::string cannot_join(const DdsReach& reach, const std::string& why, int here);

}  // namespace docent::transport
