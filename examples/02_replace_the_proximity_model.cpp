// The localizer asks one question of a sensor: how probable is a reading where the map lets expect another one? Its
// answer is a mixture with ten parameters; yours may be any distribution. Here a cheap laser measures the phase of its
// light, which comes round every six metres: a wall at 7.5 m reads 1.5 m. The built-in model takes such readings for
// people who stand before the wall, and finds the robot all the same; a model that knows the laser learns from them.
#include <docent/localization/markov/markov_localizer.h>

#include <cmath>
#include <string>

#include "simulated_robot.h"

namespace {
using namespace docent::sensor_models;
constexpr double kRound = 6.0;  // [m]

/// A bell about what this laser reads, and a floor for all else. Asked when tables are made: it may be slow.
class ComesRound final : public ReadingDistribution {
  void fill(const RangeBins& bins, int expected, std::span<double> out) const override {
    for (int bin = 0; bin < kRangeBins; ++bin) {
      double density = 0.05;  // where the map does not say, all that there is: kUnknownRange
      if (expected < kRangeBins) {
        const double off = bins.centre(bin) - std::fmod(bins.centre(expected), kRound);
        density += std::exp(-0.5 * off * off / (0.2 * 0.2));  // 20 cm: also half a cell of the belief
      }
      out[static_cast<std::size_t>(bin)] = density * (bins.lower_edge(bin + 1) - bins.lower_edge(bin));
    }
  }
};

/// Drives ten metres from an unknown start. @returns mean ln P(reading) [nat] once the robot says "here", where it is
double fit_of(const char* name, const docent::OccupancyGrid& map, std::shared_ptr<const ReadingDistribution> own) {
  docent::localization::LocalizerParams params;
  params.states.heading_step = 4.0;
  params.filter = "none";              // leaves no reading out for being too short
  params.own_sensor = std::move(own);  // null: the built-in mixture
  docent::localization::MarkovLocalizer localizer{map, params, {}, 1};
  example::SimulatedRobot robot{map, {9.0, 3.6, docent::Angle::degrees(90.0)}, 7};
  double fit = 0.0, updates = 0.0, error = 10.0;
  while (robot.way < 10.0) {
    robot.step();
    RangeSweep sweep = robot.look();
    for (SweepBeam& beam : sweep.beams) beam = {beam.bearing, std::fmod(beam.range, kRound), false};
    const auto step = localizer.observe(sweep, robot.odom_from_robot, docent::time_from_seconds(robot.time));
    const auto found = localizer.map_from_robot(robot.odom_from_robot);
    if (found) error = docent::distance(found->position(), robot.map_from_robot.position());
    if (step.fit && localizer.verdict().localized() && error < 0.15) fit += *step.fit, ++updates;
  }
  std::printf("%-9s%3.0f updates at the right place, in the end %.1f cm off\n", name, updates, 100.0 * error);
  return updates > 0.0 ? fit / updates : -99.0;
}
}  // namespace

int main(int argc, char** argv) {
  const std::string museum = example::argument_or_exit(argc, argv, "MUSEUM", DOCENT_MUSEUM);
  const docent::OccupancyGrid map = example::value_or_exit(docent::load_map(museum + "/map.yaml"));
  const double built_in = fit_of("built-in:", map, nullptr), own = fit_of("own:", map, std::make_shared<ComesRound>());
  std::printf("The own model holds a reading %.1f times as probable as the built-in one\n", std::exp(own - built_in));
  return own > built_in + 0.5 ? 0 : 1;
}
