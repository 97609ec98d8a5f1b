#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "docent/apps/laboratory/ablations/crippled_robot.h"
#include "docent/apps/shared/temporary_folder.h"
#include "docent/apps/simulate/simulation_run.h"
#include "docent/base/files.h"

// A robot on the border of its area, or up to 10 cm beyond, with people shoulder to shoulder in its way inside: it
// stands before them, asks, and drives inside when they have gone.

namespace docent {
namespace {

constexpr double kCome = 6.0;    // [s] when the people do: it still turns to find its place
constexpr double kLeave = 60.0;  // [s]
constexpr double kEnd = 80.0;    // [s]
constexpr double kAlong = 10.0;  // [m] the border runs along x there

/// Museum Bonn with the border of its south side at `border` [m]. Its own is at 0.9 m, where no robot fits between it
/// and the wall.
std::string bonn_with_border(const std::filesystem::path& folder, double border) {
  const auto museum = folder / "bonn";
  std::filesystem::copy(std::string{DOCENT_SOURCES} + "/museums/bonn", museum,
                        std::filesystem::copy_options::recursive);
  std::string text = read_file(museum / "museum.yaml").value();
  const std::string own = "[4.7, 0.9], [16.3, 0.9]";
  const auto at = text.find(own);
  EXPECT_NE(at, std::string::npos);
  std::ostringstream other;
  other << "[4.7, " << border << "], [16.3, " << border << "]";
  text.replace(at, own.size(), other.str());
  EXPECT_TRUE(write_file_atomically(museum / "museum.yaml", text));
  return museum.string();
}

struct Case {
  double border = 0.9;    ///< [m]
  double inside = 0.05;   ///< [m] of it stands the robot's centre; negative: beyond
  double heading = 90.0;  ///< [deg]; 90 looks inside
};

struct Outcome {
  nlohmann::json report;
  int horns = 0, asked = 0;    ///< while they stood there
  double least_inside = 1e9;   ///< [m] from when they came
  double most_outside = 0.0;   ///< [m/s] while beyond the border
  double nearest = 1e9;        ///< [m] to a person
  double stood = 0.0;          ///< [s] before them
  double inside_at_end = 0.0;  ///< [m]
  double driven_after = 0.0;   ///< [m] since they left
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream{line};
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

void read_events(const std::filesystem::path& log, Outcome& outcome) {
  std::ifstream events{log};
  for (std::string line; std::getline(events, line);) {
    const auto cells = cells_of(line);
    if (cells.front() == "time" || std::stod(cells.front()) > kLeave) continue;
    outcome.horns += cells[1] == "reaction" && cells[2] == "horn" ? 1 : 0;
    outcome.asked += cells[2] == "asked_for_way" ? 1 : 0;
  }
}

/// @param border  [m] along y
void read_drive(const std::filesystem::path& log, double border, Outcome& outcome) {
  std::ifstream drive{log};
  std::string line;
  std::getline(drive, line);
  const auto names = cells_of(line);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::size_t at_y = column("y"), at_speed = column("speed"), at_way = column("distance"),
                    at_person = column("nearest_person");
  double before = 0.0, last_time = kCome;
  while (std::getline(drive, line)) {
    const auto cells = cells_of(line);
    const double time = std::stod(cells.front());
    if (time < kCome + 0.5) continue;
    const double inside = std::stod(cells[at_y]) - border;
    const double speed = std::abs(std::stod(cells[at_speed]));
    outcome.least_inside = std::min(outcome.least_inside, inside);
    outcome.nearest = std::min(outcome.nearest, std::stod(cells[at_person]));
    if (inside < 0.0) outcome.most_outside = std::max(outcome.most_outside, speed);
    if (time < kLeave) {
      outcome.stood += speed < 0.02 ? time - last_time : 0.0;
      before = std::stod(cells[at_way]);
    }
    last_time = time;
    outcome.inside_at_end = inside;
    outcome.driven_after = std::stod(cells[at_way]) - before;
  }
}

Outcome run(const Case& how, std::uint64_t seed, const std::vector<std::string>& settings = {}) {
  const apps::TemporaryFolder folder;
  const double y = how.border + how.inside;
  std::ofstream{folder.path() / "scenario.yaml"}
      << "events:\n"
      << "  - {at: 0.5, kidnap: {to: [" << kAlong << ", " << y << "], heading: " << how.heading << "}}\n"
      << "  - {at: " << kCome << ", visitors: {count: 9, at: [" << kAlong << ", " << y + 0.75
      << "], formation: wall, heading: 270, heeds: 0.0, for: " << kLeave - kCome << "}}\n"
      << "  - {at: 3, request: {kind: exhibit, target: cyclotron, language: en}}\n";
  apps::simulate_command::SimulationRunOptions options;
  options.museum = bonn_with_border(folder.path(), how.border);
  options.seed = seed;
  options.crowd = "empty";
  options.requests_per_hour = 0.0;
  options.settings = settings;
  options.robot_maker = std::make_shared<apps::ablations::CrippledRobot>();
  options.start = Pose2{kAlong, how.border + 0.2, Angle::degrees(how.heading)};  // from where it is carried
  options.scenario = folder.path() / "scenario.yaml";
  options.event_log = folder.path() / "events.csv";
  options.drive_log = folder.path() / "drive.csv";
  const auto simulation = apps::simulate_command::SimulationRun::create(options);
  EXPECT_TRUE(simulation.has_value()) << (simulation ? "" : simulation.error().message);
  if (!simulation) return {};
  EXPECT_TRUE((*simulation)->run_until(time_from_seconds(kEnd)));
  EXPECT_TRUE((*simulation)->finish());

  Outcome outcome;
  outcome.report = nlohmann::json::parse((*simulation)->report_json());
  read_events(options.event_log, outcome);
  read_drive(options.drive_log, how.border, outcome);
  return outcome;
}

TEST(Border, PeopleInTheWayInsideAreAskedAndNotTouched) {
  double stood = 0.0, nearest = 1e9;
  int runs = 0, asked = 0;
  // From the border itself in all directions, from inside and outside of it towards the people and along it in turn.
  const std::vector<double> all{90.0, 0.0, -90.0}, ahead{90.0}, along{0.0};
  for (const auto& [border, inside, headings] :
       {std::tuple{0.9, 0.05, ahead}, {1.3, 0.03, along}, {1.3, 0.0, all}, {1.3, -0.05, along}, {1.3, -0.1, ahead}}) {
    for (const double heading : headings) {
      ++runs;
      SCOPED_TRACE(std::to_string(inside) + " m inside, heading " + std::to_string(heading));
      const Outcome outcome = run({border, inside, heading}, static_cast<std::uint64_t>(runs));
      ASSERT_FALSE(outcome.report.is_null());
      for (const char* kind : {"people", "furniture", "walls", "hazards"})
        EXPECT_EQ(outcome.report.at("contacts").at(kind).get<int>(), 0) << kind;
      EXPECT_EQ(outcome.report.at("area_violations").get<int>(), 0);
      EXPECT_GE(outcome.horns, 2);
      EXPECT_GE(outcome.asked, 2);
      EXPECT_GT(outcome.stood, 30.0);
      EXPECT_GT(outcome.nearest, 0.02);
      EXPECT_GT(outcome.least_inside, inside - 0.03) << "it never goes out farther";
      EXPECT_LT(outcome.most_outside, 0.3) << "half of its speed";
      EXPECT_GT(outcome.inside_at_end, 0.3);
      EXPECT_GT(outcome.driven_after, 5.0);
      stood += outcome.stood;
      nearest = std::min(nearest, outcome.nearest);
      asked += outcome.asked;
    }
  }
  std::cout << runs << " runs, " << stood << " s before people, nearest " << nearest << " m, asked " << asked
            << " times\n";
  EXPECT_GT(stood, 280.0);
}

TEST(Border, ARobotWithoutTheLadderAsksNobody) {
  const Outcome outcome = run({1.3, -0.05, 90.0}, 1, {"evaluation.without_ladder=true"});
  EXPECT_GT(outcome.stood, 30.0);
  EXPECT_EQ(outcome.asked, 0);
  EXPECT_EQ(outcome.horns, 0);
}

}  // namespace
}  // namespace docent
