#include "docent/localization/belief/observation_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "docent/localization/markov/markov_localizer.h"
#include "docent/localization/markov/testing.h"
#include "docent/localization/monte_carlo/monte_carlo_localizer.h"

// A third sensor: neither localizer was written for it, and neither knows it.

namespace docent::localization {
namespace {

/// Looks the same after half a turn: no range finder can tell its two ends apart.
OccupancyGrid symmetric_hall() {
  OccupancyGrid map;
  map.frame = {140, 90, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  const auto fill = [&map](int left, int bottom, int right, int top) {
    for (int row = bottom; row < top; ++row)
      for (int column = left; column < right; ++column) {
        map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
        map.cells[map.frame.index({139 - column, 89 - row})] = OccupancyGrid::kOccupied;
      }
  };
  fill(0, 0, 140, 2), fill(0, 0, 2, 90);
  fill(20, 0, 26, 14);
  fill(2, 60, 10, 68);
  return map;
}

/// A camera that looks up: bright under the skylight at one end, darker towards the other.
double brightness(Point2 in_map) { return std::exp(-0.3 * in_map.x); }

class CeilingCamera final : public ObservationModel {
 public:
  void see(double value) { value_ = value, is_new_ = true; }
  bool observe(const ObservationMoment&) override { return std::exchange(is_new_, false); }
  void add_costs(std::span<const Pose2> map_from_robot, std::span<float> nats) const override {
    for (std::size_t i = 0; i < nats.size(); ++i) {
      const double off = (brightness(map_from_robot[i].position()) - value_) / kDeviation;
      nats[i] += static_cast<float>(std::min(kMost, 0.5 * off * off));
    }
  }
  [[nodiscard]] double mean_cost() const override { return 0.5 * kMost; }

 private:
  static constexpr double kDeviation = 0.1;
  static constexpr double kMost = 1.0;
  double value_ = 0.0;
  bool is_new_ = false;
};

struct Halves {
  double right = 0.0;   ///< mass near the truth
  double turned = 0.0;  ///< near the place that looks the same
};

/// Drives in a circle about the middle, and tells what is believed in the end.
Halves drive(Localizer& localizer, const std::shared_ptr<CeilingCamera>& camera, std::uint64_t seed) {
  const OccupancyGrid map = symmetric_hall();
  const sensor_models::RayCaster caster{map};
  Rng rng{seed};
  const Pose2 middle{3.5, 2.25, Angle::degrees(rng.uniform(-180.0, 180.0))};
  Pose2 truth = middle * Pose2{1.3, 0.0, Angle::degrees(90.0)};
  Pose2 odom;
  for (int i = 0; i < 160; ++i) {
    const Pose2 step{0.1, 0.0, Angle::degrees(0.1 / 1.3 * 57.2958)};
    truth = truth * step;
    odom = odom * step;
    sensor_models::RangeSweep sweep = testing::sweep_at(caster, truth, 10.0);
    for (sensor_models::SweepBeam& beam : sweep.beams) beam.range = std::max(0.05, beam.range + rng.normal(0.0, 0.02));
    if (camera) camera->see(brightness(truth.position()) + rng.normal(0.0, 0.05));
    localizer.observe(sweep, odom, time_from_seconds(0.2 * (i + 1)));
  }
  Halves halves;
  const Pose2 turned{7.0 - truth.x, 4.5 - truth.y, truth.theta + Angle::degrees(180.0)};
  for (const auto& cell : localizer.summary().cells) {
    const Point2 at{static_cast<double>(cell.x), static_cast<double>(cell.y)};
    if (distance(at, truth.position()) < 0.5) halves.right += static_cast<double>(cell.mass);
    if (distance(at, turned.position()) < 0.5) halves.turned += static_cast<double>(cell.mass);
  }
  return halves;
}

std::unique_ptr<Localizer> localizer_of(const std::string& method) {
  LocalizerParams params;
  params.states.heading_step = 3.0;
  if (method == "grid") return std::make_unique<MarkovLocalizer>(symmetric_hall(), params, RangeTableCache{}, 1);
  return std::make_unique<MonteCarloLocalizer>(symmetric_hall(), params, MonteCarloParams{}, RangeTableCache{}, 1);
}

class ThirdSensor : public ::testing::TestWithParam<const char*> {};

TEST_P(ThirdSensor, TellsApartWhatLasersCannot) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto lasers = localizer_of(GetParam());
    const Halves by_lasers = drive(*lasers, nullptr, seed);
    EXPECT_GT(by_lasers.turned, 0.1) << "seed " << seed << ": this hall can be told apart, the test shows nothing";
    EXPECT_LT(by_lasers.right, 0.9) << "seed " << seed;

    const auto both = localizer_of(GetParam());
    const auto camera = std::make_shared<CeilingCamera>();
    both->add_sensor(camera);
    const Halves with_camera = drive(*both, camera, seed);
    EXPECT_GT(with_camera.right, 0.97) << "seed " << seed;
    EXPECT_LT(with_camera.turned, 0.02) << "seed " << seed;
  }
}

TEST_P(ThirdSensor, ThatHasNothingToSayChangesNothing) {
  const auto lasers = localizer_of(GetParam());
  const auto both = localizer_of(GetParam());
  both->add_sensor(std::make_shared<CeilingCamera>());  // never sees
  const Halves alone = drive(*lasers, nullptr, 7);
  const Halves with_silent = drive(*both, nullptr, 7);
  EXPECT_EQ(alone.right, with_silent.right);
  EXPECT_EQ(alone.turned, with_silent.turned);
}

INSTANTIATE_TEST_SUITE_P(Methods, ThirdSensor, ::testing::Values("grid", "particles"),
                         [](const auto& tested) { return std::string{tested.param}; });

}  // namespace
}  // namespace docent::localization
