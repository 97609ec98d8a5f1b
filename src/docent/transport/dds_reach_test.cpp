#include "docent/transport/dds_reach.h"

#include <gtest/gtest.h>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <cstdio>
#include <fstream>
#include <map>

#include <fstream>
#include <iterator>

#include "docent/transport/dds_bus.h"

namespace docent::transport {
namespace {

TEST(DdsReach, TheFileForOthersIsDocentsOwnSetting) {
  std::ifstream file{"share/dds/loopback.xml"};
  const std::string text{std::istreambuf_iterator<char>{file}, {}};
  EXPECT_TRUE(text.ends_with(dds_configuration(kLoopback))) << dds_configuration(kLoopback);
}

TEST(DdsReach, AnInterfaceComesBesideLoopback) {
  const std::string xml = dds_configuration("eth7");
  EXPECT_NE(xml.find(R"(name="lo" multicast="true")"), std::string::npos) << xml;
  EXPECT_NE(xml.find(R"(name="eth7")"), std::string::npos);
  EXPECT_EQ(xml.find("AllowMulticast"), std::string::npos) << "ROS 2 looks for others by multicast";
}

TEST(DdsReach, AnInterfaceThatIsNotThereIsNamedWithThoseThatAre) {
  const std::vector<NetworkInterface> there{{"lo", "127.0.0.1", true}, {"wlan0", "10.0.0.4", false}};
  EXPECT_TRUE(check_interface("wlan0", there));
  const auto fault = check_interface("eth0", there);
  ASSERT_FALSE(fault);
  EXPECT_EQ(fault.error().message,
            "no network interface 'eth0' with an IPv4 address is up; there are lo (127.0.0.1), wlan0 (10.0.0.4)");
  const auto created = DdsBus::create({.domain = 43, .name_prefix = "", .warn = {}, .interface = "no-such"});
  ASSERT_FALSE(created);
  EXPECT_EQ(created.error().message.find("no network interface 'no-such'"), 0U) << created.error().message;
}

TEST(DdsReach, LoopbackIsAmongTheInterfacesOfThisComputer) {
  const auto there = network_interfaces();
  EXPECT_TRUE(check_interface(kLoopback, there));
}

TEST(DdsReach, TheLineForRos2FollowsTheSetting) {
  const auto local = ros_lines({4, kLoopback, ""}, "/share");
  ASSERT_EQ(local.size(), 2U);
  EXPECT_EQ(local[0].line,
            "export ROS_DOMAIN_ID=4 RMW_IMPLEMENTATION=rmw_cyclonedds_cpp CYCLONEDDS_URI=file:///share/loopback.xml "
            "ROS_AUTOMATIC_DISCOVERY_RANGE=SYSTEM_DEFAULT");
  EXPECT_NE(local[1].line.find("FASTRTPS_DEFAULT_PROFILES_FILE=/share/fastdds.xml"), std::string::npos);
  const auto network = ros_lines({4, "eth0", ""}, "/share");
  ASSERT_EQ(network.size(), 1U);
  EXPECT_EQ(network[0].line, "export ROS_DOMAIN_ID=4 ROS_LOCALHOST_ONLY=0 ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET");
  const auto own = ros_lines({4, "eth0", "file:///etc/docent/dds.xml"}, "/share");
  ASSERT_EQ(own.size(), 1U);
  EXPECT_NE(own[0].line.find("CYCLONEDDS_URI='file:///etc/docent/dds.xml'"), std::string::npos);
  EXPECT_NE(in_words({4, "eth0", "file:///etc/docent/dds.xml"}).find("--interface is not asked"), std::string::npos);
}

TEST(DdsReach, PortsTellHowManyProgramsAreInADomain) {
  // Domain 41 begins at 17650: participants 0 and 2 hear of others at 17660 and 17664, by two sockets each.
  const std::string table =
      "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid\n"
      "   1: 0100007F:44FC 00000000:0000 07 0 0\n"   // 17660
      "   2: 0100007F:44FD 00000000:0000 07 0 0\n"   // 17661: of its data
      "   3: 00000000:44FC 00000000:0000 07 0 0\n"   // 17660 again
      "   4: 0100007F:4500 00000000:0000 07 0 0\n"   // 17664
      "   5: 0100007F:45F8 00000000:0000 07 0 0\n";  // 17912: domain 42
  EXPECT_EQ(participants_here(41, table), 2);
  EXPECT_EQ(participants_here(42, table), 1);
  EXPECT_EQ(participants_here(40, table), 0);
  EXPECT_EQ(participants_here(0, ""), 0);
}

TEST(DdsReach, AFullDomainSaysItsLimitAndTheCure) {
  const std::string full = cannot_join({41, kLoopback, ""}, "Error", kMostParticipants);
  EXPECT_EQ(full.find("DDS cannot join domain 41: Error"), 0U);
  EXPECT_NE(full.find("All 121 places"), std::string::npos);
  EXPECT_NE(full.find("--domain"), std::string::npos);
  const std::string other = cannot_join({41, kLoopback, ""}, "Error", 3);
  EXPECT_NE(other.find("3 of 121 places"), std::string::npos);
  const std::string own = cannot_join({41, kLoopback, "file:///x.xml"}, "Error", 10);
  EXPECT_NE(own.find("MaxAutoParticipantIndex"), std::string::npos);
}

TEST(DdsReach, WhoFindsNoPlaceInADomainIsToldSo) {
  constexpr int kFullDomain = 50;  // other tests run at the same time in other domains
  std::vector<int> sockets;
  for (int i = 0; i < kMostParticipants; ++i) {
    sockets.push_back(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * kFullDomain + 10 + 2 * i));
    ASSERT_EQ(bind(sockets.back(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0) << i;
  }
  const auto created = DdsBus::create({kFullDomain, "", {}});
  for (const int one : sockets) close(one);
  ASSERT_FALSE(created);
  EXPECT_EQ(created.error().message.find("DDS cannot join domain 50: Error. All 121 places"), 0U)
      << created.error().message;
  EXPECT_TRUE(DdsBus::create({kFullDomain, "", {}})) << "a place is free again";
}

TEST(DdsReach, WhatTheEnvironmentSaysToOthersIsNoted) {
  std::map<std::string, const char*> set;
  const auto notes = [&](int domain) {
    return environment_notes({domain, "lo", ""}, [&](const char* name) {
      const auto value = set.find(name);
      return value == set.end() ? nullptr : value->second;
    });
  };
  EXPECT_TRUE(notes(0).empty());
  set = {{"ROS_DOMAIN_ID", "42"}, {"RMW_IMPLEMENTATION", "rmw_fastrtps_cpp"}};
  EXPECT_TRUE(notes(42).empty());
  ASSERT_EQ(notes(0).size(), 1U);
  EXPECT_EQ(notes(0)[0], "ROS_DOMAIN_ID is 42 here, and this is domain 0: --domain 42 joins the other");
  set = {{"RMW_IMPLEMENTATION", "rmw_zenoh_cpp"}, {"ROS_DISCOVERY_SERVER", "10.0.0.1:11811"}, {"ROS_DOMAIN_ID", ""}};
  EXPECT_EQ(notes(0).size(), 2U);
}

TEST(DdsReach, AFileThatTheUriNamesAndThatIsNotThereIsNamed) {
  const std::string there = std::string{::testing::TempDir()} + "/docent_dds_uri.xml";
  std::ofstream{there} << "<CycloneDDS/>";
  for (const std::string& good :
       {std::string{}, there, "file://" + there, there + ",<CycloneDDS/>",
        std::string{"<CycloneDDS>, /nowhere</CycloneDDS>"}, std::string{"file://${HOME}/dds.xml"}, ", " + there})
    EXPECT_TRUE(check_uri(good)) << good;
  for (const auto& [bad, named] :
       {std::pair<std::string, std::string>{"file:///nowhere/dds.xml",
                                            "the file /nowhere/dds.xml, which cannot be read: No such file"},
        {there + ",nowhere.xml", "the file nowhere.xml, "},
        {"file://" + std::string{::testing::TempDir()}, "it is a folder"}}) {
    const auto checked = check_uri(bad);
    ASSERT_FALSE(checked) << bad;
    EXPECT_NE(checked.error().message.find(named), std::string::npos) << checked.error().message;
  }
  std::remove(there.c_str());
}

}  // namespace
}  // namespace docent::transport
