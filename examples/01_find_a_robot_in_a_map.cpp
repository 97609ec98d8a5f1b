// A robot wakes up somewhere in a museum. All that it has is a map, a laser and the odometry of its wheels. Markov
// localization [Fox, Burgard, Thrun 1999] keeps a probability for each of some million poses; each scan multiplies in
// how likely it is there, each motion moves and blurs them all. Soon one place is left.
#include <docent/localization/markov/markov_localizer.h>

#include <string>

#include "simulated_robot.h"

int main(int argc, char** argv) {
  const std::string museum = example::argument_or_exit(argc, argv, "MUSEUM", DOCENT_MUSEUM);
  const docent::OccupancyGrid map = example::value_or_exit(docent::load_map(museum + "/map.yaml"));
  example::SimulatedRobot robot{map, {9.0, 3.6, docent::Angle::degrees(90.0)}, 7};

  docent::localization::LocalizerParams params;
  params.states.heading_step = 4.0;  // [deg]; half as many states as by default
  docent::localization::MarkovLocalizer localizer{map, params, {}, 1};
  localizer.start_unknown();
  std::printf("%zu poses are possible\n", localizer.space().states());

  // Offer every scan; the localizer takes those that say something new. `verdict` is its own judgement: only when one
  // place has held nearly all the mass over some motion does it say "here".
  int scans = 0;
  for (; scans < 400 && !localizer.verdict().localized(); ++scans) {
    robot.step();
    const auto step = localizer.observe(robot.look(), robot.odom_from_robot, docent::time_from_seconds(robot.time));
    if (!step.updated || localizer.summary().modes.empty()) continue;
    const auto& best = localizer.summary().modes.front();
    std::printf("%5.1f m driven: %5.1f %% at (%5.2f, %5.2f), P(lost) %.3f\n", robot.way, 100.0 * best.mass,
                best.map_from_robot.x, best.map_from_robot.y, localizer.verdict().p_lost());
  }

  const auto found = localizer.map_from_robot(robot.odom_from_robot);
  const double error = found ? docent::distance(found->position(), robot.map_from_robot.position()) : 1e3;
  const bool is_right = localizer.verdict().localized() && error < 0.15;
  std::printf("After %d scans the robot says %s, %.1f cm from where it is\n", scans,
              localizer.verdict().localized() ? "\"here\"" : "\"I do not know\"", 100.0 * error);
  return is_right ? 0 : 1;
}
