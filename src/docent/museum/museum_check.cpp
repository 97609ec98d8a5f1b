#include <array>
#include <cstdio>
#include <deque>

#include "docent/base/files.h"
#include "docent/museum/museum.h"
#include "docent/museum/museum_reader.h"

namespace docent {
namespace {

constexpr double kRobotRadius = 0.265;  // [m]
constexpr double kRoom = 0.10;          // [m] of air that the robot wants round its body
constexpr double kFarthestLook = 30.0;  // [m] from where an exhibit is explained to what is pointed at: a long hall

std::string metres(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g m", value);
  return text.data();
}

/// Where the robot's centre may be, by map, hazards and area.
class Room {
 public:
  explicit Room(const Museum& museum) : museum_{museum} {
    const GridFrame& frame = museum.map.frame;
    std::vector<bool> blocked(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) blocked[i] = !(museum.map.cells[i] >= 0 && museum.map.cells[i] < 20);
    for (const Hazard& hazard : museum.hazards) block(hazard.polygon, blocked);
    clearance_ = distance_transform(frame, blocked);
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
    const double clearance = clearance_[frame.index(cell)];
    if (clearance < kRobotRadius + kRoom) {
      return "is only " + metres(clearance) + " from " + nearest_hazard(place, clearance) + ", the robot needs " +
             metres(kRobotRadius + kRoom);
    }
    if (!reached_[frame.index(cell)]) return "cannot be reached from home";
    return {};
  }

 private:
  void block(const Polygon& polygon, std::vector<bool>& blocked) const {
    const GridFrame& frame = museum_.map.frame;
    Point2 low = polygon.front();
    Point2 high = polygon.front();
    for (const Point2 corner : polygon) {
      low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
      high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
    }
    const CellIndex first = frame.cell_at(low);
    const CellIndex last = frame.cell_at(high);
    for (int row = std::max(0, first.row); row <= std::min(frame.rows - 1, last.row); ++row) {
      for (int column = std::max(0, first.column); column <= std::min(frame.columns - 1, last.column); ++column) {
        const CellIndex cell{column, row};
        if (distance(polygon, frame.centre(cell)) <= 0.5 * frame.resolution) blocked[frame.index(cell)] = true;
      }
    }
  }

  void flood() {
    const GridFrame& frame = museum_.map.frame;
    reached_.assign(frame.size(), false);
    const CellIndex home = frame.cell_at(museum_.home.position());
    if (!is_open(home)) return;
    std::deque<CellIndex> front{home};
    reached_[frame.index(home)] = true;
    while (!front.empty()) {
      const CellIndex cell = front.front();
      front.pop_front();
      for (const CellIndex next : {CellIndex{cell.column + 1, cell.row}, CellIndex{cell.column - 1, cell.row},
                                   CellIndex{cell.column, cell.row + 1}, CellIndex{cell.column, cell.row - 1}}) {
        if (!is_open(next) || reached_[frame.index(next)]) continue;
        reached_[frame.index(next)] = true;
        front.push_back(next);
      }
    }
  }

  [[nodiscard]] bool is_open(CellIndex cell) const {
    const GridFrame& frame = museum_.map.frame;
    return frame.holds(cell) && clearance_[frame.index(cell)] >= kRobotRadius + kRoom &&
           contains(museum_.area, frame.centre(cell));
  }

  [[nodiscard]] std::string nearest_hazard(Point2 place, double clearance) const {
    for (const Hazard& hazard : museum_.hazards) {
      if (distance(hazard.polygon, place) < clearance + 2.0 * museum_.map.frame.resolution) {
        return "the hazard '" + hazard.id + "'";
      }
    }
    return "a wall or furniture of the map";
  }

  const Museum& museum_;
  std::vector<float> clearance_;
  std::vector<bool> reached_;
};

void check_places(const YamlFile& file, const MuseumSource& source, std::vector<Error>& faults) {
  const Museum& museum = source.museum;
  const Room room{museum};
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
}

}  // namespace

std::vector<Error> check_museum(const std::filesystem::path& folder) {
  auto file = YamlFile::load(folder / "museum.yaml");
  if (!file) return {file.error()};
  auto source = read_museum(*file, [&](const std::filesystem::path& relative) { return read_file(folder / relative); });
  std::vector<Error> faults = source.faults;
  const YAML::Node& root = file->root();
  std::error_code code;
  if (source.museum.simulation_path &&
      !std::filesystem::is_regular_file(folder / *source.museum.simulation_path, code)) {
    faults.push_back(file->fault(root["simulation"], source.museum.simulation_path->string() + " does not exist"));
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
  // Places mean something only where area and home could be read.
  if (source.museum.area.size() >= 3 && root["home"].IsDefined()) check_places(*file, source, faults);
  return faults;
}

}  // namespace docent
