#include "docent/planning/navigator/coast_guide.h"

#include <algorithm>

namespace docent::planning {
namespace {

constexpr int kCoastSweepsAStep = 2;
constexpr int kCoastCoarsening = 2;  ///< its cell = so many planning cells
constexpr double kOffCoast = 2.0;    ///< [m] beside its way, from where it looks for another

}  // namespace

CoastGuide::CoastGuide(const OccupancyGrid& map, const RoutePlanner& route, const CoastalParams& params) {
  if (params.weight > 0.0)
    planner_.emplace(map, CoastalFloor::of(route.frame(), route.static_costs(), kCoastCoarsening), params);
}

void CoastGuide::seek(Point2 goal, double tolerance, RoutePlanner& route) {
  if (!planner_) return;
  way_.clear();
  route.prefer({});
  planner_->set_goal(goal, tolerance);
}

void CoastGuide::follow(const Whereabouts& where, const PoseBelief& belief, RoutePlanner& route) {
  if (!planner_ || belief.hypotheses.empty()) return;
  const bool was_settled = planner_->is_settled();
  const auto here = where.map_from_base();
  if (!planner_->iterate(kCoastSweepsAStep) || !here) return;
  const bool is_off = std::none_of(way_.begin(), way_.end(),
                                   [&](Point2 point) { return distance(point, here->position()) < kOffCoast; });
  if (was_settled && !(is_off && !way_.empty())) return;
  way_ = planner_->way(here->position(), planner_->uncertainty().variance_of(belief.hypotheses.front().covariance));
  route.prefer(way_);
}

}  // namespace docent::planning
