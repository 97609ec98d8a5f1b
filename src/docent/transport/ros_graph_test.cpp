#include "docent/transport/ros_graph.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <thread>

#include "docent/messages/cdr.h"
#include "docent/transport/cdr_sertype.h"
#include "docent/transport/dds_bus.h"
#include "docent/transport/type_hash.h"

namespace docent::transport::ros_graph_test {
namespace {

using namespace std::chrono_literals;

constexpr int kDomain = 43;

/// What a program of ROS 2 has to see others: a reader of ros_discovery_info and what DDS tells of its own.
class RosObserver {
 public:
  RosObserver() : participant_{dds_create_participant(kDomain, nullptr, nullptr)} {
    ddsi_sertype* type = make_cdr_sertype(dds_type_name(ParticipantEntitiesInfo::kType));
    const dds_entity_t topic = dds_create_topic_sertype(participant_, kRosDiscovery, &type, nullptr, nullptr, nullptr);
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_INFINITY);
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
    graph_ = dds_create_reader(participant_, topic, qos, nullptr);
    dds_delete_qos(qos);
    participants_ = dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr);
    writers_ = dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr);
    readers_ = dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, nullptr, nullptr);
  }
  RosObserver(const RosObserver&) = delete;
  RosObserver& operator=(const RosObserver&) = delete;
  ~RosObserver() { dds_delete(participant_); }

  /// The newest that a participant with a node of this name says of itself.
  ParticipantEntitiesInfo graph_of(const std::string& node) {
    ddsi_serdata* samples[16] = {};
    dds_sample_info_t infos[16];
    const int count = dds_takecdr(graph_, samples, 16, infos, DDS_ANY_STATE);
    for (int i = 0; i < count; ++i) {
      const auto info = decode_cdr<ParticipantEntitiesInfo>(cdr_bytes(samples[i]));
      if (infos[i].valid_data && info && !info->node_entities_info_seq.empty())
        graphs_[info->node_entities_info_seq.front().node_name] = *info;
      ddsi_serdata_unref(samples[i]);
    }
    return graphs_[node];
  }

  struct Endpoint {
    std::string topic, type, user_data;
  };
  using Endpoints = std::map<std::array<std::uint8_t, 16>, Endpoint>;
  Endpoints writers() const { return endpoints(writers_); }
  Endpoints readers() const { return endpoints(readers_); }

  std::map<std::array<std::uint8_t, 16>, std::string> participants() const {
    std::map<std::array<std::uint8_t, 16>, std::string> found;
    void* samples[64] = {};
    dds_sample_info_t infos[64];
    const int count = dds_read(participants_, samples, infos, 64, 64);
    for (int i = 0; i < count; ++i) {
      const auto& participant = *static_cast<const dds_builtintopic_participant_t*>(samples[i]);
      if (infos[i].valid_data) found[bytes_of(participant.key)] = user_data_of(participant.qos);
    }
    if (count > 0) dds_return_loan(participants_, samples, count);
    return found;
  }

 private:
  static std::array<std::uint8_t, 16> bytes_of(const dds_guid_t& guid) {
    std::array<std::uint8_t, 16> bytes{};
    std::copy(std::begin(guid.v), std::end(guid.v), bytes.begin());
    return bytes;
  }
  static std::string user_data_of(const dds_qos_t* qos) {
    void* data = nullptr;
    std::size_t size = 0;
    if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) return {};
    std::string text{static_cast<const char*>(data), size};
    dds_free(data);
    return text;
  }
  static Endpoints endpoints(dds_entity_t reader) {
    Endpoints found;
    void* samples[512] = {};
    dds_sample_info_t infos[512];
    const int count = dds_read(reader, samples, infos, 512, 512);
    for (int i = 0; i < count; ++i) {
      const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
      if (infos[i].valid_data)
        found[bytes_of(endpoint.key)] = {endpoint.topic_name, endpoint.type_name, user_data_of(endpoint.qos)};
    }
    if (count > 0) dds_return_loan(reader, samples, count);
    return found;
  }

  dds_entity_t participant_, graph_ = 0, participants_ = 0, writers_ = 0, readers_ = 0;
  std::map<std::string, ParticipantEntitiesInfo> graphs_;
};

std::unique_ptr<DdsBus> robot_node(const std::string& node) {
  DdsOptions options{kDomain, "minerva", {}};
  options.node = node;
  options.renamed = {{"scan_front", "lidar/scan"}, {"scan_rear", "/back"}};
  return std::move(*DdsBus::create(std::move(options)));
}

bool waited_for(const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + 10s;
  while (!done() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(5ms);
  return done();
}

TEST(RosGraph, TellsWhichNodeHasWhichReadersAndWriters) {
  const auto bus = robot_node("docent_plan");  // first: with it comes the setting of the domain
  RosObserver ros;
  static_cast<void>(bus->publisher(topics::kPath));
  bus->subscribe<sensor_msgs::LaserScan>(topics::kScanFront, [](const auto&) {});
  const std::jthread runs{[&](const std::stop_token& stop) { bus->run(stop); }};
  const auto node = [&] {
    const auto info = ros.graph_of("docent_plan");
    return info.node_entities_info_seq.empty() ? NodeEntitiesInfo{} : info.node_entities_info_seq.front();
  };
  ASSERT_TRUE(waited_for([&] { return node().reader_gid_seq.size() == 1; }));
  EXPECT_EQ(node().node_namespace, "/minerva");
  ASSERT_EQ(node().writer_gid_seq.size(), 1U);
  ASSERT_TRUE(waited_for([&] { return ros.writers().contains(node().writer_gid_seq[0].data); }));
  const auto writer = ros.writers().at(node().writer_gid_seq[0].data);
  EXPECT_EQ(writer.topic, "rt/minerva/docent/path");
  EXPECT_EQ(writer.user_data, "typehash=RIHS01_1957a5bb3cee5da65c4e52e52b65a93df227efce4c20f8458b36e73066ca334b;");
  ASSERT_TRUE(waited_for([&] { return ros.readers().contains(node().reader_gid_seq[0].data); }));
  const auto reader = ros.readers().at(node().reader_gid_seq[0].data);
  EXPECT_EQ(reader.topic, "rt/minerva/lidar/scan");
  EXPECT_EQ(reader.user_data, "typehash=RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828;");
  EXPECT_EQ(ros.participants().at(ros.graph_of("docent_plan").gid.data), "enclave=/;");

  // What comes later is told, too, and whoever comes later hears it.
  bus->post([&] { bus->subscribe<sensor_msgs::LaserScan>(topics::kScanRear, [](const auto&) {}); });
  ASSERT_TRUE(waited_for([&] { return node().reader_gid_seq.size() == 2; }));
  ASSERT_TRUE(waited_for([&] { return ros.readers().contains(node().reader_gid_seq[1].data); }));
  EXPECT_EQ(ros.readers().at(node().reader_gid_seq[1].data).topic, "rt/back");
  RosObserver late;
  EXPECT_TRUE(waited_for([&] { return late.graph_of("docent_plan").node_entities_info_seq.size() == 1; }));
}

TEST(RosGraph, NoEndpointIsWithoutItsHashAndItsNode) {
  const auto bus = robot_node("docent_all");
  RosObserver ros;
  for_each_robot_topic([&](const auto& topic) {
    const auto info = topic_info(topic);
    bus->add_subscription(info, [](const auto&) {});
    static_cast<void>(bus->publisher(topic));
  });
  bus->post([&] { static_cast<void>(bus->other_writers(topic_info(topics::kCommandVelocity))); });
  const std::jthread runs{[&](const std::stop_token& stop) { bus->run(stop); }};
  const auto node = [&] { return ros.graph_of("docent_all").node_entities_info_seq; };
  std::size_t topics = 0;
  for_each_robot_topic([&](const auto&) { ++topics; });
  ASSERT_TRUE(waited_for([&] { return !node().empty() && node().front().reader_gid_seq.size() == topics + 1; }));
  ASSERT_EQ(node().front().writer_gid_seq.size(), topics);
  ASSERT_TRUE(waited_for([&] { return ros.writers().size() > topics && ros.readers().size() > topics; }));
  for (const auto& endpoints : {ros.writers(), ros.readers()}) {
    for (const auto& [gid, endpoint] : endpoints) {
      // Else it is the observer's own, of discovery, or of a participant that has just ended.
      const auto& ours = node().front().reader_gid_seq.front().data;
      const bool is_of_the_bus = std::equal(gid.begin(), gid.begin() + 12, ours.begin());
      if (!is_of_the_bus || !endpoint.topic.starts_with("rt/minerva/")) continue;
      EXPECT_TRUE(endpoint.user_data.starts_with("typehash=RIHS01_")) << endpoint.topic << ": " << endpoint.user_data;
      const auto& readers = node().front().reader_gid_seq;
      const auto& writers = node().front().writer_gid_seq;
      EXPECT_EQ(
          std::count(readers.begin(), readers.end(), Gid{gid}) + std::count(writers.begin(), writers.end(), Gid{gid}),
          1)
          << endpoint.topic;
    }
  }
}

TEST(RosGraph, NamesAreThoseThatRos2Allows) {
  EXPECT_EQ(node_name_of("docent_plan"), "docent_plan");
  EXPECT_EQ(node_name_of("docent scene-camera"), "docent_scene_camera");
  EXPECT_EQ(node_name_of("2nd"), "_2nd");
  EXPECT_EQ(node_name_of(""), "_");
}

}  // namespace
}  // namespace docent::transport::ros_graph_test
