#include "docent/localization/monte_carlo/monte_carlo_localizer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "docent/localization/monte_carlo/testing.h"

namespace docent::localization {
namespace {

using testing::Drive;
using testing::is_right;

LocalizerParams shared_params() {
  LocalizerParams params;
  params.states.heading_step = 4.0;
  return params;
}

class MonteCarlo : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] std::unique_ptr<MonteCarloLocalizer> localizer(std::uint64_t seed) const {
    MonteCarloParams params;
    params.model = GetParam();
    return std::make_unique<MonteCarloLocalizer>(testing::room_map(), shared_params(), params, RangeTableCache{}, seed);
  }
};
INSTANTIATE_TEST_SUITE_P(Models, MonteCarlo, ::testing::Values("beam", "field"),
                         [](const auto& of) { return std::string{of.param}; });

TEST_P(MonteCarlo, TracksAmongPeople) {
  double error = 0.0;
  int updates = 0;
  int lost = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const auto at = localizer(seed);
    Drive drive{at->caster(), seed, 0.4};
    const BeliefMode mode{drive.truth(), {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}, 1.0};
    at->start_at(std::span{&mode, 1}, drive.odom(), drive.time());
    for (int i = 0; i < 400; ++i) {
      drive.advance();
      if (!at->observe(drive.sweep(), drive.odom(), drive.time()).updated) continue;
      const auto found = at->map_from_robot(drive.odom());
      ++updates;
      lost += is_right(found, drive.truth()) ? 0 : 1;
      if (found) error += distance(found->position(), drive.truth().position());
    }
    EXPECT_TRUE(at->verdict().localized());
    EXPECT_LT(at->particles().size(), 3000U);  // tracking needs few
  }
  EXPECT_GT(updates, 400);
  EXPECT_LE(lost, updates / 100);
  EXPECT_LT(error / updates, 0.06);
}

TEST_P(MonteCarlo, FindsItselfAndSaysSoOnlyWhenRight) {
  int found = 0;
  int wrong = 0;
  constexpr int kTrials = 12;
  for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
    const auto at = localizer(seed);
    EXPECT_FALSE(at->verdict().localized());
    EXPECT_TRUE(at->summary().modes.empty());
    Drive drive{at->caster(), 100 + seed, 0.2};
    for (int i = 0; i < 120; ++i) {
      if (i > 0) drive.advance();
      at->observe(drive.sweep(), drive.odom(), drive.time());
      if (!at->verdict().localized()) continue;
      wrong += is_right(at->map_from_robot(drive.odom()), drive.truth()) ? 0 : 1;
    }
    found += at->verdict().localized() ? 1 : 0;
  }
  EXPECT_GE(found, kTrials - 1);
  EXPECT_LE(wrong, kTrials);  // scans
}

TEST_P(MonteCarlo, RecoversWhenSomebodyCarriedItAway) {
  int recovered = 0;
  constexpr int kTrials = 8;
  for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
    const auto at = localizer(seed);
    Drive drive{at->caster(), 200 + seed, 0.2};
    const BeliefMode mode{drive.truth(), {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}, 1.0};
    at->start_at(std::span{&mode, 1}, drive.odom(), drive.time());
    for (int i = 0; i < 60; ++i) {
      drive.advance();
      at->observe(drive.sweep(), drive.odom(), drive.time());
    }
    EXPECT_TRUE(is_right(at->map_from_robot(drive.odom()), drive.truth())) << seed;
    drive.kidnap();
    bool back = false;
    for (int i = 0; i < 250 && !back; ++i) {
      drive.advance();
      at->observe(drive.sweep(), drive.odom(), drive.time());
      back = at->verdict().localized() && is_right(at->map_from_robot(drive.odom()), drive.truth());
    }
    recovered += back ? 1 : 0;
  }
  EXPECT_GE(recovered, kTrials - 1);
}

TEST_P(MonteCarlo, ASeedGivesTheSameRunWithEveryInstructionSet) {
  const auto run = [this](FieldKernel field, InstructionSet grid) {
    const auto at = localizer(3);
    at->use_kernels(field, grid);
    Drive drive{at->caster(), 9, 0.3};
    for (int i = 0; i < 60; ++i) {
      drive.advance();
      at->observe(drive.sweep(), drive.odom(), drive.time());
    }
    const ParticleSet& particles = at->particles();
    return std::tuple{particles.x, particles.y, particles.heading_x, particles.weight};
  };
  const auto plain = run(field_kernels().front().kernel, instruction_sets().front());
  EXPECT_EQ(plain, run(field_kernels().back().kernel, instruction_sets().back()));
  EXPECT_FALSE(std::get<0>(plain).empty());
}

TEST_P(MonteCarlo, PublishesABeliefThatSumsToOne) {
  const auto at = localizer(5);
  Drive drive{at->caster(), 5, 0.2};
  const auto check = [&] {
    const BeliefSummary& summary = at->summary();
    double mass = 0.0;
    for (const auto& cell : summary.cells) mass += static_cast<double>(cell.mass);
    for (const float value : summary.rest) mass += static_cast<double>(value);
    EXPECT_NEAR(mass, 1.0, 1e-3);
    EXPECT_LE(summary.cells.size(), 8192U);
    const PositionDensity density = at->density();
    EXPECT_NEAR(std::accumulate(density.mass.begin(), density.mass.end(), 0.0), 1.0, 1e-2);
  };
  check();
  const double unknown = at->summary().entropy;
  for (int i = 0; i < 80; ++i) {
    drive.advance();
    if (at->observe(drive.sweep(), drive.odom(), drive.time()).updated) check();
  }
  EXPECT_LT(at->summary().entropy, 0.6 * unknown);
}

TEST(MonteCarloParams, NamesWhatIsWrong) {
  MonteCarloParams params;
  EXPECT_TRUE(params.validate().has_value());
  params.model = "sonar";
  EXPECT_EQ(params.validate().error().message, "particles.model must be beam or field, not 'sonar'");
  params = {};
  params.kld.error = 0.0;
  EXPECT_EQ(params.validate().error().message, "particles.kld.error must be > 0");
}

TEST(MonteCarloLocalizer, ASmallComputerGetsFewerParticlesAndWaits) {
  LocalizerParams shared = shared_params();
  shared.work_per_second = 2e5;
  MonteCarloLocalizer at{testing::room_map(), shared, {}, {}, 1};
  Drive drive{at.caster(), 2, 0.0};
  int updates = 0;
  std::size_t most = 0;
  for (int i = 0; i < 200; ++i) {
    drive.advance();
    updates += at.observe(drive.sweep(), drive.odom(), drive.time()).updated ? 1 : 0;
    if (updates > 1) most = std::max(most, at.particles().size());
  }
  EXPECT_GT(updates, 3);
  EXPECT_LE(most, 2000U);
}

TEST(MonteCarloLocalizer, ASurroundedRobotFindsItselfByWhatItSeesBetweenPeople) {
  const OccupancyGrid map = testing::room_map();
  const sensor_models::RayCaster caster{map};
  const testing::LookingRound seen = testing::look_round(caster, 6, [&](std::uint64_t seed) {
    LocalizerParams shared;
    shared.states.heading_step = 3.0;
    return std::make_unique<MonteCarloLocalizer>(map, shared, MonteCarloParams{}, RangeTableCache{}, seed);
  });
  EXPECT_GE(seen.likeliest, 5);
  EXPECT_GE(seen.sure, 3);
  EXPECT_EQ(seen.wrong, 0);
}

}  // namespace
}  // namespace docent::localization
