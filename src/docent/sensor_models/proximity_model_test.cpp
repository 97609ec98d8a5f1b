#include "docent/sensor_models/proximity_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace docent::sensor_models {
namespace {

TEST(ProximityModel, SumsToOneForEveryExpectedRange) {
  std::array<double, kExpectedRanges> frequency{};
  for (std::size_t i = 0; i < frequency.size(); ++i) frequency[i] = static_cast<double>(i % 7);
  for (const double max_range : {5.0, 10.0, 30.0}) {
    const ProximityModel model{{.max_range = max_range}, frequency};
    for (int expected = 0; expected < kExpectedRanges; ++expected) {
      double mixture = 0.0;
      double gaussian = 0.0;
      for (int measured = 0; measured < kRangeBins; ++measured) {
        EXPECT_GT(model.probability(measured, expected), 0.0);
        EXPECT_NEAR(std::exp(model.log_probabilities(measured)[static_cast<std::size_t>(expected)]),
                    model.probability(measured, expected), 1e-6);
        mixture += model.probability(measured, expected);
        gaussian += model.map_probability(measured, expected);
      }
      EXPECT_NEAR(mixture, 1.0, 1e-9) << expected;
      EXPECT_NEAR(gaussian, expected == kUnknownRange ? 0.0 : 1.0, 1e-9) << expected;
    }
  }
}

TEST(ProximityModel, NothingUpToARangeIsAllThatLiesBeyond) {
  const ProximityModel model{{}};
  EXPECT_EQ(model.nothing_up_to(10.0), kNoReturn);
  EXPECT_EQ(model.nothing_up_to(80.0), kNoReturn);
  const int nothing = model.nothing_up_to(4.0);
  ASSERT_GE(nothing, kRangeBins);
  for (const double wall : {1.0, 3.0, 5.0, 8.0}) {
    const int expected = model.bin(wall);
    double beyond = 0.0;
    for (int measured = model.bin(4.0); measured < kRangeBins; ++measured)
      beyond += model.probability(measured, expected);
    EXPECT_NEAR(std::exp(model.log_probabilities(nothing)[static_cast<std::size_t>(expected)]), beyond, 1e-6);
  }
  // A scanner of 4 m does not contradict a wall at 5 m, one of 10 m does.
  const auto of = [&](int measured, double wall) {
    return model.log_probabilities(measured)[static_cast<std::size_t>(model.bin(wall))];
  };
  EXPECT_GT(of(nothing, 5.0), std::log(0.4F));
  EXPECT_LT(of(nothing, 3.0), std::log(0.3F));
  EXPECT_LT(of(kNoReturn, 5.0), std::log(0.2F));
  for (const float shorter : model.shorter_probabilities(nothing)) EXPECT_EQ(shorter, 0.0F);
  EXPECT_LT(model.log_mean_probability(nothing), 0.0);
}

TEST(ProximityModel, HasTheShapeOfItsParts) {
  const ProximityModelParams params{.weight_near = 0.0};
  const ProximityModel model{params};
  const int expected = model.bin(5.0);
  const double sum = params.weight_hit + params.weight_short + params.weight_no_return + params.weight_random;
  const auto density = [&model](int measured, double probability) {
    return probability / (model.lower_edge(measured + 1) - model.lower_edge(measured));
  };
  // Far behind the wall only the uniform part is left.
  const double rest = params.weight_random / sum * (1.0 - 1.0 / kRangeBins) / params.max_range;
  for (const double range : {6.0, 8.0, 9.9}) {
    const int bin = model.bin(range);
    EXPECT_NEAR(density(bin, model.probability(bin, expected)), rest, 1e-5);
  }
  // No return has the Dirac on top.
  EXPECT_NEAR(model.probability(kNoReturn, expected),
              (params.weight_no_return + params.weight_random / kRangeBins) / sum, 1e-9);
  // In front of the wall the density falls by exp(-rate) a metre.
  for (const double range : {0.5, 1.0, 2.5}) {
    const int near = model.bin(range);
    const int far = near + 10;
    const double ratio = (density(far, model.probability(far, expected)) - rest) /
                         (density(near, model.probability(near, expected)) - rest);
    EXPECT_NEAR(std::log(ratio), -params.short_per_metre * (model.centre(far) - model.centre(near)), 1e-3);
  }
  // The peak stands at the wall.
  for (int measured = 0; measured < kNoReturn; ++measured)
    EXPECT_LE(density(measured, model.probability(measured, expected)),
              density(expected, model.probability(expected, expected)));
}

TEST(ProximityModel, HeavyTailsStandAboutTheWall) {
  const ProximityModelParams without{.weight_near = 0.0};
  const ProximityModel light{without};
  const ProximityModel heavy{{}};
  const int expected = heavy.bin(5.0);
  // A reading that lies three deviations off tells far less against the place.
  for (const double off : {-3.0, 3.0}) {
    const int bin = heavy.bin(5.0 + off * heavy.sigma(expected));
    const auto against = [&](const ProximityModel& model) {
      return std::log(model.probability(expected, expected) / model.probability(bin, expected));
    };
    EXPECT_LT(against(heavy), 0.8 * against(light)) << off;
    EXPECT_GT(against(heavy), 0.5);
  }
}

TEST(ProximityModel, ShorterIsTheTailOfTheGaussianAlone) {
  const ProximityModel model{{}};
  const int expected = model.bin(2.3);
  EXPECT_GT(model.shorter_probability(model.bin(1.9), expected), 0.99F);
  EXPECT_NEAR(model.shorter_probability(expected, expected), 0.5, 0.15);
  EXPECT_LT(model.shorter_probability(model.bin(2.7), expected), 0.01F);
  double tail = 0.0;
  for (int j = expected + 1; j < kRangeBins; ++j) tail += model.map_probability(j, expected);
  EXPECT_NEAR(model.shorter_probability(expected, expected), tail, 1e-6);
  EXPECT_EQ(model.shorter_probability(0, kUnknownRange), 0.0F);
  EXPECT_EQ(model.shorter_probability(kNoReturn, kNoReturn), 0.0F);
  EXPECT_EQ(model.shorter_probability(model.bin(3.0), kNoReturn), 1.0F);
}

TEST(ProximityModel, MeanIsTheMeanUnderTheGivenFrequencies) {
  std::array<double, kExpectedRanges> frequency{};
  frequency[10] = 3.0;
  frequency[50] = 1.0;
  frequency[kUnknownRange] = 100.0;  // says nothing, so it counts for nothing
  const ProximityModel model{{}, frequency};
  for (const int measured : {0, 9, 10, 50, kNoReturn}) {
    const double mean = 0.75 * model.probability(measured, 10) + 0.25 * model.probability(measured, 50);
    EXPECT_NEAR(model.log_mean_probability(measured), std::log(mean), 1e-12);
  }
  // Where the map is silent something stands anywhere: the same density at every range.
  const auto density = [&model](int bin) {
    return model.probability(bin, kUnknownRange) / (model.lower_edge(bin + 1) - model.lower_edge(bin));
  };
  EXPECT_NEAR(density(10), density(100), 1e-12);
}

/// What `of` says, in weights that sum to 3; where the map is silent, all bins alike.
class Likewise final : public ReadingDistribution {
 public:
  explicit Likewise(const ProximityModel& of) : of_{of} {}
  void fill(const RangeBins& bins, int expected, std::span<double> out) const override {
    EXPECT_EQ(out.size(), static_cast<std::size_t>(kRangeBins));
    EXPECT_EQ(bins.max_range(), 10.0);
    for (int i = 0; i < kRangeBins; ++i)
      out[static_cast<std::size_t>(i)] = expected == kUnknownRange ? 1.0 : 3.0 * of_.probability(i, expected);
  }

 private:
  const ProximityModel& of_;
};

TEST(ProximityModel, ADistributionOfOnesOwnReplacesTheMixtureAndNotTheGaussian) {
  const ProximityModel other{{.sigma = 0.4, .weight_random = 0.2}};
  const ProximityModel built_in{{}};
  const Likewise likewise{other};
  const ProximityModel model{{}, {}, &likewise};
  double mean = 0.0;
  for (int expected = 0; expected < kRangeBins; ++expected) {
    EXPECT_NEAR(model.probability(40, expected), other.probability(40, expected), 1e-12);
    EXPECT_EQ(model.map_probability(40, expected), built_in.map_probability(40, expected));
    EXPECT_EQ(model.shorter_probability(40, expected), built_in.shorter_probability(40, expected));
    mean += model.probability(40, expected) / kRangeBins;
  }
  EXPECT_NE(model.probability(40, 40), built_in.probability(40, 40));
  EXPECT_NEAR(model.log_mean_probability(40), std::log(mean), 1e-12);
  EXPECT_NEAR(model.probability(3, kUnknownRange), 1.0 / kRangeBins, 1e-12);
  EXPECT_EQ(model.log_probabilities(40)[50], static_cast<float>(std::log(model.probability(40, 50))));
}

TEST(ProximityModel, BinsCoverAllRanges) {
  const ProximityModel model{{}};
  EXPECT_EQ(model.bin(0.0), 0);
  EXPECT_EQ(model.bin(9.999999), kNoReturn - 1);
  EXPECT_EQ(model.bin(10.0), kNoReturn);
  EXPECT_EQ(model.bin(81.9), kNoReturn);
  for (int bin = 0; bin < kRangeBins; ++bin) EXPECT_EQ(model.bin(model.centre(bin)), bin);
}

TEST(ProximityModel, RefusesWhatCannotBe) {
  EXPECT_FALSE(ProximityModelParams{.max_range = 0.0}.validate().has_value());
  EXPECT_FALSE(ProximityModelParams{.sigma = std::nan("")}.validate().has_value());
  EXPECT_FALSE(ProximityModelParams{.weight_random = 0.0}.validate().has_value());
  EXPECT_TRUE(ProximityModelParams{}.validate().has_value());
}

}  // namespace
}  // namespace docent::sensor_models
