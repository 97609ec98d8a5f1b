#include <dds/dds.h>
#include <gtest/gtest.h>

#include <cmath>

#include "docent.h"
#include "docent/messages/conversions.h"
#include "program.h"
#include "robot_watch.h"

extern "C" const dds_topic_descriptor_t* docent_topic_descriptor(const char* type);

namespace docent::viewer_test {
namespace {

using namespace std::chrono_literals;

constexpr int kDomain = 48;

/// Reads a topic as another program would: with Cyclone's own types and nothing of Docent but the names on the wire.
template <class Sample>
class Viewer {
 public:
  Viewer(const char* topic, const char* type, bool is_latched) {
    participant_ = dds_create_participant(kDomain, nullptr, nullptr);
    const auto* descriptor = docent_topic_descriptor(type);
    const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos{dds_create_qos(), dds_delete_qos};
    const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
    dds_qset_data_representation(qos.get(), 1, &representation);
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    if (is_latched) dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    const dds_entity_t dds_topic = dds_create_topic(participant_, descriptor, topic, nullptr, nullptr);
    reader_ = dds_create_reader(participant_, dds_topic, qos.get(), nullptr);
  }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  ~Viewer() { dds_delete(participant_); }
  [[nodiscard]] bool is_good() const { return reader_ > 0; }

  /// Shows the newest sample to `look` when one has come, which says whether it is what was waited for.
  template <class Look>
  [[nodiscard]] bool sees(const Look& look) const {
    void* sample[1] = {};
    dds_sample_info_t info[1];
    const dds_return_t count = dds_take(reader_, sample, info, 1, 1);
    bool is_seen = false;
    if (count > 0 && info[0].valid_data) is_seen = look(*static_cast<const Sample*>(sample[0]));
    if (count > 0) dds_return_loan(reader_, sample, count);
    return is_seen;
  }

 private:
  dds_entity_t participant_ = 0;
  dds_entity_t reader_ = 0;
};

/// The person with the viewer: hears the belief, and says where the robot stands.
class Person {
 public:
  Person()
      : bus_{std::move(*transport::DdsBus::create({kDomain, "", {}}))}, poses_{bus_->publisher(topics::kInitialPose)} {
    bus_->subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) {
      const std::scoped_lock lock{mutex_};
      belief_ = belief;
    });
    thread_ = std::jthread{[this](const std::stop_token& stop) { bus_->run(stop); }};
  }
  [[nodiscard]] docent_msgs::Belief belief() {
    const std::scoped_lock lock{mutex_};
    return belief_;
  }
  [[nodiscard]] bool believes(const Pose2& pose, double within) {
    const auto now = belief();
    return !now.hypotheses.empty() &&
           distance(Point2{now.hypotheses[0].x, now.hypotheses[0].y}, pose.position()) < within;
  }
  void say(const Pose2& pose, const builtin_interfaces::Time& stamp, const std::string& frame = "map") {
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header = {stamp, frame};
    message.pose.pose = to_message(pose);
    message.pose.covariance[0] = message.pose.covariance[7] = 0.25;  // as rviz2 does
    message.pose.covariance[35] = 0.068;
    bus_->post([this, message] { poses_.publish(message); });
  }

 private:
  std::unique_ptr<transport::DdsBus> bus_;
  transport::Publisher<geometry_msgs::PoseWithCovarianceStamped> poses_;
  std::mutex mutex_;
  docent_msgs::Belief belief_;
  std::jthread thread_;
};

/// The sample of a belief lies round that place.
bool lies_round(const geometry_msgs_msg_dds__PoseArray_& sample, Point2 place) {
  if (std::string{sample.header.frame_id} != "map" || sample.poses._length < 100) return false;
  Point2 mean;
  for (std::uint32_t i = 0; i < sample.poses._length; ++i) {
    const auto& pose = sample.poses._buffer[i];
    mean = mean + 1.0 / sample.poses._length * Point2{pose.position.x, pose.position.y};
    EXPECT_NEAR(std::hypot(pose.orientation.z, pose.orientation.w), 1.0, 1e-9);
  }
  return distance(mean, place) < 0.5;
}

/// A cylinder stands where somebody is.
template <class People>
bool shows_one_of(const People& people, const visualization_msgs_msg_dds__MarkerArray_& array) {
  for (std::uint32_t i = 0; i < array.markers._length; ++i) {
    const auto& marker = array.markers._buffer[i];
    if (std::string{marker.header.frame_id} != "map" || marker.type != visualization_msgs::Marker::kCylinder) continue;
    EXPECT_EQ(marker.lifetime.sec, 1);
    for (const auto& visitor : people)
      if (distance(Point2{visitor.x, visitor.y}, {marker.pose.position.x, marker.pose.position.y}) < 0.6) return true;
  }
  return false;
}

TEST(Viewer, SeesBeliefAndPeopleAndTellsTheRobotWhereItStands) {
  const TemporaryFolder folder;
  RobotWatch watch{kDomain};
  Person person;
  const Viewer<geometry_msgs_msg_dds__PoseArray_> cloud{"rt/docent/belief_poses", "geometry_msgs/msg/PoseArray", true};
  const Viewer<visualization_msgs_msg_dds__MarkerArray_> people{"rt/docent/people_markers",
                                                                "visualization_msgs/msg/MarkerArray", false};
  ASSERT_TRUE(cloud.is_good() && people.is_good());
  Program up{{"up", "--sim", "--museum", std::string{DOCENT_SOURCES} + "/museums/bonn", "--state",
              (folder.path() / "state").string(), "--domain", std::to_string(kDomain), "--port", "18048", "--crowd",
              "busy", "--requests-per-hour", "0", "--start=9,3.6,90"}};
  ASSERT_TRUE(eventually([&] { return watch.look().localized; }, 60s)) << up.output();

  const auto robot = [&] {
    const auto truth = watch.look().truth;
    return Pose2{truth.x, truth.y, Angle::radians(truth.theta)};
  };
  EXPECT_TRUE(eventually(
      [&] { return cloud.sees([&](const auto& sample) { return lies_round(sample, robot().position()); }); }, 15s))
      << up.output();
  EXPECT_TRUE(eventually(
      [&] { return people.sees([&](const auto& array) { return shows_one_of(watch.look().truth.people, array); }); },
      30s))
      << up.output();

  // Told a wrong place, it believes that; told the right one, it knows where it is.
  const Pose2 wrong{7.0, 18.0, Angle{}};
  person.say(wrong, watch.look().truth.header.stamp);
  ASSERT_TRUE(eventually([&] { return person.believes(wrong, 0.5); }, 5s)) << up.output();
  const auto truth = watch.look().truth;
  person.say({truth.x, truth.y, Angle::radians(truth.theta)}, truth.header.stamp);
  EXPECT_TRUE(eventually([&] { return person.believes(robot(), 0.5) && person.belief().localized; }, 10s))
      << up.output();
  // What names no place of the map changes nothing, and the module's health says why.
  person.say(wrong, watch.look().truth.header.stamp, "odom");
  EXPECT_TRUE(eventually(
      [&] {
        const std::string reason = watch.look().health["localize"].health.reason;
        return reason.find("1 messages of initialpose refused: frame_id is not map") != std::string::npos;
      },
      5s))
      << up.output();
  EXPECT_TRUE(person.believes(robot(), 0.5));
  EXPECT_EQ(watch.report().contacts.all(), 0);
}

}  // namespace
}  // namespace docent::viewer_test
