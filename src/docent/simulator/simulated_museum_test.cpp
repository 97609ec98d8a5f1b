#include "docent/simulator/simulated_museum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "docent/base/random.h"
#include "docent/messages/conversions.h"
#include "docent/simulator/museum_bench.h"

namespace docent::simulator::simulated_museum_test {
namespace {

TEST(SimulatedMuseum, HasTheSensorsOfItsHardwareAndNoOthers) {
  SimulationOptions small = options("quiet");
  small.hardware.scanners = {{"left", "side", {0.0, 0.1, Angle::degrees(90.0)}, {.field = 0.5 * std::numbers::pi}}};
  small.hardware.sonars = 9;
  small.hardware.infrareds = 0;
  small.hardware.has_tactile = false;
  Bench bench{std::move(small)};
  sensor_msgs::LaserScan scan;
  bench.robot_bus->subscribe(topics::kScanLeft, std::function<void(const sensor_msgs::LaserScan&)>{
                                                    [&](const sensor_msgs::LaserScan& m) { scan = m; }});
  std::map<std::string, int> pings;
  bench.robot_bus->subscribe(topics::kSonar, std::function<void(const sensor_msgs::Range&)>{
                                                 [&](const sensor_msgs::Range& m) { ++pings[m.header.frame_id]; }});
  bench.run(4.0);
  EXPECT_EQ(bench.counts["scan_left"], 40);
  EXPECT_EQ(scan.header.frame_id, "side");
  EXPECT_EQ(scan.ranges.size(), 90U);
  EXPECT_NEAR(static_cast<double>(scan.angle_min), -0.25 * std::numbers::pi, 1e-6);
  for (const char* none : {"scan_front", "scan_rear", "infrared", "tactile"}) EXPECT_EQ(bench.counts[none], 0) << none;
  EXPECT_EQ(pings.size(), 9U) << "each fires";
  EXPECT_EQ(bench.counts["sonar"], 90);
}

TEST(SimulatedMuseum, OffersTheTopicsOfARobotAtTheirRates) {
  Bench bench{options("quiet")};
  bench.run(10.0);
  EXPECT_EQ(bench.counts["scan_front"], 100);
  EXPECT_EQ(bench.counts["scan_rear"], 100);
  EXPECT_EQ(bench.counts["odom"], 200);
  EXPECT_EQ(bench.counts["sonar"], 24 * 25);
  EXPECT_EQ(bench.counts["infrared"], 24 * 50);
  EXPECT_EQ(bench.counts["battery_state"], 10);
  EXPECT_GE(bench.counts["tactile"], 50);
  EXPECT_EQ(bench.counts["truth/state"], 100);
  EXPECT_EQ(bench.counts["truth/run_info"], 1);
}

TEST(SimulatedMuseum, TheSameSeedGivesTheSameRunBitForBit) {
  const auto hash_of_run = [](std::uint64_t seed) {
    Bench bench{options("busy", std::nullopt, seed)};
    bench.drive(0.4, 0.2, 30.0);
    bench.drive(0.0, 0.0, 5.0);
    return bench.hash;
  };
  EXPECT_EQ(hash_of_run(5), hash_of_run(5));
  EXPECT_NE(hash_of_run(5), hash_of_run(6));
}

TEST(SimulatedMuseum, StartsSomewhereFree) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Bench bench{options("packed", std::nullopt, seed)};
    const Point2 start = bench.museum->world_from_base().position();
    const World world = hall();
    EXPECT_TRUE(contains(world.operating_area, start));
    for (const Solid& solid : world.solids) EXPECT_GE(distance(solid.polygon, start), 0.55) << solid.id;
    bench.run(0.2);
    EXPECT_GT(bench.state.nearest_person_m, 0.3);
    EXPECT_TRUE(bench.state.inside_area);
    EXPECT_NEAR(static_cast<double>(bench.museum->people()), 0.2 * bench.museum->free_area(), 1.0);
  }
}

TEST(SimulatedMuseum, AWallStopsTheBodyAndCountsOnce) {
  Bench bench{options("empty", Pose2{18.0, 7.0, Angle{}})};
  bench.drive(0.5, 0.0, 10.0);
  EXPECT_NEAR(bench.state.x, 20.0 - 0.265, 0.002);
  ASSERT_EQ(bench.contacts.size(), 1U);
  EXPECT_EQ(bench.contacts[0].kind, "walls");
  EXPECT_EQ(bench.contacts[0].what, "outer-east");
  EXPECT_NEAR(bench.contacts[0].robot_speed, 0.5, 0.02);
  EXPECT_GT(bench.state.contact_seconds, 3.0);
  EXPECT_FALSE(bench.state.inside_area);
  EXPECT_LT(bench.state.distance_m, 1.8);
}

TEST(SimulatedMuseum, HazardsTouchAlthoughNoSensorSeesThem) {
  Bench plate{options("empty", Pose2{13.0, 4.0, Angle{}})};
  double ahead = 0.0;
  plate.robot_bus->subscribe(
      topics::kScanFront, std::function<void(const sensor_msgs::LaserScan&)>{[&](const sensor_msgs::LaserScan& scan) {
        ahead = static_cast<double>(scan.ranges[90]);
      }});
  plate.run(0.3);
  EXPECT_GT(ahead, 6.5);
  plate.drive(0.4, 0.0, 6.0);
  ASSERT_EQ(plate.contacts.size(), 1U);
  EXPECT_EQ(plate.contacts[0].kind, "hazards");
  Bench stairs{options("empty", Pose2{13.0, 11.0, Angle{}})};
  stairs.drive(0.4, 0.0, 10.0);
  ASSERT_EQ(stairs.contacts.size(), 1U);
  EXPECT_EQ(stairs.contacts[0].what, "stairs");
  EXPECT_NEAR(stairs.state.x, 14.0, 0.05);  // fallen: it goes nowhere
}

TEST(SimulatedMuseum, StopsWhenCommandsEnd) {
  Bench bench{options("empty", Pose2{3.0, 4.0, Angle{}})};
  bench.drive(0.5, 0.0, 3.0);
  EXPECT_NEAR(bench.state.linear, 0.5, 0.01);
  bench.sends = false;
  bench.run(0.95);
  EXPECT_EQ(bench.state.linear, 0.0);
}

TEST(SimulatedMuseum, OdometryFollowsTheMotion) {
  Bench bench{options("empty", Pose2{3.0, 4.0, Angle{}})};
  nav_msgs::Odometry last;
  bench.robot_bus->subscribe(topics::kOdometry, std::function<void(const nav_msgs::Odometry&)>{
                                                    [&](const nav_msgs::Odometry& m) { last = m; }});
  bench.drive(0.5, 0.0, 4.0);
  EXPECT_NEAR(last.twist.twist.linear.x, 0.5, 0.06);
  EXPECT_NEAR(last.pose.pose.position.x, bench.state.x - 3.0, 0.06);
  EXPECT_EQ(last.header.frame_id, "odom");
}

TEST(SimulatedMuseum, WhoStandsStillTouchesNobodyAtFault) {
  // Packed, with pushers: people touch the robot, the robot touches nobody.
  SimulationOptions all = options("packed", Pose2{5.0, 6.0, Angle{}});
  all.crowd_params.push_rate = 0.02;
  Bench bench{std::move(all)};
  bench.run(240.0);
  EXPECT_GT(bench.contacts.size(), 0U);
  for (const auto& contact : bench.contacts) {
    EXPECT_EQ(contact.kind, "people");
    EXPECT_EQ(contact.robot_speed, 0.0);
  }
  EXPECT_NEAR(bench.state.distance_m, 0.0, 1e-9);  // nor do they move 125 kg
}

TEST(SimulatedMuseum, ABlindRobotTouchesPeopleAndIsAtFault) {
  // To and fro through a busy hall without looking: the rules of section 9 must find it out.
  int at_fault = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    Bench bench{options("busy", Pose2{3.0, 4.0, Angle{}}, seed)};
    for (int i = 0; i < 24; ++i) bench.drive(i % 2 == 0 ? 0.5 : -0.5, 0.0, 16.0);
    for (const auto& contact : bench.contacts) {
      if (contact.kind == "people" && contact.robot_speed > 0.1 && !contact.braked_in_time) ++at_fault;
    }
  }
  EXPECT_GE(at_fault, 3);
}

TEST(SimulatedMuseum, ARobotThatStopsBeforePeopleIsNotAtFault) {
  // To and fro along the free southern aisle: it slows for what its scanner sees before it, and stops.
  int passed = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    Bench bench{options("busy", Pose2{3.0, 2.0, Angle{}}, seed)};
    double room = 0.0;
    bench.robot_bus->subscribe(
        topics::kScanFront, std::function<void(const sensor_msgs::LaserScan&)>{[&](const sensor_msgs::LaserScan& scan) {
          room = 10.0;
          for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
            const Angle bearing = Angle::radians(static_cast<double>(scan.angle_min) +
                                                 static_cast<double>(i) * static_cast<double>(scan.angle_increment));
            const Point2 end = static_cast<double>(scan.ranges[i]) * unit(bearing);
            if (std::abs(end.y) < 0.385 && end.x > 0.0) room = std::min(room, end.x - 0.265 - 0.25);
          }
        }});
    bool turns = false;
    for (int i = 0; i < 480 * 10; ++i) {
      const auto& state = bench.state;
      const double heading = state.x > 11.0                 ? 3.14159
                             : state.x < 4.0                ? 0.0
                             : std::abs(state.theta) > 1.57 ? 3.14159
                                                            : 0.0;
      const double off =
          (Angle::radians(heading + (heading > 1.0 ? 1.0 : -1.0) * 0.3 * (state.y - 2.0)) - Angle::radians(state.theta))
              .radians();
      turns = std::abs(off) > (turns ? 0.05 : 0.4);
      const double speed = turns || room <= 0.0 ? 0.0 : std::min(0.5, std::sqrt(0.12 + 1.6 * room) - 0.35);
      bench.drive(std::max(0.0, speed), std::clamp(1.5 * off, -0.8, 0.8), 0.1);
      if (state.nearest_person_m < 1.0) ++passed;
    }
    EXPECT_GT(bench.state.distance_m, 40.0);
    for (const auto& contact : bench.contacts) {
      EXPECT_EQ(contact.kind, "people");
      EXPECT_TRUE(contact.robot_speed <= 0.1 || (contact.braked_in_time && contact.other_speed > contact.robot_speed))
          << "seed " << seed << " at " << to_seconds(from_message(contact.header.stamp)) << " s, robot "
          << contact.robot_speed << " m/s, person " << contact.other_speed << " m/s";
    }
  }
  EXPECT_GT(passed, 100);  // or the test has tested nothing
}

TEST(SimulatedMuseum, VisitorsAskUntilTheyStandOnTheBoard) {
  SimulationOptions all = options("empty");
  all.requests_per_hour = 24.0;
  Bench bench{std::move(all)};
  const auto board = bench.robot_bus->publisher(topics::kRequestBoard);
  bench.run(400.0);
  ASSERT_GE(bench.requests.size(), 2U);
  const docent_msgs::Request first = bench.requests[0];
  EXPECT_EQ(first.id.size(), 36U);
  EXPECT_EQ(first.id[14], '7');
  EXPECT_EQ(bench.requests[1].id, first.id);
  EXPECT_EQ(from_message(bench.requests[1].stamp), from_message(first.stamp));
  const auto times = static_cast<std::size_t>(std::count_if(
      bench.requests.begin(), bench.requests.end(), [&](const auto& request) { return request.id == first.id; }));
  EXPECT_GT(times, 20U);
  docent_msgs::RequestBoard seen;
  for (const auto& request : bench.requests) seen.requests.push_back({request, "queued", "", {}, {}});
  board.publish(seen);
  bench.run(0.2);
  bench.requests.clear();
  bench.run(3.0);
  for (const auto& request : bench.requests) EXPECT_NE(request.id, first.id);
  const auto offered = std::count_if(bench.offers.begin(), bench.offers.end(),
                                     [](const auto& offer) { return offer.kind == "request"; });
  EXPECT_GE(offered, 1);
}

TEST(SimulatedMuseum, TheMuseumsCanBeLivedIn) {
  for (const char* path : {"museums/bonn/simulation.yaml", "museums/smithsonian/simulation.yaml"}) {
    const auto world = load_world(path);
    ASSERT_TRUE(world) << world.error().message;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      SimulationOptions all;
      all.world = *world;
      all.seed = seed;
      Bench bench{std::move(all)};
      const Point2 start = bench.museum->world_from_base().position();
      EXPECT_TRUE(contains(world->operating_area, start));
      for (const Solid& solid : world->solids) {
        EXPECT_TRUE(solid.bottom >= 1.2 || distance(solid.polygon, start) > 0.5) << solid.id << " in " << path;
      }
      for (int i = 0; i < (seed > 0 ? 1 : world->exhibits.size() < 20 ? 60 : 12); ++i) {
        bench.run(5.0);
        for (const auto& person : bench.state.people) {
          const Point2 place{static_cast<double>(person.x), static_cast<double>(person.y)};
          ASSERT_TRUE(contains(world->floor, place)) << path;
          for (const Solid& solid : world->solids) {
            ASSERT_TRUE(solid.bottom >= 2.0 || !contains(solid.polygon, place)) << solid.id << " in " << path;
          }
        }
      }
      EXPECT_EQ(bench.state.distance_m, 0.0);
    }
  }
}

/// A clock that the test turns by hand, as irregular as a busy computer.
class ManualBus : public transport::Bus {
 public:
  Time time = time_from_seconds(1.7e9);
  double late = 0.0;  ///< [s] by its stamp, the last odometry
  [[nodiscard]] Time now() const override { return time; }
  void every(Duration period, std::function<void()> action) override {
    after(period, [this, period, action = std::move(action)] {
      every(period, action);
      action();
    });
  }
  void after(Duration delay, std::function<void()> action) override { due_.emplace_back(time + delay, action); }
  /// It is so much later now; what has become due meanwhile runs late.
  void pass(double duration) {
    time = time + seconds(duration);
    for (auto& [at, action] : std::exchange(due_, {})) {
      if (at <= time) {
        action();
      } else {
        due_.emplace_back(at, action);
      }
    }
  }
  void post(std::function<void()> action) override { action(); }
  int other_writers(const transport::TopicInfo& /*topic*/) override { return 0; }
  void add_subscription(const transport::TopicInfo& topic, Handler handler) override {
    handlers[topic.name] = std::move(handler);
  }
  std::map<std::string, Handler> handlers;
  std::map<std::string, int> counts;

 protected:
  int add_publisher(const transport::TopicInfo& topic) override {
    time = time + seconds(0.0007);  // a world is not made in no time
    names_.push_back(topic.name);
    return static_cast<int>(names_.size()) - 1;
  }
  void publish(int publisher, std::shared_ptr<const void> message) override {
    const std::string& name = names_[static_cast<std::size_t>(publisher)];
    ++counts[name];
    if (name == topics::kOdometry.name)
      late = to_seconds(time - from_message(static_cast<const nav_msgs::Odometry*>(message.get())->header.stamp));
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::pair<Time, std::function<void()>>> due_;
};

TEST(SimulatedMuseum, InRealTimeItCatchesUpALittleAndSkipsTheRest) {
  ManualBus bus;
  const SimulatedMuseum museum{bus, bus, options("quiet", Pose2{3.0, 4.0, Angle{}})};
  Rng rng{1};
  for (double left = 10.0; left > 0.0;) {
    const double step = rng.uniform(0.001, 0.1);
    left -= step;
    bus.pass(step);
  }
  EXPECT_NEAR(bus.counts["scan_front"], 100, 2);
  EXPECT_NEAR(bus.counts["odom"], 200, 3);
  bus.pass(20.0);  // stopped for a while
  EXPECT_NEAR(bus.counts["scan_front"], 100, 3);
}

TEST(SimulatedMuseum, InRealTimeStampsAreAsOldAsTheClockIsCoarse) {
  ManualBus bus;
  const SimulatedMuseum museum{bus, bus, options("empty", Pose2{3.0, 4.0, Angle{}})};
  for (int i = 0; i < 1000; ++i) {
    bus.pass(0.0007);
    ASSERT_LE(bus.late, 0.0008) << "after " << i << " steps";
  }
  EXPECT_GE(bus.counts["odom"], 13);
}

TEST(SimulatedMuseum, RefusesWhatCannotBe) {
  EXPECT_FALSE(validate(options("full")));
  EXPECT_FALSE(validate(options("busy", Pose2{10.0, 6.5, Angle{}})));
  SimulationOptions no_floor = options("busy");
  no_floor.world.floor.clear();
  EXPECT_FALSE(validate(no_floor));
  EXPECT_TRUE(validate(options("busy")));
}

TEST(SimulatedMuseum, MayBeDestroyedWhileTheBusGoesOn) {
  Bench bench{options("quiet")};
  bench.run(1.0);
  bench.museum.reset();
  const int scans = bench.counts["scan_front"];
  bench.drive(0.3, 0.0, 1.0);
  EXPECT_EQ(bench.counts["scan_front"], scans);
}

}  // namespace
}  // namespace docent::simulator::simulated_museum_test
