#include "docent/transport/discovery/ros_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "docent/transport/dds_bus.h"

namespace docent::transport::ros_nodes_test {
namespace {

constexpr int kDomain = 51;  // other tests run at the same time in other domains

/// ParticipantEntitiesInfo byte by byte, as `rmw_dds_common` has it, with names on DDS of that size.
class GraphBytes {
 public:
  explicit GraphBytes(std::size_t gid) : gid_{gid} {
    name(1);
    number(2);
    node("/turtlebot4", "motion_control", 2, 1);
    node("/", "lonely", 0, 0);
  }
  std::vector<std::uint8_t> bytes{0, 1, 0, 0};

 private:
  void number(std::uint32_t value) {
    while (bytes.size() % 4 != 0) bytes.push_back(0);
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
  void text(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size() + 1));
    bytes.insert(bytes.end(), value.begin(), value.end());
    bytes.push_back(0);
  }
  void name(std::uint8_t first) {  // sixteen bytes that count; what Humble has behind them is zero
    for (std::size_t i = 0; i < gid_; ++i) bytes.push_back(i < 16 ? static_cast<std::uint8_t>(first + i) : 0);
  }
  void node(const std::string& space, const std::string& own, std::uint32_t readers, std::uint32_t writers) {
    text(space);
    text(own);
    for (const std::uint32_t count : {readers, writers}) {
      number(count);
      for (std::uint32_t i = 0; i < count; ++i) name(static_cast<std::uint8_t>(40 + i));
    }
  }
  std::size_t gid_;
};

TEST(RosNodes, AreReadInTheFormOfHumbleAndInThatOfIronAndLater) {
  for (const std::size_t size : {16U, 24U}) {
    const GraphBytes graph{size};
    const auto nodes = ros_nodes_of(graph.bytes);
    ASSERT_TRUE(nodes) << size;
    ASSERT_EQ(nodes->size(), 2U) << size;
    EXPECT_EQ((*nodes)[0].name, "/turtlebot4/motion_control");
    EXPECT_EQ((*nodes)[0].participant, "0102030405060708090a0b0c0d0e0f10");
    EXPECT_EQ((*nodes)[0].readers, 2U);
    EXPECT_EQ((*nodes)[0].writers, 1U);
    EXPECT_EQ((*nodes)[1].name, "/lonely");
  }
}

TEST(RosNodes, OfAnotherFormAreRefused) {
  for (const std::size_t size : {8U, 20U, 32U}) EXPECT_FALSE(ros_nodes_of(GraphBytes{size}.bytes)) << size;
  const std::vector<std::uint8_t> whole = GraphBytes{24}.bytes;
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    const auto nodes = ros_nodes_of(std::span{whole}.first(cut));
    EXPECT_TRUE(!nodes || nodes->empty()) << cut;  // 28 bytes are whole without a node
  }
}

TEST(RosNodes, OfOtherProgramsAreHeard) {
  DdsOptions options{kDomain, "minerva", {}};
  options.node = "docent_localize";
  const auto other = std::move(*DdsBus::create(std::move(options)));
  [[maybe_unused]] const auto scans = other->publisher(topics::kScanFront);
  const auto bus = std::move(*DdsBus::create({kDomain, "", {}}));
  RosNodeListener listener{bus->participant()};
  std::jthread running{[&](const std::stop_token& stop) { other->run(stop); }};
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{10};
  std::vector<RosNode> nodes;
  while (nodes.empty() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds{20});
    nodes = listener.heard();
  }
  ASSERT_EQ(nodes.size(), 1U) << "itself is left out";
  EXPECT_EQ(nodes[0].name, "/minerva/docent_localize");
  EXPECT_GE(nodes[0].writers, 1U);
}

}  // namespace
}  // namespace docent::transport::ros_nodes_test
