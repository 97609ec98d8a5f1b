#include "docent/localization/sonar/evidence/sonar_evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "docent/localization/markov/testing.h"

namespace docent::localization {
namespace {

constexpr int kSonars = 24;
constexpr double kReach = 5.0;  // [m]

enum class Fault { none, frozen, deaf, near, storm };

/// A ring of sonars in the drawn room, each of which hears the nearest thing in 15 degrees.
class Ring {
 public:
  explicit Ring(const SonarEvidenceParams& params, std::uint64_t seed = 1)
      : evidence{params, kSonars, room.space, room.table, sensor_models::ProximityModel{{}}, seed},
        rng_{Rng{seed}.stream("ring")} {}

  /// All sonars, once.
  void ping(const Pose2& truth, const Pose2& odom, double time, Fault fault = Fault::none) {
    for (int i = 0; i < kSonars; ++i) {
      const Angle bearing = Angle::degrees(15.0 * i);
      const Pose2 base_from_sonar{0.25 * unit(bearing).x, 0.25 * unit(bearing).y, bearing};
      double& range = last_[static_cast<std::size_t>(i)];
      if (fault != Fault::frozen) range = heard(truth * base_from_sonar);
      if (fault == Fault::deaf) range = kReach;
      if (fault == Fault::near) range = 0.3;
      if (fault == Fault::storm && rng_.chance(0.5)) range = rng_.uniform(0.3, std::max(0.31, range));
      evidence.hear({time_from_seconds(time), i, base_from_sonar, odom, range, kReach});
    }
  }
  [[nodiscard]] float cost(const Pose2& pose) const {
    float nats = 0.0F;
    evidence.add_costs({&pose, 1}, {&nats, 1});
    return nats;
  }

  testing::Room room{2.0};
  SonarEvidence evidence;

 private:
  [[nodiscard]] double heard(const Pose2& map_from_sonar) {
    double range = kReach;
    for (int off = -7; off <= 7; ++off) {
      const Point2 along = unit(map_from_sonar.theta + Angle::degrees(off));
      range = std::min(range, room.caster.cast(map_from_sonar.position(), along, kReach, 0.3).value_or(kReach));
    }
    return range >= kReach ? kReach : std::max(0.05, range + rng_.normal(0.0, 0.02));
  }
  Rng rng_;
  std::array<double, kSonars> last_{};
};

SonarEvidenceParams with_beams(int beams = 12) {
  SonarEvidenceParams params;
  params.beams = beams;
  return params;
}

Pose2 free_pose(const testing::Room& room, Rng& rng) {
  for (;;) {
    const Pose2 pose{rng.uniform(0.5, 5.5), rng.uniform(0.5, 3.5), Angle::degrees(rng.uniform(-180.0, 180.0))};
    if (room.caster.clearance(pose.position()) > 0.4F) return pose;
  }
}

TEST(SonarEvidence, TheTrueplaceCostsLessThanPlacesNearby) {
  SonarEvidenceParams params = with_beams(24);
  params.most_nats = 50.0;
  Ring ring{params};
  Rng rng{5};
  int better = 0;
  int asked = 0;
  for (int i = 0; i < 60; ++i) {
    const Pose2 truth = free_pose(ring.room, rng);
    ring.ping(truth, {}, i);
    ASSERT_TRUE(ring.evidence.observe({time_from_seconds(i), {}, {}}));
    for (const Pose2& off : {Pose2{0.4, 0.0, {}}, Pose2{0.0, 0.4, {}}, Pose2{0.0, 0.0, Angle::degrees(15.0)}}) {
      ++asked;
      better += ring.cost(truth) < ring.cost(truth * off) ? 1 : 0;
    }
  }
  EXPECT_GE(better, asked * 9 / 10) << "of " << asked;
}

TEST(SonarEvidence, AnEchoCountsOnceAndNotWhenItIsOld) {
  Ring ring{with_beams()};
  const Pose2 truth{1.0, 0.8, {}};
  EXPECT_FALSE(ring.evidence.observe({time_from_seconds(0.0), {}, {}}));
  ring.ping(truth, {}, 1.0);
  EXPECT_TRUE(ring.evidence.observe({time_from_seconds(1.2), {}, {}}));
  EXPECT_FALSE(ring.evidence.observe({time_from_seconds(1.3), {}, {}}));
  ring.ping(truth, {}, 2.0);
  EXPECT_FALSE(ring.evidence.observe({time_from_seconds(2.6), {}, {}}));
}

TEST(SonarEvidence, EchoesAreCarriedOnByOdometry) {
  SonarEvidenceParams params = with_beams(24);
  params.most_nats = 50.0;
  Ring ring{params};
  const Pose2 truth{1.2, 1.0, Angle::degrees(10.0)};
  const Pose2 motion{0.3, 0.0, Angle::degrees(20.0)};
  const Pose2 odom{4.0, 2.0, Angle::degrees(90.0)};
  ring.ping(truth, odom, 1.0);
  ASSERT_TRUE(ring.evidence.observe({time_from_seconds(1.3), odom * motion, {}}));
  EXPECT_LT(ring.cost(truth * motion), ring.cost(truth));
}

TEST(SonarEvidence, CostsAreBounded) {
  Ring ring{with_beams()};
  Rng rng{2};
  ring.ping({1.0, 0.8, {}}, {}, 1.0);
  ASSERT_TRUE(ring.evidence.observe({time_from_seconds(1.0), {}, {}}));
  for (int i = 0; i < 200; ++i) {
    const float cost =
        ring.cost({rng.uniform(-1.0, 7.0), rng.uniform(-1.0, 5.0), Angle::degrees(rng.uniform(-180, 180))});
    EXPECT_GE(cost, 0.0F);
    EXPECT_LE(cost, 2.0F);
  }
  EXPECT_LE(ring.evidence.mean_cost(), 2.0);
  EXPECT_GT(ring.evidence.mean_cost(), 0.0);
}

TEST(SonarEvidence, ReadingsWithoutNumberAreLeftOut) {
  Ring ring{with_beams()};
  ring.evidence.hear({time_from_seconds(1.0), 3, {}, {}, std::numeric_limits<double>::quiet_NaN(), kReach});
  EXPECT_FALSE(ring.evidence.observe({time_from_seconds(1.0), {}, {}}));
}

/// Drives through the room where the belief knows the place; what the sonars say from second 10 on has `fault`.
struct Drive {
  explicit Drive(const SonarEvidenceParams& params, std::uint64_t seed) : ring{params, seed} {}
  void run(Fault fault, int steps) {
    Pose2 truth{1.0, 0.8, Angle::degrees(20.0)};
    Pose2 odom;
    for (int i = 0; i < steps; ++i) {
      const bool is_free = ring.room.caster.clearance((truth * Pose2{0.25, 0.0, {}}).position()) > 0.35F;
      const Pose2 motion = is_free ? Pose2{0.1, 0.0, Angle::degrees(2.0)} : Pose2{0.0, 0.0, Angle::degrees(10.0)};
      truth = truth * motion;
      odom = odom * motion;
      time += 0.4;
      ring.ping(truth, odom, time, fault);
      const LikelyPose here{truth, 1.0};
      spoke = ring.evidence.observe({time_from_seconds(time), odom, {&here, 1}});
      used += ring.evidence.beams_used();
      filtered += ring.evidence.beams_filtered();
    }
  }
  Ring ring;
  double time = 0.0;
  bool spoke = false;
  std::size_t used = 0, filtered = 0;
};

TEST(SonarEvidence, WellSonarsAreBelieved) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Drive drive{with_beams(), seed};
    drive.run(Fault::none, 100);
    EXPECT_EQ(drive.ring.evidence.trust().state(), SonarTrust::State::well);
    EXPECT_GT(drive.ring.evidence.trust().agreement(), 0.6);
    EXPECT_GT(drive.used, 1000U);
  }
}

TEST(SonarEvidence, FrozenAndDeafSonarsHaveNothingToSayUntilTheyHear) {
  for (const auto& [fault, state] :
       {std::pair{Fault::frozen, SonarTrust::State::frozen}, std::pair{Fault::deaf, SonarTrust::State::at_odds},
        std::pair{Fault::near, SonarTrust::State::frozen}}) {
    Drive drive{with_beams(), 1};
    drive.run(Fault::none, 30);
    EXPECT_TRUE(drive.spoke);
    drive.run(fault, 30);
    EXPECT_FALSE(drive.spoke);
    EXPECT_EQ(drive.ring.evidence.trust().state(), state);
    drive.run(Fault::none, 40);
    EXPECT_TRUE(drive.spoke);
  }
}

TEST(SonarEvidence, TheFilterTakesOutEchoesOfOthers) {
  Drive well{with_beams(), 1};
  well.run(Fault::none, 50);
  Drive storm{with_beams(), 1};
  storm.run(Fault::storm, 50);
  EXPECT_LT(well.filtered, 50U * kSonars / 10);
  EXPECT_GT(storm.filtered, 50U * kSonars / 4);
}

TEST(SonarEvidence, ParametersAreChecked) {
  EXPECT_TRUE(SonarEvidenceParams{}.validate());
  SonarEvidenceParams params;
  params.filter = "magic";
  EXPECT_FALSE(params.validate());
  params = {};
  params.beams = -1;
  ASSERT_FALSE(params.validate());
  EXPECT_EQ(params.validate().error().message, "sonar.beams must be 0..180");
}

}  // namespace
}  // namespace docent::localization
