#include "docent/recording/recorder.h"

#include <dds/dds.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <thread>

#include "docent/messages/random_message.h"
#include "docent/transport/dds_bus.h"

namespace docent::recording {
namespace {

using namespace std::chrono_literals;

constexpr int kDomain = 44;

class RecorderFile : public testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() / ("docent_recorder_" + std::to_string(getpid()) + ".mcap");
  }
  void TearDown() override { std::filesystem::remove(file_); }
  std::filesystem::path file_;
};

TEST_F(RecorderFile, EveryTopicComesBackAsItWas) {
  auto recorder = Recorder::create(file_);
  ASSERT_TRUE(recorder);
  std::vector<std::pair<std::string, std::vector<std::uint8_t>>> written;
  std::int64_t time = 0;
  const auto write = [&]<class T>(const Topic<T>& topic) {
    const auto message = std::make_shared<const T>(random_message<T>(static_cast<std::uint64_t>(time) + 1));
    ASSERT_TRUE(recorder->write(transport::topic_info(topic), Time{time += 1000000}, message));
    written.emplace_back(topic.name, encode_cdr(*message));
  };
  for_each_robot_topic(write);
  for_each_truth_topic(write);
  ASSERT_TRUE(recorder->close());

  auto reader = McapReader::open(file_);
  ASSERT_TRUE(reader);
  std::size_t next = 0;
  const auto read = read_recording(*reader, {}, [&](const RecordedMessage& message) {
    EXPECT_EQ(message.topic.name, written[next].first);
    EXPECT_EQ(message.topic.type->encode(message.message.get()), written[next].second);
    ++next;
    return true;
  });
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(next, written.size());
  EXPECT_GE(next, 30U);
}

TEST_F(RecorderFile, ATopicOfAnotherTypeIsAnError) {
  auto writer = McapWriter::create(file_);
  const auto channel = writer->add_channel({"/scan_front", "std_msgs/msg/String", "ros2msg", "string data", "cdr", {}});
  const auto foreign = writer->add_channel({"/image", "sensor_msgs/msg/Image", "ros2msg", "uint8[] data", "cdr", {}});
  ASSERT_TRUE(writer->write(*foreign, Time{1}, Time{1}, {}));
  ASSERT_TRUE(writer->write(*channel, Time{2}, Time{2}, {}));
  ASSERT_TRUE(writer->close());
  auto reader = McapReader::open(file_);
  const auto read = read_recording(*reader, {}, [](const RecordedMessage&) { return true; });
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("/scan_front"), std::string::npos);
}

TEST_F(RecorderFile, ABeliefThatWasRecordedAsAnotherTypeIsPassedOver) {
  auto writer = McapWriter::create(file_);
  const auto channel =
      writer->add_channel({"/particle_cloud", "geometry_msgs/msg/PoseArray", "ros2msg", "", "cdr", {}});
  ASSERT_TRUE(writer->write(*channel, Time{2}, Time{2}, encode_cdr(geometry_msgs::PoseArray{})));
  ASSERT_TRUE(writer->close());
  auto reader = McapReader::open(file_);
  int messages = 0;
  EXPECT_TRUE(read_recording(*reader, {}, [&](const RecordedMessage&) { return ++messages > 0; }));
  EXPECT_EQ(messages, 0);
}

TEST_F(RecorderFile, ADamagedMessageIsAnError) {
  auto writer = McapWriter::create(file_);
  const RecordedTopic& topic = *find_recorded_topic("/docent/belief");
  const auto channel =
      writer->add_channel({"/docent/belief", topic.info.type->name, "ros2msg", topic.schema, "cdr", {}});
  const std::vector<std::uint8_t> bytes{0, 1, 0, 0, 9};
  ASSERT_TRUE(writer->write(*channel, Time{2000000000}, Time{2}, bytes));
  ASSERT_TRUE(writer->close());
  auto reader = McapReader::open(file_);
  const auto read = read_recording(*reader, {}, [](const RecordedMessage&) { return true; });
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("damaged docent_msgs/msg/Belief"), std::string::npos) << read.error().message;
}

/// What decides whether a reader matches, and how much a late one gets.
struct Offer {
  bool is_reliable = false;
  bool is_latched = false;
  int depth = 0;
  std::int64_t lease = 0;  ///< [ns]
  bool has_deadline = false;
  std::string user_data;
  friend bool operator==(const Offer&, const Offer&) = default;
  friend void PrintTo(const Offer& offer, std::ostream* out) {
    *out << offer.is_reliable << ' ' << offer.is_latched << ' ' << offer.depth << ' ' << offer.lease << ' '
         << offer.has_deadline << ' ' << offer.user_data;
  }
};

Offer offer_of(const dds_qos_t* qos) {
  Offer offer;
  dds_reliability_kind_t reliability{};
  dds_duration_t time = 0;
  dds_qget_reliability(qos, &reliability, &time);
  offer.is_reliable = reliability == DDS_RELIABILITY_RELIABLE;
  dds_durability_kind_t durability{};
  dds_qget_durability(qos, &durability);
  offer.is_latched = durability == DDS_DURABILITY_TRANSIENT_LOCAL;
  dds_liveliness_kind_t liveliness{};
  dds_qget_liveliness(qos, &liveliness, &offer.lease);
  offer.has_deadline = dds_qget_deadline(qos, &time) && time != DDS_INFINITY;
  void* data = nullptr;
  std::size_t size = 0;
  if (dds_qget_userdata(qos, &data, &size) && data != nullptr) {
    offer.user_data.assign(static_cast<const char*>(data), size);
    dds_free(data);
  }
  return offer;
}

/// By topic on the wire, of all writers of the domain.
std::map<std::string, Offer> offers_on_the_wire(std::size_t at_least) {
  const dds_entity_t participant = dds_create_participant(kDomain, nullptr, nullptr);
  const dds_entity_t reader = dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr);
  std::map<std::string, Offer> offers;
  for (const auto end = std::chrono::steady_clock::now() + 10s;
       offers.size() < at_least && std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(5ms)) {
    void* samples[512] = {};
    dds_sample_info_t infos[512];
    const int count = dds_read(reader, samples, infos, 512, 512);
    for (int i = 0; i < count; ++i) {
      const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
      if (infos[i].valid_data && std::string_view{endpoint.topic_name}.starts_with("rt/"))
        offers[endpoint.topic_name] = offer_of(endpoint.qos);
    }
    if (count > 0) dds_return_loan(reader, samples, count);
  }
  dds_delete(participant);
  return offers;
}

Offer offer_of(const McapChannel& channel) {
  const YAML::Node list = YAML::Load(channel.metadata.at("offered_qos_profiles"));
  EXPECT_EQ(list.size(), 1U);
  const YAML::Node profile = list[0];
  const auto nanoseconds = [&](const char* key) {
    return profile[key]["sec"].as<std::int64_t>() * 1'000'000'000 + profile[key]["nsec"].as<std::int64_t>();
  };
  EXPECT_EQ(profile["history"].as<int>(), 1);
  EXPECT_EQ(profile["liveliness"].as<int>(), 1);
  EXPECT_EQ(nanoseconds("lifespan"), DDS_INFINITY);
  return {profile["reliability"].as<int>() == 1,
          profile["durability"].as<int>() == 1,
          0,
          nanoseconds("liveliness_lease_duration"),
          nanoseconds("deadline") != DDS_INFINITY,
          "typehash=" + channel.metadata.at("topic_type_hash") + ";"};
}

TEST_F(RecorderFile, OffersEveryTopicAsTheWireDoes) {
  auto created = transport::DdsBus::create({kDomain, "", {}});
  ASSERT_TRUE(created.has_value());
  auto recorder = Recorder::create(file_);
  ASSERT_TRUE(recorder.has_value());
  std::size_t topics = 0;
  const auto offer = [&]<class T>(const Topic<T>& topic) {
    static_cast<void>((*created)->publisher(topic));
    ASSERT_TRUE(recorder->write(transport::topic_info(topic), Time{}, std::make_shared<const T>(random_message<T>(1))));
    ++topics;
  };
  for_each_robot_topic(offer);
  for_each_truth_topic(offer);
  ASSERT_TRUE(recorder->close());

  const auto wire = offers_on_the_wire(topics);
  ASSERT_EQ(wire.size(), topics);
  auto reader = McapReader::open(file_);
  ASSERT_TRUE(reader.has_value());
  std::map<std::string, McapChannel> channels;
  ASSERT_TRUE(reader->read({}, [&](const McapMessage& message) {
    channels[message.channel.topic] = message.channel;
    return true;
  }));
  ASSERT_EQ(channels.size(), topics);
  for (const auto& [topic, channel] : channels) EXPECT_EQ(offer_of(channel), wire.at("rt" + topic)) << topic;
  // What tf2 and map viewers ask for.
  EXPECT_TRUE(offer_of(channels.at("/tf")).is_reliable);
  EXPECT_TRUE(offer_of(channels.at("/odom")).is_reliable);
  EXPECT_TRUE(offer_of(channels.at("/tf_static")).is_latched);
  EXPECT_TRUE(offer_of(channels.at("/map")).is_latched);
  EXPECT_FALSE(offer_of(channels.at("/cmd_vel")).is_latched);
}

TEST(RecordedTopics, AreKnownByBothNames) {
  ASSERT_NE(find_recorded_topic("scan_front"), nullptr);
  EXPECT_EQ(find_recorded_topic("scan_front"), find_recorded_topic("/scan_front"));
  EXPECT_NE(find_recorded_topic("/truth/state"), nullptr);
  EXPECT_EQ(find_recorded_topic("rosout"), nullptr);
  EXPECT_NE(find_recorded_topic("odom")->schema.find("MSG: geometry_msgs/TwistWithCovariance"), std::string::npos);
}

}  // namespace
}  // namespace docent::recording
