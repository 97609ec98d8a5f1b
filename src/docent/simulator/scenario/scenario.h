#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/simulator/scenario/build_errors.h"
#include "docent/simulator/scenario/charger_event.h"
#include "docent/simulator/scenario/eye_event.h"
#include "docent/simulator/scenario/office_event.h"
#include "docent/simulator/scenario/transport_event.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::simulator {

/// Someone carries the robot to another place; its wheels do not turn. Without a place: a random free one.
struct Kidnap {
  std::optional<Pose2> to;    ///< world_from_base
  double from_hazards = 0.0;  ///< [m] a random place keeps from hazards
  double near_hazards = 0.0;  ///< [m] > 0: a random place whose outline is at most so far from a hazard
  double shift = 0.0;         ///< [m] > 0: a random place at most so far from here, the robot turned by `turn`
  double turn = 0.0;          ///< [deg]
  double keeps_speed = 0.0;   ///< share of its speed that it keeps, as if nobody's hands had held it: 1 is the hardest
};
enum class Sensor { laser_front, laser_rear, laser_left, laser_right, sonar, odom, tactile, infrared };
inline constexpr std::size_t kSensors = 8;
/// As files call them.
inline constexpr std::array<const char*, kSensors> kSensorNames{
    "laser_front", "laser_rear", "laser_left", "laser_right", "sonar", "odom", "tactile", "infrared"};
enum class FaultKind {
  dead,    ///< no message at all
  frozen,  ///< the last reading again and again, with fresh stamps
  half,    ///< half of the readings invalid (NaN, tactile 255); odometry: every second message is missing
  late,    ///< messages arrive `delay` seconds after their stamp
  near,    ///< every reading is 0.3 m; "short" in a file. The last three are of lasers and sonars only
  deaf,    ///< nothing comes back: every reading is the largest
  storm,   ///< echoes of others: every reading is the true one or anything shorter, half and half
};
struct SensorFault {
  Sensor sensor = Sensor::laser_front;
  FaultKind kind = FaultKind::dead;
  double duration = 0.0;  ///< [s]; 0: to the end
  double delay = 0.5;     ///< [s] for `late`
};
/// What a scanner that works and is wrong says.
enum class Lie {
  units,       ///< every reading `amount` times as far, range_max as it was; by default 1000: millimetres
  silent,      ///< +infinity, all round
  sector,      ///< +infinity over `amount` degrees round `bearing`; by default 60
  too_near,    ///< +infinity for what is nearer than `amount` metres; by default 0.6, and range_min says so
  blind_near,  ///< the same, and range_min does not say so
  offset,      ///< every reading `amount` metres farther; by default 0.5
  scaled,      ///< every reading `amount` times as far, range_max as well; by default 2
  stale,       ///< sweeps of `amount` seconds ago, with fresh stamps; by default 1
  looped       ///< the sweeps of the last `amount` seconds again and again, with fresh stamps; by default 3
};
struct ScannerLie {
  Sensor sensor = Sensor::laser_front;  ///< a laser
  Lie lie = Lie::units;
  std::optional<double> amount{};
  double bearing = 0.0;   ///< [rad] sensor frame, of a sector's middle
  double duration = 0.0;  ///< [s]; 0: to the end
};
/// A small piece of furniture stands there for a while.
struct Stool {
  Point2 at{};
  double radius = 0.2;    ///< [m]
  double height = 0.45;   ///< [m]
  double bottom = 0.0;    ///< [m] < height; above 0 it hangs, as a table's top does, and no sensor but an eye meets it
  double duration = 0.0;  ///< [s]; 0: to the end
};
/// A barrier between two points.
struct ClosedPassage {
  Point2 from{};
  Point2 to{};
  double duration = 0.0;  ///< [s]; 0: to the end
};
/// The best pose of the belief is published so far off while its cells stay true: carried out by `docent simulate`.
struct PoseError {
  double x = 0.0, y = 0.0;  ///< [m], map, added
  double heading = 0.0;     ///< [rad], added
  double duration = 0.0;    ///< [s]; 0: to the end
};
/// The belief gets a second, equally heavy mode, which moves along with the first one: carried out by
/// `docent simulate`.
struct SecondMode {
  Pose2 at;               ///< map_from_robot of the second mode, when it appears
  double duration = 0.0;  ///< [s]; 0: to the end
};
/// The odometry makes a step that the base does not.
struct OdometryJump {
  Pose2 by;           ///< base_from_base
  double over = 0.0;  ///< [s] in equal steps, as wheels slip; 0: in one reading
};
enum class Formation { gather, wall, ushape };
struct Visitors {
  int count = 1;
  std::optional<Point2> at;  ///< without: before the robot; for ushape: round it
  Formation formation = Formation::gather;
  double heading = 0.0;  ///< [rad] the direction that the wall or the open side of the U faces
  bool has_heading = false;
  double duration = 60.0;       ///< [s] they stand there
  std::optional<double> heeds;  ///< 0..1 chance that one steps aside at a blast of the horn; without: as the crowd's
};
/// People who wait at a place until the robot comes by and then press it in one direction, in a close half ring.
struct Pushers {
  int count = 1;
  Point2 at{};
  double heading = 0.0;   ///< [rad] the direction they press in
  double duration = 0.0;  ///< [s]; 0: to the end
};
/// Children who run about round a place and heed nothing.
struct Runners {
  int count = 1;
  Point2 at{};
  double within = 4.0;    ///< [m] of the place
  double duration = 0.0;  ///< [s]; 0: to the end
};
/// People who walk along with the robot all round it, but not before it.
struct Escort {
  int count = 1;
  double near = 0.4, far = 1.6;  ///< [m] between the outlines
  double duration = 0.0;         ///< [s]; 0: to the end
};
/// Someone walks the robot through the museum by hand: its own commands do nothing meanwhile.
struct Steering {
  double speed = 0.5;       ///< [m/s]
  double duration = 0.0;    ///< [s]; 0: to the end
  std::vector<Point2> way;  ///< along these points, there to stand; empty: from one random place to the next
};
/// From now on all lasers are of a kind that does not look so far.
struct LaserReach {
  double range = 10.0;  ///< [m]
};
struct Wish {
  std::string kind = "exhibit";  ///< exhibit or tour
  std::string target;
  int viewpoint = -1;  ///< of the exhibit; -1: from anywhere
  std::string language = "en";
  std::string source;  ///< who asks: visitor, kiosk, web, staff; empty: as the run's other visitors
};
/// From now on visitors answer what the robot asks them with these chances; else nobody answers.
struct Answers {
  double more = 0.0;  ///< 0..1: "more" or "yes"
  double next = 0.0;  ///< 0..1: "next" or "no"; both together at most 1
};
/// The battery is changed for one with this charge.
struct BatteryChange {
  double charge = 1.0;  ///< 0..1
};
/// A signal to a module: carried out by the application.
struct Kill {
  std::string module;
  std::string signal = "kill";  ///< kill or stop
  double duration = 10.0;       ///< [s] for stop: until it continues
};

/// What an event of a scenario waits for, once its time has come: that the robot says to be in a phase, and has said so
/// for a while.
struct Moment {
  MissionPhase phase = MissionPhase::driving;
  double after = 0.0;  ///< [s] since the phase began
};

struct ScenarioEvent {
  double at = 0.0;  ///< [s] since the start: not before
  std::variant<Kidnap, SensorFault, Stool, ClosedPassage, PoseError, Visitors, Pushers, Runners, Escort, Steering,
               LaserReach, Wish, Answers, BatteryChange, Kill, SecondMode, OdometryJump, ScannerLie, Transport,
               ChargerFault, EyeFault, OfficeEvent>
      what;
  std::optional<Moment> during{};  ///< without: at its time
};

/// Timed events over a run (architecture 10.2), by rising time; equal times keep the file's order. An event that waits
/// for a moment holds up none of the others.
struct Scenario {
  std::vector<ScenarioEvent> events;
  BuildErrors build;  ///< of the whole run
};

/// Reads `build:` (see read_build_errors), which may be left out, and `events:`, a list of `{at: SECONDS, KIND: {...}}`
/// with KIND one of kidnap, fault, stool, closed, pose_error, visitors, pushers, runners, escort, steering, lasers,
/// request, answers, battery, kill, second_mode, odometry_jump, lie, transport, charger, eye, office.
/// With `during: PHASE` it waits for that
/// phase of the mission, with `after: SECONDS` until the phase has lasted so long. Error: "FILE:LINE: ...".
[[nodiscard]] Result<Scenario> load_scenario(const std::filesystem::path& path);
[[nodiscard]] Result<Scenario> parse_scenario(const std::string& text, const std::string& name);

}  // namespace docent::simulator
