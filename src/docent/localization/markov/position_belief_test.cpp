#include "docent/localization/markov/position_belief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>

#include "docent/base/random.h"
#include "docent/localization/markov/testing.h"

namespace docent::localization {
namespace {

using testing::any_beams;
using testing::drawn_room;

double sum_of(const PositionBelief& belief) {
  const StateSpace& space = belief.space();
  double sum = 0.0;
  for (std::size_t place = 0; place < space.places(); ++place)
    for (int h = 0; h < space.headings(); ++h) sum += static_cast<double>(belief.probability(place, h));
  return sum;
}

/// The slow, obvious twin: eq. 2 and 4 in doubles, state by state, without a sea.
struct DenseTwin {
  const StateSpace& space;
  std::vector<double> p;

  explicit DenseTwin(const StateSpace& of) : space{of}, p(of.states(), 1.0 / static_cast<double>(of.states())) {}
  [[nodiscard]] std::size_t index(std::size_t place, int heading) const {
    return place * static_cast<std::size_t>(space.headings()) + static_cast<std::size_t>(heading);
  }
  void normalise() {
    double sum = 0.0;
    for (const double value : p) sum += value;
    for (double& value : p) value /= sum;
  }
  /// `cap`: at most so many cost steps for the beams of one of `sectors` together.
  void reweigh(const RangeTable& table, std::span<const BeamCosts> beams, std::size_t sectors = 1, double cap = 1e9) {
    for (std::size_t place = 0; place < space.places(); ++place) {
      for (int h = 0; h < space.headings(); ++h) {
        const auto headings = static_cast<std::size_t>(space.headings());
        std::vector<double> costs(sectors, 0.0);
        for (const BeamCosts& beam : beams)
          costs[beam.direction * sectors / headings] +=
              beam.costs[table.row(place)[(static_cast<std::size_t>(h) + beam.direction) % headings]];
        double cost = 0.0;
        for (const double of_sector : costs) cost += std::min(of_sector, cap);
        p[index(place, h)] *= std::exp(-cost / kCostPerNat);
      }
    }
    normalise();
  }
  void move(const MotionKernel& kernel) {
    std::vector<double> moved(p.size(), 0.0);
    const int width = 2 * kernel.reach() + 1;
    const int square = width * width;
    const std::vector<float> turns = kernel.heading_weights();
    for (std::size_t place = 0; place < space.places(); ++place) {
      const CellIndex cell = space.cell(place);
      for (int h = 0; h < space.headings(); ++h) {
        for (int i = 0; i < square; ++i) {
          const int column = i % width - kernel.reach();
          const int row = i / width - kernel.reach();
          const double weight = static_cast<double>(kernel.weight(column, row, h));
          const auto target = space.place_at({cell.column + column, cell.row + row});
          if (weight <= 0.0 || target == StateSpace::kNoPlace) continue;
          for (std::size_t k = 0; k < turns.size(); ++k) {
            const int blur = static_cast<int>(k) - static_cast<int>(turns.size() / 2);
            const int turned = ((h + blur) % space.headings() + space.headings()) % space.headings();
            moved[index(static_cast<std::size_t>(target), turned)] +=
                p[index(place, h)] * weight * static_cast<double>(turns[k]);
          }
        }
      }
    }
    p.swap(moved);
    normalise();
  }
};

double total_variation(const PositionBelief& belief, const DenseTwin& twin) {
  double sum = 0.0;
  for (std::size_t place = 0; place < belief.space().places(); ++place)
    for (int h = 0; h < belief.space().headings(); ++h)
      sum += std::abs(static_cast<double>(belief.probability(place, h)) - twin.p[twin.index(place, h)]);
  return 0.5 * sum;
}

TEST(PositionBelief, StartsUniformAndAwake) {
  const auto room = drawn_room();
  const PositionBelief belief{room->space, 0.001};
  EXPECT_EQ(belief.active_states(), room->space.states());
  EXPECT_NEAR(sum_of(belief), 1.0, 1e-4);
  EXPECT_NEAR(belief.entropy(), std::log(static_cast<double>(room->space.states())), 1e-4);
}

TEST(PositionBelief, WithoutASeaItIsTheTwin) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    const auto room = drawn_room();
    PositionBelief belief{room->space, 0.0};
    DenseTwin twin{room->space};
    for (int step = 0; step < 5; ++step) {
      const auto beams = any_beams(rng, 12, room->space.headings());
      belief.reweigh(room->table, beams, 0.0, {}, 0.0);
      twin.reweigh(room->table, beams);
      const Point2 moved{rng.uniform(-0.3, 0.3), rng.uniform(-0.1, 0.1)};
      const MotionKernel kernel = motion_kernel(room->space, {}, moved, {{0.002, 0.001}, 0.3, 0.2});
      belief.move(kernel);
      twin.move(kernel);
      EXPECT_LT(total_variation(belief, twin), 1e-4);
    }
  }
}

TEST(PositionBelief, TheBeamsOfASectorCostAtMostTheirCap) {
  Rng rng{7};
  const auto room = drawn_room();
  PositionBelief belief{room->space, 0.0};
  DenseTwin twin{room->space};
  DenseTwin without{room->space};
  const auto beams = any_beams(rng, 30, room->space.headings());
  EvidenceWeights weights;
  weights.sectors = 5;
  weights.most_sector_nats = 3.0;
  belief.reweigh(room->table, beams, 0.0, weights, 0.0);
  twin.reweigh(room->table, beams, 5, 3.0 * kCostPerNat);
  without.reweigh(room->table, beams);
  EXPECT_LT(total_variation(belief, twin), 1e-4);
  EXPECT_GT(total_variation(belief, without), 0.1);
}

TEST(PositionBelief, SelectiveUpdateStaysNearTheDenseOne) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    const auto room = drawn_room();
    PositionBelief belief{room->space, 0.001};
    DenseTwin twin{room->space};
    Pose2 truth{1.2, 1.0, Angle::degrees(40)};
    for (int step = 0; step < 8; ++step) {
      double best_over_mean = 0.0;
      const auto beams = testing::beams_at(*room, truth, 0.4, best_over_mean);
      belief.reweigh(room->table, beams, best_over_mean, {}, 0.0);
      twin.reweigh(room->table, beams);
      EXPECT_LT(total_variation(belief, twin), 0.01);  // active mass above 0.99
      EXPECT_GT(belief.active_mass(), 0.99);
      EXPECT_NEAR(sum_of(belief), 1.0, 1e-3);
      const Pose2 moved{0.08, 0.02, Angle{}};
      truth = truth * moved;
      const MotionKernel kernel = motion_kernel(room->space, {}, moved.position(), {{1e-4, 1e-4}, 0.08, 0.0});
      belief.move(kernel);
      twin.move(kernel);
    }
    EXPECT_LT(belief.active_states(), room->space.states() / 20);  // else this test shows nothing
  }
}

TEST(PositionBelief, TheSeaRisesOverTheThresholdAndAllWake) {
  const auto room = drawn_room();
  PositionBelief belief{room->space, 0.001};
  const Pose2 truth{1.2, 1.0, Angle::degrees(40)};
  for (int i = 0; i < 6; ++i) {
    double best_over_mean = 0.0;
    const auto beams = testing::beams_at(*room, truth, 0.4, best_over_mean);
    belief.reweigh(room->table, beams, best_over_mean, {}, 1e-7);
  }
  ASSERT_LT(belief.active_states(), room->space.states() / 20);
  const double low = belief.sea_level();
  const Pose2 elsewhere{4.6, 2.3, Angle::degrees(-120)};  // somebody carried the robot there
  double level = low;
  bool woke = false;
  int steps = 0;
  for (; steps < 12 && !woke; ++steps) {
    double best_over_mean = 0.0;
    const auto beams = testing::beams_at(*room, elsewhere, 0.4, best_over_mean);
    belief.reweigh(room->table, beams, best_over_mean, {}, 1e-7);
    woke = belief.active_states() == room->space.states();
    if (!woke) {
      EXPECT_GT(belief.sea_level(), level);
    }
    level = belief.sea_level();
  }
  EXPECT_TRUE(woke);
  for (int i = 0; i < 8; ++i) {
    double best_over_mean = 0.0;
    const auto beams = testing::beams_at(*room, elsewhere, 0.4, best_over_mean);
    belief.reweigh(room->table, beams, best_over_mean, {}, 1e-7);
  }
  const auto place = room->space.place_at(room->space.frame().cell_at(elsewhere.position()));
  ASSERT_NE(place, StateSpace::kNoPlace);
  const int heading = static_cast<int>(std::lround((elsewhere.theta.degrees() + 360.0) / 6.0)) % 60;
  EXPECT_GT(belief.probability(static_cast<std::size_t>(place), heading), 0.05F);
}

TEST(PositionBelief, MovesAPeakWhereTheRobotWent) {
  const auto room = drawn_room();
  PositionBelief belief{room->space, 0.001};
  const BeliefMode mode{{1.575, 1.575, Angle{}}, {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4}, 1.0};
  belief.make_modes(std::span{&mode, 1}, 1e-5);
  for (int i = 0; i < 3; ++i) belief.move(motion_kernel(room->space, {}, {0.3, 0.15}, {{1e-4, 1e-4}, 0.3, 0.0}));
  double x = 0.0;
  double y = 0.0;
  double mass = 0.0;
  for (std::size_t i = 0; i < belief.kept_places().size(); ++i) {
    const Point2 centre = room->space.centre(static_cast<std::size_t>(belief.kept_places()[i]));
    const auto row = belief.row(i);
    for (const std::size_t h : {58U, 59U, 0U, 1U, 2U}) {
      x += static_cast<double>(row[h]) * centre.x;
      y += static_cast<double>(row[h]) * centre.y;
      mass += static_cast<double>(row[h]);
    }
  }
  EXPECT_GT(mass, 0.9);
  EXPECT_NEAR(x / mass, 1.575 + 0.9, 0.03);
  EXPECT_NEAR(y / mass, 1.575 + 0.45, 0.03);
}

/// A drive with everything that reweighs differently: caps, focus, sea, teleport, odd shifts.
std::vector<PositionBelief> after_a_drive(const testing::Room& room, double threshold) {
  std::vector<PositionBelief> beliefs;
  for (const InstructionSet set : instruction_sets()) {
    PositionBelief belief{room.space, threshold};
    belief.use(set);
    Pose2 truth{1.2, 1.0, Angle::degrees(40)};
    for (int step = 0; step < 8; ++step) {
      double best_over_mean = 0.0;
      const auto beams = testing::beams_at(room, truth, 0.2, best_over_mean);
      EvidenceWeights weights;
      weights.sectors = 12;
      weights.most_sector_nats = step % 2 == 0 ? 1.0 : 20.0;
      weights.most_nats = weights.far_most_nats = 8.0;
      if (step > 3) {
        weights.focus = Neighbourhood{truth, 0.75, 0.45};
        weights.far_share = 0.3;
      }
      belief.reweigh(room.table, beams, best_over_mean, weights, 1e-7);
      const Pose2 moved{0.11, 0.02, Angle{}};
      truth = truth * moved;
      belief.move(motion_kernel(room.space, {}, moved.position(), {{1e-3, 1e-3}, 0.11, 0.05}));
      if (step == 5) belief.flood(0.2);
    }
    beliefs.push_back(std::move(belief));
  }
  return beliefs;
}

double mass_in(const PositionBelief& belief, const Neighbourhood& neighbourhood) {
  double mass = 0.0;
  for (std::size_t i = 0; i < belief.kept_places().size(); ++i) {
    if (!neighbourhood.holds(belief.space().centre(static_cast<std::size_t>(belief.kept_places()[i])))) continue;
    for (int h = 0; h < belief.space().headings(); ++h)
      if (neighbourhood.holds(Angle::radians(h * belief.space().heading_step())))
        mass += static_cast<double>(belief.row(i)[static_cast<std::size_t>(h)]);
  }
  return mass;
}

TEST(PositionBelief, GatheringMovesMassInsideTheNeighbourhoodAndNothingElse) {
  const testing::Room room{6.0};
  for (const double threshold : {0.0, 0.001}) {
    PositionBelief belief{room.space, threshold};
    const Pose2 found{1.2, 1.0, Angle::degrees(40)};
    const std::vector<BeliefMode> modes{{found, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}, 0.5},
                                        {{1.9, 1.0, Angle::degrees(40)}, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}, 0.4}};
    belief.make_modes(modes, 0.05);
    const Neighbourhood all{found, 1.2, 0.6};
    const double in_all = mass_in(belief, all);
    const double in_found = mass_in(belief, same_place(found));
    ASSERT_LT(in_found, 0.65 * in_all);
    belief.gather({all, same_place(found), 0.97, 3.0});
    EXPECT_NEAR(mass_in(belief, all), in_all, 2e-3);
    EXPECT_NEAR(mass_in(belief, same_place(found)), 0.97 * in_all, 5e-3);
    belief.gather({all, same_place(found), 0.5, 3.0});  // less sure than the belief: nothing changes
    EXPECT_NEAR(mass_in(belief, same_place(found)), 0.97 * in_all, 5e-3);
  }
}

TEST(PositionBelief, EveryInstructionSetGivesTheSameBeliefBitForBit) {
  for (const double heading_step : {6.0, 2.0}) {
    const testing::Room room{heading_step};
    for (const double threshold : {0.0, 0.001}) {
      const auto beliefs = after_a_drive(room, threshold);
      for (std::size_t i = 1; i < beliefs.size(); ++i) {
        SCOPED_TRACE(std::string{name_of(instruction_sets()[i])} + ' ' + std::to_string(threshold));
        ASSERT_EQ(beliefs[i].active_states(), beliefs[0].active_states());
        EXPECT_EQ(beliefs[i].peak(), beliefs[0].peak());
        EXPECT_EQ(beliefs[i].sea_level(), beliefs[0].sea_level());
        EXPECT_EQ(beliefs[i].entropy(), beliefs[0].entropy());
        for (std::size_t place = 0; place < room.space.places(); ++place)
          for (int h = 0; h < room.space.headings(); ++h)
            ASSERT_EQ(beliefs[i].probability(place, h), beliefs[0].probability(place, h)) << place << ' ' << h;
      }
      EXPECT_GT(beliefs[0].peak(), 100.0 / static_cast<double>(room.space.states()));  // else this test shows nothing
    }
  }
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    const auto sets = instruction_sets();
    if (std::find(sets.begin(), sets.end(), set) == sets.end())
      std::printf("[  NOT RUN ] %s: this processor has none\n", std::string{name_of(set)}.c_str());
  }
}

TEST(PositionBelief, EntropyIsThatOfTheProbabilities) {
  const testing::Room room;
  const auto beliefs = after_a_drive(room, 0.0);
  double entropy = 0.0;
  for (std::size_t place = 0; place < room.space.places(); ++place) {
    for (int h = 0; h < room.space.headings(); ++h) {
      const auto p = static_cast<double>(beliefs[0].probability(place, h));
      if (p > 0.0) entropy -= p * std::log(p);
    }
  }
  EXPECT_NEAR(beliefs[0].entropy(), entropy, 1e-5 * entropy);
}

/// Means and variances of where a heading's states go.
struct Spread {
  double mass = 0.0, mean_x = 0.0, mean_y = 0.0, variance_x = 0.0, variance_y = 0.0;
};
Spread spread_of(const MotionKernel& kernel, int heading) {
  Spread s;
  const int reach = kernel.reach();
  for (int pass = 0; pass < 2; ++pass)
    for (int row = -reach; row <= reach; ++row)
      for (int column = -reach; column <= reach; ++column) {
        const auto w = static_cast<double>(kernel.weight(column, row, heading));
        if (pass == 0) {
          s.mass += w;
          s.mean_x += w * column;
          s.mean_y += w * row;
        } else {
          s.variance_x += w * (column - s.mean_x) * (column - s.mean_x);
          s.variance_y += w * (row - s.mean_y) * (row - s.mean_y);
        }
      }
  return s;
}

TEST(MotionKernel, MovesEveryHeadingItsWayWithTheVarianceOfOdometry) {
  const auto room = drawn_room();
  const double cell = room->space.frame().resolution;
  motion_models::OdometryModelParams params;
  params.slip_probability = 0.0;
  for (const double variance : {0.006, 0.02, 0.05}) {  // [m2]; the least is more than bilinear shares blur: cell^2 / 4
    for (const Point2 shift : {Point2{0.0, 0.0}, Point2{0.15, 0.0}, Point2{0.4, -0.22}}) {
      const MotionKernel kernel = motion_kernel(room->space, params, shift, {{variance, 0.01}, 0.3, 0.0});
      for (int h = 0; h < room->space.headings(); ++h) {
        const Point2 moved = Pose2{0.0, 0.0, Angle::radians(h * room->space.heading_step())} * shift;
        const Spread s = spread_of(kernel, h);
        EXPECT_NEAR(s.mass, 1.0, 1e-4);
        EXPECT_NEAR(s.mean_x * cell, moved.x, 1e-4);
        EXPECT_NEAR(s.mean_y * cell, moved.y, 1e-4);
        EXPECT_NEAR(s.variance_x * cell * cell, variance, 0.06 * variance);  // a Gaussian is cut off at three sigma
        EXPECT_NEAR(s.variance_y * cell * cell, variance, 0.06 * variance);
      }
    }
  }
}

TEST(MotionKernel, ARobotThatSlipsMayBeACellFurther) {
  const auto room = drawn_room();
  motion_models::OdometryModelParams params;
  params.slip_probability = 0.1;
  const MotionKernel kernel = motion_kernel(room->space, params, {0.15, 0.0}, {{1e-6, 1e-6}, 0.25, 0.0});
  const double twice = static_cast<double>(kernel.weight(2, 0, 0));
  EXPECT_GT(twice, 0.01);
  EXPECT_LT(twice, 0.1);
  double turned = 0.0;
  for (const float weight : kernel.heading_weights()) turned += static_cast<double>(weight);
  EXPECT_NEAR(turned, 1.0, 1e-5);
  EXPECT_NEAR(spread_of(kernel, 0).mass, 1.0, 1e-5);
}

}  // namespace
}  // namespace docent::localization
