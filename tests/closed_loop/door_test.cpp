#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "docent/apps/shared/temporary_folder.h"
#include "docent/apps/simulate/simulation_run.h"
#include "docent/museum/museum.h"
#include "docent/simulator/museum_folder/museum_folder.h"

// Doors in walls at angles: what the check of a museum calls passable (grid/clearance) the robot drives through, with
// the map of a survey and the belief of its localizer. Planner and avoidance ask different things of a door.

namespace docent {
namespace {

constexpr double kLength = 10.0, kWidth = 8.0;  // [m] of the hall
constexpr double kThickness = 0.15;             // [m] of walls

struct Door {
  simulator::SolidKind wall = simulator::SolidKind::wall;  ///< or glass, which no laser sees
  double clear = 1.1;                                      ///< [m] wide
  double angle = 0.0;                                      ///< [deg] of the wall from the y axis
};

/// A hall in two parts with a door in the wall through its middle. A stop and home on one side, a stop on the other.
simulator::MuseumPlan hall_with(const Door& door) {
  const Point2 middle{0.5 * kLength, 0.5 * kWidth};
  const Point2 along = unit(Angle::degrees(90.0 + door.angle));
  const Point2 across = unit(Angle::degrees(door.angle));
  simulator::MuseumPlan plan;
  plan.title = "A hall with a door";
  plan.made_of = "drawn by a test";
  plan.topic = "doors";
  simulator::World& world = plan.world;
  const auto box = [](double x0, double y0, double x1, double y1) {
    return Polygon{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  };
  const auto wall = [&](const std::string& id, Polygon polygon,
                        simulator::SolidKind kind = simulator::SolidKind::wall) {
    world.solids.push_back({id, kind, std::move(polygon)});
  };
  world.floor = box(0.0, 0.0, kLength, kWidth);
  world.operating_area = box(0.25, 0.25, kLength - 0.25, kWidth - 0.25);
  wall("south", box(-0.2, -0.2, kLength + 0.2, 0.0));
  wall("north", box(-0.2, kWidth, kLength + 0.2, kWidth + 0.2));
  wall("west", box(-0.2, 0.0, 0.0, kWidth));
  wall("east", box(kLength, 0.0, kLength + 0.2, kWidth));
  wall("corner", box(0.0, kWidth - 0.9, 1.4, kWidth));  // or the hall would look the same after half a turn
  for (const double side : {1.0, -1.0}) {
    // To the hall's outer wall.
    const double end = side > 0.0 ? (kWidth - middle.y) / along.y : middle.y / along.y;
    const Point2 from = middle + (side * 0.5 * door.clear) * along, to = middle + (side * end) * along;
    const Point2 half = (0.5 * kThickness) * across;
    Polygon piece{from - half, from + half, to + half, to - half};
    if (side < 0.0) std::reverse(piece.begin(), piece.end());
    wall(side > 0.0 ? "left" : "right", std::move(piece), door.wall);
  }
  for (const double side : {-1.0, 1.0}) {
    const std::string id = side < 0.0 ? "here" : "there";
    const Point2 place = middle + (side * 2.2) * across;
    const Pose2 pose{place.x, place.y, Angle::degrees(side < 0.0 ? door.angle + 180.0 : door.angle)};
    const Point2 look_at = pose * Point2{0.8, 0.0};
    plan.stops.push_back({id, pose, look_at, {}, {}});
    world.exhibits.push_back(id);
    world.attractions.push_back({id, look_at, 1.0, 1.0});
    world.entrances.push_back(place);
  }
  world.tours = {"round"};
  plan.home = plan.stops.front().pose;
  world.home = plan.home.position();
  return plan;
}

struct Drive {
  bool is_passable = false;  ///< the check of the museum says so
  int crossings = 0;         ///< of the door
  double metres = 0.0;
  double blocked = 0.0;  ///< [s]
  nlohmann::json report;
  std::string reasons;  ///< why it stood
};

/// How often the robot went from one side to the other, by the truth.
void read_drive(const std::filesystem::path& log, const Door& door, Drive& drive) {
  std::ifstream file{log};
  std::string line;
  std::getline(file, line);
  const Point2 middle{0.5 * kLength, 0.5 * kWidth};
  const Point2 across = unit(Angle::degrees(door.angle));
  double side = 0.0;
  std::map<std::string, int> reasons;
  while (std::getline(file, line)) {
    std::vector<std::string> cells;
    std::stringstream stream{line};
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    const double off = dot(Point2{std::stod(cells.at(1)), std::stod(cells.at(2))} - middle, across);
    if (std::abs(off) > 0.5) {  // beyond the door with its whole body
      drive.crossings += side * off < 0.0 ? 1 : 0;
      side = off;
    }
    drive.metres = std::stod(cells.at(6));
    if (std::abs(std::stod(cells.at(4))) < 0.02 && cells.size() > 14) ++reasons[cells[12] + ": " + cells[14]];
  }
  for (const auto& [reason, count] : reasons) drive.reasons += reason + " for " + std::to_string(count / 10) + " s; ";
}

/// To the other side and, as nobody wants anything more, home again: the whole robot, which finds its place by itself.
Drive drive(const Door& door, std::uint64_t seed) {
  const apps::TemporaryFolder folder;
  const auto plan = hall_with(door);
  const auto written = write_museum(plan, survey(plan.world, {}, Rng{seed}.stream("survey")), folder.path() / "hall");
  EXPECT_TRUE(written) << written.error().message;
  Drive drive;
  const auto faults = museum::check_museum(folder.path() / "hall");
  for (const Error& fault : faults)
    EXPECT_NE(fault.message.find("cannot be reached from home"), std::string::npos) << fault.message;
  drive.is_passable = faults.empty();
  if (!drive.is_passable) return drive;
  std::ofstream{folder.path() / "scenario.yaml"}
      << "events:\n  - {at: 5, request: {kind: exhibit, target: there, language: en}}\n";
  apps::simulate_command::SimulationRunOptions options;
  options.museum = folder.path() / "hall";
  options.seed = seed;
  options.crowd = "empty";
  options.requests_per_hour = 0.0;
  options.start = plan.home;
  options.scenario = folder.path() / "scenario.yaml";
  options.drive_log = folder.path() / "drive.csv";
  const auto run = apps::simulate_command::SimulationRun::create(options);
  EXPECT_TRUE(run.has_value()) << (run ? "" : run.error().message);
  if (!run) return drive;
  EXPECT_TRUE((*run)->run_until(time_from_seconds(80.0)));
  EXPECT_TRUE((*run)->finish());
  drive.report = nlohmann::json::parse((*run)->report_json());
  drive.blocked = drive.report.at("blocked").at("seconds").get<double>();
  read_drive(options.drive_log, door, drive);
  return drive;
}

struct Tally {
  int passable = 0, closed = 0;  ///< so the check says
  double metres = 0.0;
};

/// Two surveys and beliefs of each door.
void drive_through(const Door& door, Tally& tally) {
  for (const std::uint64_t seed : {1U, 2U}) {
    SCOPED_TRACE(std::to_string(door.clear) + " m at " + std::to_string(door.angle) + " degrees, seed " +
                 std::to_string(seed));
    const Drive trial = drive(door, seed);
    ++(trial.is_passable ? tally.passable : tally.closed);
    if (!trial.is_passable) continue;
    EXPECT_GE(trial.crossings, 2) << "there and back: " << trial.reasons;
    EXPECT_LT(trial.blocked, 10.0) << trial.reasons;
    for (const char* kind : {"people", "furniture", "walls", "hazards"})
      EXPECT_EQ(trial.report.at("contacts").at(kind).get<int>(), 0) << kind;
    EXPECT_EQ(trial.report.at("area_violations").get<int>(), 0);
    tally.metres += trial.metres;
  }
}

Tally drive_through(simulator::SolidKind wall, const std::vector<double>& widths) {
  Tally tally;
  for (const double clear : widths)
    for (const double angle : {0.0, 15.0, 30.0, 45.0}) drive_through({wall, clear, angle}, tally);
  std::cout << tally.passable << " doors passable, " << tally.closed << " called closed; " << tally.metres
            << " m driven\n";
  return tally;
}

TEST(Doors, OneOf110CentimetresIsPassableAtEveryAngle) {
  const Tally tally = drive_through(simulator::SolidKind::wall, {1.1});
  EXPECT_EQ(tally.closed, 0);
}

TEST(Doors, NarrowOnesThatTheCheckCallsPassableAreDrivenThrough) {
  const Tally tally = drive_through(simulator::SolidKind::wall, {0.95, 0.85, 0.75});
  EXPECT_GT(tally.passable, 8);
  EXPECT_GT(tally.closed, 0) << "or none was narrow enough to ask";
}

TEST(Doors, BetweenGlassWhichOnlyTheBeliefKeepsOffTheyAreDrivenThrough) {
  const Tally tally = drive_through(simulator::SolidKind::glass, {1.4, 1.3, 1.2, 1.1});
  EXPECT_GT(tally.passable, 8);
  EXPECT_GT(tally.closed, 0) << "or none was narrow enough to ask";
}

}  // namespace
}  // namespace docent
