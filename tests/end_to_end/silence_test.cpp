#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "program.h"
#include "robot_watch.h"

namespace docent::silence_test {
namespace {

using namespace std::chrono_literals;
using Clock = RobotWatch::Clock;
using Seconds = std::chrono::duration<double>;

constexpr int kDomain = 46;

/// Sensors fall silent for ten seconds each, in a robot of processes that gives a tour.
constexpr const char* kScenario = R"(events:
  - {at: 30, fault: {sensor: laser_front, kind: dead, for: 10}}
  - {at: 55, fault: {sensor: laser_rear, kind: dead, for: 10}}
  - {at: 80, fault: {sensor: odom, kind: dead, for: 10}}
  - {at: 105, fault: {sensor: sonar, kind: dead, for: 10}}
)";

/// Some module says in its health that `word` is missing.
bool is_named(const RobotWatch::Snapshot& now, const std::string& word) {
  return std::any_of(now.health.begin(), now.health.end(), [&](const auto& entry) {
    const auto& health = entry.second.health;
    return health.state == "degraded" && health.reason.find(word) != std::string::npos;
  });
}

TEST(Silence, HealthNamesItTheRobotStandsAndGoesOn) {
  const TemporaryFolder folder;
  const std::string scenario = folder.write("scenario.yaml", kScenario);
  RobotWatch watch{kDomain};
  Program up{{"up", "--sim", "--museum", std::string{DOCENT_SOURCES} + "/museums/bonn", "--state",
              (folder.path() / "state").string(), "--domain", std::to_string(kDomain), "--port", "18046", "--crowd",
              "quiet", "--requests-per-hour", "0", "--start=9,3.6,90", "--scenario", scenario}};
  ASSERT_TRUE(eventually([&] { return watch.look().localized; }, 60s)) << up.output();
  watch.ask_for("tour", "highlights");
  const std::map<std::string, std::string> words{
      {"laser_front", "front"}, {"laser_rear", "rear"}, {"odom", "odom"}, {"sonar", "sonar"}};
  for (const auto* sensor : {"laser_front", "laser_rear", "odom", "sonar"}) {
    SCOPED_TRACE(sensor);
    ASSERT_TRUE(eventually([&] { return watch.look().faults.contains(sensor); }, 120s)) << up.output();
    const auto since = watch.look().faults.at(sensor);
    bool is_known = false;
    double known_s = 0.0;
    double fastest_later = 0.0;
    while (Clock::now() - since < 9s) {
      const auto now = watch.look();
      const double at = Seconds{Clock::now() - since}.count();
      if (!is_known && is_named(now, words.at(sensor))) {
        is_known = true;
        known_s = at;
      }
      if (at > 3.0) fastest_later = std::max(fastest_later, std::abs(now.truth.linear));
      std::this_thread::sleep_for(20ms);
    }
    EXPECT_TRUE(is_known);
    EXPECT_LT(known_s, 5.0);
    EXPECT_LT(fastest_later, 0.02) << "it did not stand";
    EXPECT_TRUE(eventually([&] { return !is_named(watch.look(), words.at(sensor)); }, 6s)) << "still missed";
  }
  const double before = watch.look().truth.distance_m;
  EXPECT_TRUE(eventually([&] { return watch.look().truth.distance_m > before + 2.0; }, 60s)) << "it does not go on";
  const auto report = watch.report();
  EXPECT_EQ(report.contacts.all(), 0);
  EXPECT_EQ(report.area_violations, 0);
  EXPECT_GT(report.distance_m, 5.0);
  ASSERT_TRUE(report.latency);
  EXPECT_GT(report.latency->sweeps, 1000U);
  EXPECT_LT(report.latency->p50_s, 0.04) << "waits for a timer; `scripts/evaluate dds` has the strict bounds";
}

}  // namespace
}  // namespace docent::silence_test
