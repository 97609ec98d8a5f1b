#include "docent/task_control/travel_times/travel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace docent::task_control {
namespace {

constexpr double kGoalTolerance = 0.3;    ///< [m]
constexpr std::size_t kMostFields = 200;  ///< kept: more than a museum has places; points on the map come and go
constexpr int kMostVisits = 100'000;      ///< of tiles

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
    ++uses_;
    if (const auto known = fields_.find({to.x, to.y}); known != fields_.end()) {
      known->second.last_use = uses_;
      return known->second.values;
    }
    if (fields_.size() >= kMostFields) {
      fields_.erase(std::min_element(fields_.begin(), fields_.end(), [](const auto& a, const auto& b) {
        return a.second.last_use < b.second.last_use;
      }));
    }
    Field& field = fields_[{to.x, to.y}];
    field.last_use = uses_;
    planner_.set_goal(to, kGoalTolerance);
    planner_.iterate(kMostVisits);
    const GridFrame& frame = planner_.frame();
    field.values.reserve(frame.size());
    for (int row = 0; row < frame.rows; ++row) {
      for (int column = 0; column < frame.columns; ++column) {
        field.values.push_back(planner_.values().value({column, row}));
      }
    }
    return field.values;
  }

  planning::RoutePlanner planner_;
  struct Field {
    std::vector<float> values;
    std::uint64_t last_use = 0;
  };
  std::map<std::pair<double, double>, Field> fields_;
  std::uint64_t uses_ = 0;
};

}  // namespace

TravelDistance travel_on_map(planning::RoutePlanner planner) {
  return [travel = std::make_shared<TravelOnMap>(std::move(planner))](Point2 from, Point2 to) {
    return travel->distance_between(from, to);
  };
}

}  // namespace docent::task_control
