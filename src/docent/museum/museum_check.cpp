#include <algorithm>
#include <array>
#include <cstdio>

#include "docent/base/files.h"
#include "docent/grid/clearance.h"
#include "docent/museum/museum.h"
#include "docent/museum/museum_file.h"
#include "docent/museum/museum_reader.h"

namespace docent::museum {
namespace {

constexpr double kFarthestLook = 30.0;  // [m] from where an exhibit is explained to what is pointed at: a long hall

std::string metres(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g m", value);
  return text.data();
}

/// Where the robot's centre may be, by map, hazards and area: as the planner of ways sees it.
class StandingRoom {
 public:
  StandingRoom(const Museum& museum, const CheckedRobot& robot)
      : museum_{museum}, robot_{robot}, frame_{coarse_frame(museum.map.frame, robot.coarsening)} {
    const GridFrame& frame = museum.map.frame;
    std::vector<bool> blocked(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) blocked[i] = !(museum.map.cells[i] >= 0 && museum.map.cells[i] < 20);
    to_walls_ = distance_transform(frame, blocked);
    spare_ =
        spare_room(museum.map, museum.hazard_polygons(), museum.area, robot.radius, robot.clearance, robot.coarsening);
    flood();
  }

  /// Why the robot cannot stand at `place`; empty when it can.
  [[nodiscard]] std::string why_not(Point2 place) const {
    const GridFrame& frame = museum_.map.frame;
    const CellIndex cell = frame.cell_at(place);
    if (!frame.holds(cell)) return "lies outside the map";
    if (!contains(museum_.area, place)) return "lies outside the area";
    if (museum_.map.is_occupied(cell)) return "lies inside a wall or furniture of the map";
    for (const Hazard& hazard : museum_.hazards) {
      if (contains(hazard.polygon, place)) return "lies inside the hazard '" + hazard.id + "'";
    }
    if (!museum_.map.is_free(cell)) return "lies where the map is unknown";
    const auto too_near = [](double is, double needs, const std::string& what) {
      return "is only " + metres(is) + " from " + what + ", the robot needs " + metres(needs);
    };
    const Clearance& clearance = robot_.clearance;
    const double to_walls = to_walls_[frame.index(cell)];
    if (to_walls < robot_.radius + clearance.walls)
      return too_near(to_walls, robot_.radius + clearance.walls, "a wall or furniture of the map");
    for (const Hazard& hazard : museum_.hazards) {
      const double away = distance(hazard.polygon, place);
      if (away < robot_.radius + clearance.hazards)
        return too_near(away, robot_.radius + clearance.hazards, "the hazard '" + hazard.id + "'");
    }
    const double to_border = outline_distance(museum_.area, place);
    if (to_border < clearance.border) return too_near(to_border, clearance.border, "the area's border");
    if (!is_reached(place)) return "cannot be reached from home";
    return {};
  }

 private:
  /// From home, by cells that the planner may use, corners included. Where a place's own cell has its centre too near
  /// to something, the one beside it counts: so the planner arrives.
  void flood() {
    reached_.assign(frame_.size(), false);
    std::vector<CellIndex> front;
    const auto reach_beside = [&](CellIndex cell) {
      for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
        for (int column = cell.column - 1; column <= cell.column + 1; ++column) {
          const CellIndex next{column, row};
          if (!frame_.holds(next) || spare_[frame_.index(next)] < 0.0 || reached_[frame_.index(next)]) continue;
          reached_[frame_.index(next)] = true;
          front.push_back(next);
        }
      }
    };
    reach_beside(frame_.cell_at(museum_.home.position()));
    while (!front.empty()) {
      const CellIndex cell = front.back();
      front.pop_back();
      reach_beside(cell);
    }
  }

  [[nodiscard]] bool is_reached(Point2 place) const {
    const CellIndex cell = frame_.cell_at(place);
    for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
      for (int column = cell.column - 1; column <= cell.column + 1; ++column) {
        if (frame_.holds({column, row}) && reached_[frame_.index({column, row})]) return true;
      }
    }
    return false;
  }

  const Museum& museum_;
  CheckedRobot robot_;
  GridFrame frame_;
  std::vector<float> to_walls_;  ///< [rows * columns of the map] m
  std::vector<double> spare_;    ///< [rows * columns of frame_] m
  std::vector<bool> reached_;    ///< [rows * columns of frame_]
};

void check_places(const YamlFile& file, const MuseumSource& source, const CheckedRobot& robot,
                  std::vector<Error>& faults) {
  const Museum& museum = source.museum;
  const StandingRoom room{museum, robot};
  const YAML::Node& root = file.root();
  const auto check = [&](const YAML::Node& at, const std::string& who, const Pose2& pose) {
    const std::string why = room.why_not(pose.position());
    if (!why.empty()) faults.push_back(file.fault(at, who + " " + why));
    return why.empty();
  };
  if (!check(root["home"], "home", museum.home)) return;  // else nothing at all could be reached
  if (museum.charger) check(root["charger"], "charger", *museum.charger);
  for (std::size_t i = 0; i < museum.exhibits.size(); ++i) {
    const Exhibit& exhibit = museum.exhibits[i];
    const YAML::Node& node = source.exhibits[i];
    check(node["pose"], "exhibit '" + exhibit.id + "'", exhibit.pose);
    const double look = distance(exhibit.look_at, exhibit.pose.position());
    if (!(look <= kFarthestLook))
      faults.push_back(file.fault(node["look_at"], "what exhibit '" + exhibit.id + "' looks at is " + metres(look) +
                                                       " away, more than anybody is shown (" + metres(kFarthestLook) +
                                                       ")"));
    for (std::size_t k = 0; k < exhibit.viewpoints.size(); ++k) {
      check(node["viewpoints"][k], "viewpoint " + std::to_string(k + 1) + " of exhibit '" + exhibit.id + "'",
            exhibit.viewpoints[k]);
    }
  }
  for (std::size_t i = 0; i < museum.rooms.size(); ++i) {
    const Point2 at = museum.rooms[i].at;
    check(source.rooms[i]["at"], "room '" + museum.rooms[i].id + "'", {at.x, at.y, {}});
  }
}

}  // namespace

std::vector<Error> check_museum(const std::filesystem::path& folder, const CheckedRobot& robot, Stage stage) {
  auto file = load_museum_file(folder);
  if (!file) return {file.error()};
  auto source = read_museum_file(*file, folder, stage);
  std::vector<Error> faults = source.faults;
  const YAML::Node& root = file->root();
  std::error_code code;
  if (source.museum.simulation_path &&
      !std::filesystem::is_regular_file(folder / *source.museum.simulation_path, code)) {
    faults.push_back(file->fault(root["simulation"], source.museum.simulation_path->string() + " does not exist"));
  }
  if (const auto& music = source.museum.sound.music; music && !std::filesystem::is_regular_file(folder / *music, code))
    faults.push_back(file->fault(root["sound"]["music"], music->string() + " does not exist"));
  for (std::size_t i = 0; i < source.museum.exhibits.size(); ++i) {
    const auto& picture = source.museum.exhibits[i].picture;
    if (!picture.empty() && !std::filesystem::is_regular_file(folder / picture, code))
      faults.push_back(file->fault(source.exhibits[i]["picture"], picture.string() + " does not exist"));
  }
  if (source.museum.map_path.empty()) return faults;
  if (!std::filesystem::is_regular_file(folder / source.museum.map_path, code)) {
    faults.push_back(file->fault(root["map"], source.museum.map_path.string() + " does not exist"));
    return faults;
  }
  auto map = load_map(folder / source.museum.map_path);
  if (!map) {
    faults.push_back(map.error());
    return faults;
  }
  source.museum.map = std::move(*map);
  // Places mean something only where area and home could be read, and somebody has seen the floor.
  const auto& cells = source.museum.map.cells;
  const bool is_blank =
      std::all_of(cells.begin(), cells.end(), [](auto cell) { return cell == OccupancyGrid::kUnknown; });
  if (stage == Stage::being_set_up && is_blank) return faults;
  if (source.museum.area.size() >= 3 && root["home"].IsDefined()) check_places(*file, source, robot, faults);
  return faults;
}

}  // namespace docent::museum
