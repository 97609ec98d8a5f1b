#include "docent/mapping/sonar_network/sonar_network.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "docent/mapping/sonar_network/cone_model.h"

namespace docent::mapping {
namespace {

/// A world in which a place is occupied if it lies beyond the closest reading, with so many labels wrong.
std::vector<SonarExample> drawn_examples(std::uint64_t seed, std::size_t count, double wrong) {
  Rng rng{seed};
  std::vector<SonarExample> examples;
  for (std::size_t i = 0; i < count; ++i) {
    SonarExample example;
    example.cell.range = rng.uniform(0.0, 3.0);
    example.cell.off_axis = rng.uniform();
    for (double& reading : example.cell.readings) reading = rng.uniform(0.2, 4.0);
    example.is_occupied = (example.cell.range > example.cell.readings[0]) != rng.chance(wrong);
    examples.push_back(example);
  }
  return examples;
}

double entropy_on(const SonarNetwork& network, const std::vector<SonarExample>& examples) {
  std::vector<SonarCell> cells;
  std::vector<bool> labels;
  for (const SonarExample& example : examples) {
    cells.push_back(example.cell);
    labels.push_back(example.is_occupied);
  }
  return cross_entropy(network.probabilities(cells), labels);
}

TEST(SonarNetwork, LearnsWhatCanBeKnownAndNoMore) {
  const auto network = SonarNetwork::trained(drawn_examples(1, 20000, 0.1), {}, {}, Rng{1});
  const double entropy = entropy_on(network, drawn_examples(2, 5000, 0.1));
  const double noise = -0.9 * std::log(0.9) - 0.1 * std::log(0.1);
  EXPECT_GT(entropy, noise - 0.02);
  EXPECT_LT(entropy, noise + 0.05);
}

TEST(SonarNetwork, IsCalibrated) {
  const auto network = SonarNetwork::trained(drawn_examples(3, 20000, 0.2), {}, {}, Rng{1});
  double said[5] = {};
  double were[5] = {};
  double count[5] = {};
  for (const SonarExample& example : drawn_examples(4, 20000, 0.2)) {
    const double p = network.probability(example.cell);
    const auto bin = std::min<std::size_t>(4, static_cast<std::size_t>(5.0 * p));
    said[bin] += p;
    were[bin] += example.is_occupied ? 1.0 : 0.0;
    count[bin] += 1.0;
  }
  for (std::size_t bin = 0; bin < 5; ++bin) {
    if (count[bin] < 200) continue;
    EXPECT_NEAR(said[bin] / count[bin], were[bin] / count[bin], 0.05) << "bin " << bin;
  }
}

TEST(SonarNetwork, TheSameSeedGivesTheSameNetwork) {
  const auto examples = drawn_examples(5, 2000, 0.1);
  SonarTrainingParams params;
  params.epochs = 2;
  const auto first = SonarNetwork::trained(examples, {}, params, Rng{7});
  const auto second = SonarNetwork::trained(examples, {}, params, Rng{7});
  const auto other = SonarNetwork::trained(examples, {}, params, Rng{8});
  EXPECT_EQ(first.probability(examples[0].cell), second.probability(examples[0].cell));
  EXPECT_NE(first.probability(examples[0].cell), other.probability(examples[0].cell));
}

TEST(SonarNetwork, IsReadBackAsItWasWritten) {
  const auto file = std::filesystem::temp_directory_path() / "docent-sonar-network-test.json";
  const auto examples = drawn_examples(6, 2000, 0.1);
  SonarTrainingParams params;
  params.epochs = 2;
  const auto network = SonarNetwork::trained(examples, {12, 0.3, 4.0, 0.3}, params, Rng{7});
  ASSERT_TRUE(network.save(file));
  const auto loaded = SonarNetwork::load(file);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->ring().count, 12);
  EXPECT_EQ(loaded->prior(), network.prior());
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_NEAR(loaded->probability(examples[i].cell), network.probability(examples[i].cell), 1e-6);
  }
  for (const char* text : {"{", "{}", "{\"format\": \"docent sonar network 1\"}", "[1, 2]"}) {
    std::ofstream{file} << text;
    const auto fault = SonarNetwork::load(file);
    ASSERT_FALSE(fault) << text;
    EXPECT_NE(fault.error().message.find(file.string()), std::string::npos);
  }
  std::filesystem::remove(file);
  EXPECT_FALSE(SonarNetwork::load(file));
}

TEST(SonarCell, IsMirroredSoThatTheSecondClosestLiesToTheLeft) {
  const SonarRingGeometry ring;
  SonarView view;
  for (int i = 0; i < ring.count; ++i) view.ranges.push_back(1.0 + 0.1 * i);
  const Angle step = ring.bearing(1);
  const SonarCell left = sonar_cell(ring, view, 2.0 * unit(Angle::radians(4.3 * step.radians())));
  EXPECT_NEAR(left.range, 1.75, 1e-9);
  EXPECT_NEAR(left.off_axis, 0.6, 1e-9);
  EXPECT_EQ(left.readings, (std::array<double, 4>{view.ranges[4], view.ranges[5], view.ranges[3], view.ranges[6]}));
  const SonarCell right = sonar_cell(ring, view, 2.0 * unit(Angle::radians(3.7 * step.radians())));
  EXPECT_NEAR(right.off_axis, 0.6, 1e-9);
  EXPECT_EQ(right.readings, (std::array<double, 4>{view.ranges[4], view.ranges[3], view.ranges[5], view.ranges[2]}));
  const SonarCell behind = sonar_cell(ring, view, {-1.0, -0.01});
  EXPECT_EQ(behind.readings[0], view.ranges[12]);
}

TEST(ConeModel, IsFreeBeforeTheEchoOccupiedAtItAndUnknownBeyond) {
  const SonarRingGeometry ring;
  SonarView view{std::vector<double>(24, 5.0)};
  view.ranges[0] = 2.0;
  const ConeModelParams params;
  EXPECT_NEAR(probability_by_cones(params, ring, view, {1.0, 0.0}), params.free, 1e-9);
  EXPECT_NEAR(probability_by_cones(params, ring, view, {2.25, 0.0}), params.echo, 1e-9);
  EXPECT_NEAR(probability_by_cones(params, ring, view, {3.0, 0.0}), params.unknown, 1e-9);
}

TEST(RocArea, IsTheChanceToRankAPairRightly) {
  EXPECT_EQ(roc_area(std::vector<double>{0.1, 0.2, 0.8, 0.9}, {false, false, true, true}), 1.0);
  EXPECT_EQ(roc_area(std::vector<double>{0.9, 0.8, 0.2, 0.1}, {false, false, true, true}), 0.0);
  EXPECT_EQ(roc_area(std::vector<double>{0.5, 0.5, 0.5, 0.5}, {false, true, false, true}), 0.5);
  EXPECT_EQ(roc_area(std::vector<double>{0.1, 0.4, 0.3, 0.9}, {false, false, true, true}), 0.75);
}

TEST(CrossEntropy, IsThatOfACoin) {
  EXPECT_NEAR(cross_entropy(std::vector<double>{0.5, 0.5}, {false, true}), std::log(2.0), 1e-12);
  EXPECT_NEAR(cross_entropy(std::vector<double>{0.0}, {true}), -std::log(1e-4), 1e-12) << "kept from 0";
}

}  // namespace
}  // namespace docent::mapping
