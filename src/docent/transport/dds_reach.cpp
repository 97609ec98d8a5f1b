#include "docent/transport/dds_reach.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>
#include <string_view>

#include "docent/transport/dds_bus.h"

namespace docent::transport {
namespace {

// RTPS 9.6.1.1: the port at which participant number i of a domain hears of others.
constexpr int kPortBase = 7400;
constexpr int kPortsOfADomain = 250;
constexpr int kDiscoveryPort = 10;
constexpr int kPortsOfAParticipant = 2;

constexpr const char* kLimit = "end programs that are not needed, or give the robot another domain (--domain). ";

std::string domain_of(const DdsReach& reach) { return "ROS_DOMAIN_ID=" + std::to_string(reach.domain); }

}  // namespace

DdsReach dds_reach(int domain, const std::string& interface) {
  const char* uri = std::getenv("CYCLONEDDS_URI");
  return {domain, interface, uri == nullptr ? "" : uri};
}

std::vector<NetworkInterface> network_interfaces() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all{first, freeifaddrs};
  std::vector<NetworkInterface> found;
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET || (one->ifa_flags & IFF_UP) == 0) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr, text.data(), text.size());
    found.push_back({one->ifa_name, text.data(), (one->ifa_flags & IFF_LOOPBACK) != 0});
  }
  return found;
}

Result<void> check_interface(const std::string& name, const std::vector<NetworkInterface>& there) {
  std::string names;
  for (const auto& one : there) {
    if (one.name == name) return {};
    names += (names.empty() ? "" : ", ") + one.name + " (" + one.address + ")";
  }
  return fail("no network interface '" + name + "' with an IPv4 address is up; there are " +
              (names.empty() ? "none" : names));
}

Result<void> check_uri(const std::string& uri) {
  constexpr std::string_view kScheme = "file://";
  for (std::size_t at = 0; (at = uri.find_first_not_of(", \t\n", at)) != std::string::npos;) {
    if (uri[at] == '<') return {};  // XML goes on to the end
    const std::size_t end = std::min(uri.find(',', at), uri.size());
    std::string file = uri.substr(at, end - at);
    at = end;
    if (file.find('$') != std::string::npos) continue;  // which Cyclone DDS puts variables into
    if (file.starts_with(kScheme)) file.erase(0, kScheme.size());
    std::error_code code;
    const bool is_folder = std::filesystem::is_directory(file, code);
    if (is_folder || !std::ifstream{file})
      return fail("CYCLONEDDS_URI names the file " + file +
                  ", which cannot be read: " + (is_folder ? "it is a folder" : std::strerror(errno)));
  }
  return {};
}

// Thirteen modules, the simulator and tools need more than the nine participants that the default finds room for; a map
// must fit into the writer's history while a reader is stopped. A process that was stopped for less than a minute is
// still known when it goes on, and new ones are found within a second. Liveliness tells that a process died, not the
// lease.
std::string dds_configuration(const std::string& interface) {
  const bool is_loopback = interface == kLoopback;
  std::string interfaces = R"(<NetworkInterface name="lo"/>)";
  // By multicast on both, for that is how ROS 2 looks for others by itself.
  if (!is_loopback)
    interfaces = R"(<NetworkInterface name="lo" multicast="true"/><NetworkInterface name=")" + interface + R"("/>)";
  return "<CycloneDDS><Domain Id=\"any\">\n<General><Interfaces>" + interfaces + "</Interfaces>" +
         (is_loopback ? "<AllowMulticast>false</AllowMulticast>" : "") +
         R"(</General>
<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>)" +
         std::to_string(kMostParticipants - 1) +
         R"(</MaxAutoParticipantIndex>
<Peers><Peer Address="127.0.0.1"/></Peers>
<SPDPInterval>1s</SPDPInterval><LeaseDuration>60s</LeaseDuration></Discovery>
<Internal><Watermarks><WhcHigh>32 MB</WhcHigh></Watermarks></Internal>
</Domain></CycloneDDS>
)";
}

std::string in_words(const DdsReach& reach) {
  const std::string domain = "domain " + std::to_string(reach.domain) + ", ";
  if (!reach.uri.empty()) return domain + "as CYCLONEDDS_URI says (" + reach.uri + "): --interface is not asked";
  if (reach.interface == kLoopback)
    return domain + "this computer only (--interface lo, the default); a network card is heard with --interface NAME";
  return domain + "this computer and what is reached through " + reach.interface + " (--interface)";
}

std::vector<std::string> environment_notes(const DdsReach& reach,
                                           const std::function<const char*(const char*)>& value_of) {
  std::vector<std::string> notes;
  const auto of = [&](const char* name) {
    const char* value = value_of(name);
    return std::string{value == nullptr ? "" : value};
  };
  if (const std::string domain = of("ROS_DOMAIN_ID"); !domain.empty() && domain != std::to_string(reach.domain))
    notes.push_back("ROS_DOMAIN_ID is " + domain + " here, and this is domain " + std::to_string(reach.domain) +
                    ": --domain " + domain + " joins the other");
  if (const std::string speaks = of("RMW_IMPLEMENTATION"); speaks.find("zenoh") != std::string::npos)
    notes.push_back("RMW_IMPLEMENTATION is " + speaks + ", which speaks no DDS: its programs are not heard");
  if (!of("ROS_DISCOVERY_SERVER").empty())
    notes.emplace_back("ROS_DISCOVERY_SERVER is set: programs that ask a discovery server are not heard without it");
  return notes;
}

std::vector<RosLine> ros_lines(const DdsReach& reach, const std::string& shipped) {
  const std::string range = " ROS_AUTOMATIC_DISCOVERY_RANGE=";
  const std::string cyclone = "export " + domain_of(reach) + " RMW_IMPLEMENTATION=rmw_cyclonedds_cpp CYCLONEDDS_URI=";
  if (!reach.uri.empty()) return {{"rmw_cyclonedds_cpp", cyclone + "'" + reach.uri + "'" + range + "SYSTEM_DEFAULT"}};
  if (reach.interface != kLoopback)
    return {{"any", "export " + domain_of(reach) + " ROS_LOCALHOST_ONLY=0" + range + "SUBNET"}};
  const std::string fast = shipped + "/fastdds.xml";
  return {{"rmw_cyclonedds_cpp", cyclone + "file://" + shipped + "/loopback.xml" + range + "SYSTEM_DEFAULT"},
          {"rmw_fastrtps_cpp", "export " + domain_of(reach) + " RMW_IMPLEMENTATION=rmw_fastrtps_cpp" +
                                   " FASTRTPS_DEFAULT_PROFILES_FILE=" + fast +
                                   " FASTDDS_DEFAULT_PROFILES_FILE=" + fast + range + "SYSTEM_DEFAULT"}};
}

int participants_here(int domain, const std::string& udp_table) {
  const int first = kPortBase + kPortsOfADomain * domain + kDiscoveryPort;
  std::set<int> taken;
  std::istringstream lines{udp_table};
  for (std::string line; std::getline(lines, line);) {
    // "  12: 0100007F:1CF2 00000000:0000 07 …"
    std::istringstream words{line};
    std::string number, local;
    if (!(words >> number >> local)) continue;
    const auto colon = local.find(':');
    if (colon == std::string::npos) continue;
    const int port = static_cast<int>(std::strtol(local.c_str() + colon + 1, nullptr, 16));
    const int offset = port - first;
    if (offset >= 0 && offset % kPortsOfAParticipant == 0 && offset / kPortsOfAParticipant < kMostParticipants)
      taken.insert(port);
  }
  return static_cast<int>(taken.size());
}

std::string cannot_join(const DdsReach& reach, const std::string& why, int here) {
  const std::string text = "DDS cannot join domain " + std::to_string(reach.domain) + ": " + why;
  if (!reach.uri.empty())
    return text + ". CYCLONEDDS_URI is set (" + reach.uri + "), and " + std::to_string(here) +
           " programs of this computer are in the domain: where its file names no Discovery/MaxAutoParticipantIndex, "
           "Cyclone DDS has room for ten; Docent's own file has " +
           std::to_string(kMostParticipants - 1) + " there. Or " + kLimit + "Or the interface that it names is not up.";
  if (here >= kMostParticipants)
    return text + ". All " + std::to_string(kMostParticipants) +
           " places that one computer has in a domain are taken: " + kLimit + "`ss -ulnp` names the programs.";
  return text + " (" + std::to_string(here) + " of " + std::to_string(kMostParticipants) +
         " places of this computer in the domain are taken, interface " + reach.interface + ")";
}

}  // namespace docent::transport
