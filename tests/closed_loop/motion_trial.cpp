// Prints what the motion modules do in a museum: motion_trial MUSEUM CROWD SEED MINUTES [SCENARIO.yaml | error=METRES |
// section.key=value …]
#include <cstdio>
#include <cstdlib>

#include "motion_loop.h"

int main(int argc, char** argv) {
  using docent::MotionLoop;
  if (argc < 5) {
    std::fprintf(stderr, "usage: motion_trial MUSEUM CROWD SEED MINUTES [section.key=value ...]\n");
    return 2;
  }
  MotionLoop::Options options;
  options.museum = argv[1];
  options.crowd = argv[2];
  options.seed = std::strtoull(argv[3], nullptr, 10);
  for (int i = 5; i < argc; ++i) options.settings.emplace_back(argv[i]);
  MotionLoop loop{options};
  loop.run(60.0 * std::atof(argv[4]));
  const auto& outcome = loop.outcome();
  std::printf(
      "seed %s: %.0f s, %.0f m, mean %.2f m/s (top %.2f), arrived %d, given up %d, horns %d, longest stand %.0f s, "
      "outside %.1f s, avoid %.1f ms/s, hazards %.1f ms/s\n",
      argv[3], outcome.seconds, outcome.distance, outcome.distance / outcome.goal_seconds, outcome.top_speed,
      outcome.arrived, outcome.given_up, outcome.horns, outcome.longest_standstill, outcome.seconds_outside,
      outcome.avoid_cost_ms, outcome.hazards_cost_ms);
  for (const auto& [kind, count] : outcome.contacts) std::printf("  contact %s: %d\n", kind.c_str(), count);
  for (const auto& [reason, seconds] : outcome.standing) {
    if (seconds > 5.0) std::printf("  standing %.0f s: %s\n", seconds, reason.c_str());
  }
  for (const auto& line : outcome.log) std::printf("  %s\n", line.c_str());
  return 0;
}
