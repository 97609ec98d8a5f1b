// Of every component of the library one name that only its archive has. Built by check_library.sh, outside the source
// tree.
#include <cstdio>

#include "docent/base/random.h"
#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/localization/localizer/localizer_params.h"
#include "docent/mapping/graph_mapping/graph_mapping.h"
#include "docent/motion_models/odometry_model.h"
#include "docent/museum/museum.h"
#include "docent/people/people_tracker.h"
#include "docent/planning/value_iteration/value_iteration.h"
#include "docent/recording/carmen_log.h"
#include "docent/task_control/golog/golog_program.h"
#include "docent/transport/virtual_time_bus.h"

namespace {

int failed = 0;

void expect(const char* component, bool holds) {
  if (!holds) ++failed;
  std::printf("%s: %s\n", component, holds ? "ok" : "FAILED");
}

}  // namespace

int main() {
  using namespace docent;
  Rng rng{7};
  const double drawn = rng.uniform();
  expect("core", drawn >= 0.0 && drawn < 1.0);
  const auto metre = motion_models::motion_noise({}, {1.0, 0.0, {}});
  expect("models", metre.position_variance > 0.0);
  const auto hours = museum::parse_hours("09:30-17:00");
  expect("museum", hours && hours->holds(600) && !museum::parse_hours("later"));
  expect("localization", localization::LocalizerParams{}.validate().has_value());
  mapping::GraphMapping mapping{{}};
  expect("mapping", mapping.map_from_base().empty());
  const planning::ValueIteration values{GridFrame{.columns = 4, .rows = 3}};
  expect("planning", values.value({1, 1}) == planning::ValueIteration::kClosed);
  const auto moved = collision_avoidance::advance({{}, {0.5, 0.0}}, {0.5, 0.0}, {}, 1.0);
  expect("avoidance", moved.odom_from_base.x > 0.4 && moved.odom_from_base.x < 0.6);
  people::PeopleTracker tracker{{}};
  tracker.predict(time_from_seconds(1.0));
  expect("people", tracker.places().empty());
  expect("tours", !task_control::GologProgram::faults("/nowhere/tour.pl", {}).empty());
  transport::VirtualTimeHub hub;
  int calls = 0;
  const auto bus = hub.connect("one");
  bus->every(seconds(1.0), [&calls] { ++calls; });
  hub.run_until(time_from_seconds(3.5));
  expect("bus", calls == 3);
  expect("recording", recording::parse_carmen_log("", "an empty log").has_value() == false);
  return failed == 0 ? 0 : 1;
}
