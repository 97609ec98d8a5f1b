#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "docent/apps/simulate/simulation_run.h"

// The sonars die while the robot is on its way through a crowd, which preceded RHINO's error of 30 cm. It must not be
// lost, touch nothing, and say which sensor it is where that can be known.

namespace docent {
namespace {

constexpr double kDies = 110.0;  // [s]
constexpr double kEnd = 170.0;   // [s]

using Row = std::vector<std::string>;

std::vector<Row> read_csv(const std::filesystem::path& path) {
  std::vector<Row> rows;
  std::ifstream file{path};
  std::string line;
  while (std::getline(file, line)) {
    Row row;
    std::stringstream cells{line};
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// A table with named columns.
class Table {
 public:
  explicit Table(const std::filesystem::path& path) : rows_{read_csv(path)} {}
  [[nodiscard]] std::size_t size() const { return rows_.empty() ? 0 : rows_.size() - 1; }
  [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const {
    static const std::string none;
    const Row& names = rows_.front();
    const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin());
    const Row& cells = rows_[row + 1];
    return at < cells.size() ? cells[at] : none;
  }
  [[nodiscard]] double number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }

 private:
  std::vector<Row> rows_;
};

struct Outcome {
  bool knew = false;  ///< where it was, when the sonars died
  int updates = 0;    ///< afterwards
  int unsure = 0;
  double worst = 0.0;          ///< [m]
  double most_speed = 0.0;     ///< [m/s] from 2 s after
  double driven_before = 0.0;  ///< [m]
  double named_after = 1e9;    ///< [s] until a module named the sonars
  bool named_before = false;   ///< although they were well
  double touched = 0.0;        ///< contacts and area violations
};

Outcome strike(const std::string& kind, const std::string& museum, std::uint64_t seed,
               const std::vector<std::string>& settings) {
  const auto folder = std::filesystem::path{::testing::TempDir()} / ("sonar_dies_" + kind + std::to_string(seed));
  std::filesystem::create_directories(folder);
  std::ofstream{folder / "scenario.yaml"}
      << "events:\n  - {at: 5, request: {kind: tour, target: highlights, language: en}}\n"
      << "  - {at: " << kDies << ", fault: {sensor: sonar, kind: " << kind << "}}\n";
  apps::simulate_command::SimulationRunOptions options;
  options.museum = std::string{DOCENT_SOURCES} + "/museums/" + museum;
  options.seed = seed;
  options.crowd = "busy";
  options.settings = settings;
  options.scenario = folder / "scenario.yaml";
  options.claims = folder / "claims.csv";
  options.health_log = folder / "health.csv";
  auto run = apps::simulate_command::SimulationRun::create(options);
  EXPECT_TRUE(run.has_value()) << (run ? "" : run.error().message);
  if (!run) return {};
  EXPECT_TRUE((*run)->run_until(time_from_seconds(kEnd)));
  EXPECT_TRUE((*run)->finish());

  Outcome outcome;
  const Table claims{options.claims};
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const double time = claims.number(i, "time");
    const bool localized = claims.number(i, "localized") > 0.0;
    outcome.touched = claims.number(i, "contacts") + claims.number(i, "violations");
    if (time < kDies) {
      outcome.knew = localized;
      outcome.driven_before = claims.number(i, "distance");
      continue;
    }
    ++outcome.updates;
    outcome.unsure += localized ? 0 : 1;
    outcome.worst = std::max(outcome.worst, std::hypot(claims.number(i, "x") - claims.number(i, "true_x"),
                                                       claims.number(i, "y") - claims.number(i, "true_y")));
    if (time > kDies + 2.0) outcome.most_speed = std::max(outcome.most_speed, std::abs(claims.number(i, "speed")));
  }
  const Table health{options.health_log};
  for (std::size_t i = 0; i < health.size(); ++i) {
    if (health.text(i, "reason").find("sonar") == std::string::npos) continue;
    const double after = health.number(i, "time") - kDies;
    if (after < 0.0) outcome.named_before = true;
    if (after >= 0.0) outcome.named_after = std::min(outcome.named_after, after);
  }
  std::filesystem::remove_all(folder);
  return outcome;
}

void expect_never_lost(const Outcome& outcome) {
  EXPECT_TRUE(outcome.knew);
  EXPECT_GT(outcome.driven_before, 5.0) << "an idle robot shows nothing";
  EXPECT_GE(outcome.updates, 20);
  EXPECT_LE(outcome.unsure, outcome.updates / 50);
  EXPECT_LE(outcome.worst, 0.5);
  EXPECT_EQ(outcome.touched, 0.0);
  EXPECT_FALSE(outcome.named_before) << "a false alarm";
}

TEST(SonarDies, SilentItIsNamedAndTheRobotStands) {
  const Outcome outcome = strike("dead", "bonn", 21, {"localize.sonar.beams=12"});
  expect_never_lost(outcome);
  EXPECT_LE(outcome.named_after, 5.0);
  EXPECT_LE(outcome.most_speed, 0.02);
}

TEST(SonarDies, FrozenInTheBeliefItDoesNotLoseARobotThatGoesOn) {
  expect_never_lost(strike("frozen", "smithsonian", 22, {"localize.sonar.beams=12", "localize.method=particles"}));
}

TEST(SonarDies, DeafOutsideTheBeliefItChangesNothingThere) { expect_never_lost(strike("deaf", "bonn", 23, {})); }

}  // namespace
}  // namespace docent
