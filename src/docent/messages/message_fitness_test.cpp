#include "docent/messages/message_fitness.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "docent/messages/hostile_message.h"
#include "docent/messages/topics.h"

namespace docent {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

sensor_msgs::LaserScan scan_all_round() {
  sensor_msgs::LaserScan scan;
  scan.angle_min = -static_cast<float>(std::numbers::pi);
  scan.angle_increment = static_cast<float>(std::numbers::pi / 90.0);
  scan.range_max = 6.0F;
  scan.ranges.assign(180, 2.0F);
  return scan;
}

TEST(MessageFitness, AScanNeedsBeamsThatAScannerHas) {
  EXPECT_FALSE(fault_of(scan_all_round()));
  for (const auto part : {&sensor_msgs::LaserScan::angle_min, &sensor_msgs::LaserScan::angle_increment,
                          &sensor_msgs::LaserScan::range_min, &sensor_msgs::LaserScan::range_max}) {
    for (const float value : {kNan, kInfinity, 1e30F, -1e30F, -1e4F}) {
      auto scan = scan_all_round();
      scan.*part = value;
      EXPECT_TRUE(fault_of(scan)) << value;
    }
  }
  auto clockwise = scan_all_round();
  clockwise.angle_min = -clockwise.angle_min;
  clockwise.angle_increment = -clockwise.angle_increment;
  EXPECT_FALSE(fault_of(clockwise)) << "as many scanners turn";
  clockwise.angle_increment *= 4.0F;
  EXPECT_EQ(fault_of(clockwise).text(), "angle_increment takes the beams more than twice round");
  EXPECT_TRUE(fault_on(topics::kVirtualScan, clockwise, fault_of(clockwise)));
  auto scan = scan_all_round();
  scan.angle_increment = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(fault_of(scan).text(), "angle_increment is too small for several beams");
  scan = scan_all_round();
  scan.ranges.assign(400, 2.0F);
  EXPECT_EQ(fault_of(scan).text(), "angle_increment takes the beams more than twice round");
  scan.angle_increment = 1e-4F;
  scan.ranges.assign(kMostBeams + 1, 2.0F);
  EXPECT_EQ(fault_of(scan).text(), "ranges are more than any scanner has");
}

TEST(MessageFitness, VirtualMeasurementsGoRoundTwice) {
  const char* const kTurns = "ranges do not go round twice, for hazards and for the border";
  auto scan = scan_all_round();
  EXPECT_FALSE(fault_on(topics::kScanFront, scan, fault_of(scan)));
  EXPECT_EQ(fault_on(topics::kVirtualScan, scan, fault_of(scan)).text(), kTurns);
  for (const std::size_t beams : {0U, 1U, 2U, 179U, 270U, 358U, 359U, 361U, 362U}) {
    scan.ranges.assign(beams, 2.0F);
    EXPECT_TRUE(fault_on(topics::kVirtualScan, scan, fault_of(scan))) << beams;
  }
  scan.ranges.assign(360, 2.0F);
  EXPECT_FALSE(fault_on(topics::kVirtualScan, scan, fault_of(scan)));
  scan.ranges[200] = kInfinity;  // nothing there
  EXPECT_FALSE(fault_on(topics::kVirtualScan, scan, fault_of(scan)));
  scan.ranges[200] = kNan;
  EXPECT_EQ(fault_on(topics::kVirtualScan, scan, fault_of(scan)).text(), "ranges have a direction without a number");
  scan.ranges[200] = 2.0F;
  scan.angle_min = kNan;
  EXPECT_EQ(fault_on(topics::kVirtualScan, scan, fault_of(scan)).text(), "angle_min is no bearing")
      << "and all that a scan must be";
  scan = scan_all_round();
  scan.angle_increment = static_cast<float>(2.0 * std::numbers::pi / 7.0);
  scan.ranges.assign(14, 2.0F);
  EXPECT_FALSE(fault_on(topics::kVirtualScan, scan, fault_of(scan))) << "any number of directions does";
}

TEST(MessageFitness, ThePoseThatTheRobotIsToldNamesAPlaceOfTheMap) {
  geometry_msgs::PoseWithCovarianceStamped pose;
  const auto fault = [&] { return fault_on(topics::kInitialPose, pose, fault_of(pose)).text(); };
  for (const char* frame : {"", "odom", "/map", "base_link"}) {
    pose.header.frame_id = frame;
    EXPECT_EQ(fault(), "frame_id is not map") << frame;
  }
  pose.header.frame_id = "map";
  EXPECT_FALSE(fault_on(topics::kInitialPose, pose, fault_of(pose))) << "a covariance of zeros is what many tools send";
  pose.pose.covariance[0] = pose.pose.covariance[7] = 0.25;
  pose.pose.covariance[35] = 0.07;
  EXPECT_FALSE(fault_on(topics::kInitialPose, pose, fault_of(pose)));
  for (const std::size_t variance : {0U, 7U, 35U}) {
    auto wrong = pose;
    wrong.pose.covariance[variance] = -0.1;
    EXPECT_EQ(fault_on(topics::kInitialPose, wrong, fault_of(wrong)).text(), "covariance has a variance below 0");
    wrong.pose.covariance[variance] = static_cast<double>(kNan);
    EXPECT_EQ(fault_on(topics::kInitialPose, wrong, fault_of(wrong)).text(), "covariance is no number of this world");
  }
  pose.pose.covariance[7] = 101.0;
  EXPECT_EQ(fault(), "covariance is wider than 10 m: it names no place");
  pose.pose.covariance[7] = 0.25;
  pose.pose.pose.position.x = static_cast<double>(kInfinity);
  EXPECT_EQ(fault(), "x is no number of this world");
  pose.pose.pose.position.x = 0.0;
  pose.pose.pose.orientation = {0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(fault(), "rotation is none: its length is not 1");
  const geometry_msgs::PoseWithCovarianceStamped other;
  EXPECT_FALSE(fault_on(topics::kPose, other, fault_of(other))) << "of this topic alone";
}

TEST(MessageFitness, ReadingsMayBeAnything) {
  auto scan = scan_all_round();
  scan.ranges = {kNan, kInfinity, -kInfinity, 1e30F, -1e30F, 0.0F};
  EXPECT_FALSE(fault_of(scan));
  sensor_msgs::Range range;
  range.max_range = 5.0F;
  range.range = kNan;
  EXPECT_FALSE(fault_of(range));
  range.field_of_view = kNan;
  EXPECT_TRUE(fault_of(range));
}

TEST(MessageFitness, OneNumberThatIsNoneSpoilsTheMessage) {
  docent_msgs::Belief belief;
  belief.cells.resize(3);
  EXPECT_FALSE(fault_of(belief));
  belief.cells[2].mass = kNan;
  EXPECT_EQ(fault_of(belief).text(), "mass is no number of this world");
  belief.cells.assign(kMostBelievedCells + 1, {});
  EXPECT_TRUE(fault_of(belief));

  docent_msgs::Target target;
  EXPECT_FALSE(fault_of(target));
  target.via_x = {1.0, 1e30};
  EXPECT_TRUE(fault_of(target));

  nav_msgs::Odometry odometry;
  EXPECT_FALSE(fault_of(odometry));
  odometry.pose.covariance[0] = std::numeric_limits<double>::max();  // a driver's word for "unknown"
  EXPECT_FALSE(fault_of(odometry));
  odometry.pose.pose.orientation.z = static_cast<double>(kNan);
  EXPECT_TRUE(fault_of(odometry));
  odometry.pose.pose.orientation = {0.0, 0.0, 30.0, 1.0};
  EXPECT_EQ(fault_of(odometry).text(), "rotation is none: its length is not 1");

  docent_msgs::Limits limits;
  EXPECT_FALSE(fault_of(limits));
  limits.volume = 1.5;
  EXPECT_FALSE(fault_of(limits)) << "whoever says that the robot shall stand must be heard";
  limits.volume = static_cast<double>(kNan);
  EXPECT_TRUE(fault_of(limits));
  limits.volume = 1.0;
  limits.max_speed = -0.1;
  EXPECT_TRUE(fault_of(limits));
}

TEST(MessageFitness, CountsMustFillWhatTheyCount) {
  nav_msgs::OccupancyGrid map;
  map.info.resolution = 0.1F;
  EXPECT_FALSE(fault_of(map));
  map.info.width = map.info.height = 4000000000U;
  EXPECT_TRUE(fault_of(map));
  docent_msgs::LiveMapUpdate update;
  update.width = 2;
  update.height = 2;
  update.data.assign(4, 0);
  EXPECT_FALSE(fault_of(update));
  update.x = std::numeric_limits<std::int32_t>::max();
  EXPECT_TRUE(fault_of(update));
}

/// Whether a number that is none, or too great, stands anywhere but where readings and the like may hold it.
struct Look {
  bool found = false;
  template <class T>
  void operator()(const char* name, const T& field) {
    const std::string_view field_name{name};
    if (field_name == "ranges" || field_name == "range" || field_name == "intensities" || field_name == "covariance")
      return;
    look(field);
  }
  template <class T>
  void look(const T& field) {
    if constexpr (Message<T>) {
      T::visit(field, *this);
    } else if constexpr (std::is_floating_point_v<T>) {
      found = found || !(std::abs(static_cast<double>(field)) <= 2.0 * kMostAnything);
    }
  }
  void look(const std::string& /*text*/) {}
  template <class T>
  void look(const std::vector<T>& items) {
    for (const T& item : items) look(item);
  }
  template <class T, std::size_t N>
  void look(const std::array<T, N>& items) {
    for (const T& item : items) look(item);
  }
};

TEST(MessageFitness, NoTopicsMessagePassesWithANumberThatIsNone) {
  Rng rng{1};
  std::size_t passed = 0, refused = 0;
  for_each_robot_topic([&]<class T>(const Topic<T>& topic) {
    if constexpr (std::is_same_v<T, sensor_msgs::BatteryState> || std::is_same_v<T, sensor_msgs::LaserScan> ||
                  std::is_same_v<T, nav_msgs::Odometry>) {
      return;  // only what is used of them counts; see above
    } else {
      for (int i = 0; i < 200; ++i) {
        T message;
        spoil(message, rng, 0.1);
        if (fault_of(message)) {
          ++refused;
          continue;
        }
        ++passed;
        Look look;
        T::visit(message, look);
        EXPECT_FALSE(look.found) << topic.name;
      }
    }
  });
  EXPECT_GT(passed, 500U);
  EXPECT_GT(refused, 500U);
}

TEST(MessageFitness, AMountLiesOnTheRobot) {
  docent_msgs::Calibration calibration;
  calibration.mounts.push_back({"front", 0.2, -0.1, 1.0, 0.15, 0.1, 0.05, false});
  EXPECT_FALSE(fault_of(calibration));
  for (const auto spoil : {+[](docent_msgs::Calibration& c) { c.mounts[0].x = 1e6; },
                           +[](docent_msgs::Calibration& c) { c.mounts[0].heading = 100.0; },
                           +[](docent_msgs::Calibration& c) { c.mounts[0].delay = -3.0; },
                           +[](docent_msgs::Calibration& c) { c.mounts[0].doubt_position = -1.0; },
                           +[](docent_msgs::Calibration& c) { c.most_speed = -1.0; },
                           +[](docent_msgs::Calibration& c) { c.way_scale = 0.0; }}) {
    docent_msgs::Calibration spoilt = calibration;
    spoil(spoilt);
    EXPECT_TRUE(fault_of(spoilt));
  }
}

}  // namespace
}  // namespace docent
