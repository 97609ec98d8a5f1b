#include "docent/task_control/travel_times/travel.h"

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace docent::task_control {
namespace {

constexpr double kGoalTolerance = 0.3;  ///< [m]
constexpr int kMostVisits = 100'000;    ///< of tiles

class TravelOnMap {
 public:
  explicit TravelOnMap(planning::RoutePlanner planner) : planner_{std::move(planner)} {}

  [[nodiscard]] double distance_between(Point2 from, Point2 to) {
    const std::vector<float>& values = values_to(to);
    const GridFrame& frame = planner_.frame();
    const CellIndex centre = frame.cell_at(from);
    const int reach = static_cast<int>(std::ceil(kNear / frame.resolution));
    double best_off = std::numeric_limits<double>::infinity();
    double best = std::numeric_limits<double>::infinity();
    bool is_open = false;
    for (int row = centre.row - reach; row <= centre.row + reach; ++row) {
      for (int column = centre.column - reach; column <= centre.column + reach; ++column) {
        const CellIndex cell{column, row};
        if (!frame.holds(cell) || planner_.is_closed(frame.centre(cell))) continue;
        const double off = distance(frame.centre(cell), from);
        if (off > kNear || off >= best_off) continue;
        is_open = true;
        best_off = off;
        best = off + static_cast<double>(values[frame.index(cell)]);
      }
    }
    return is_open ? best : distance(from, to);
  }

 private:
  const std::vector<float>& values_to(Point2 to) {
    const auto [place, is_new] = fields_.try_emplace({to.x, to.y});
    if (!is_new) return place->second;
    planner_.set_goal(to, kGoalTolerance);
    planner_.iterate(kMostVisits);
    const GridFrame& frame = planner_.frame();
    place->second.reserve(frame.size());
    for (int row = 0; row < frame.rows; ++row) {
      for (int column = 0; column < frame.columns; ++column) {
        place->second.push_back(planner_.values().value({column, row}));
      }
    }
    return place->second;
  }

  planning::RoutePlanner planner_;
  std::map<std::pair<double, double>, std::vector<float>> fields_;
};

}  // namespace

TravelDistance travel_on_map(planning::RoutePlanner planner) {
  return [travel = std::make_shared<TravelOnMap>(std::move(planner))](Point2 from, Point2 to) {
    return travel->distance_between(from, to);
  };
}

}  // namespace docent::task_control
