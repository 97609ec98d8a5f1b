#include "docent/vision/things/thing_sight.h"

#include <cmath>
#include <utility>

#include "docent/vision/objects/seen_picture.h"

namespace docent::vision {
namespace {

constexpr Duration kSameMoment = std::chrono::milliseconds{700};  // a colour picture and one of depths
constexpr std::uint64_t kPlaneSeed = 64;                          // of the floor's trials: same pictures, same things

/// What the place is worth on the map: the look's own covariance, and the robot's.
Eigen::Matrix2d covariance_in_map(const FloorThing& thing, const ThingViewpoint& from) {
  const double c = std::cos(from.map_from_base.theta.radians()), s = std::sin(from.map_from_base.theta.radians());
  Eigen::Matrix2d turn;
  turn << c, -s, s, c;
  const Eigen::Vector2d off = turn * Eigen::Vector2d{thing.middle.x, thing.middle.y};
  Eigen::Matrix<double, 2, 3> by_pose;
  by_pose << 1.0, 0.0, -off.y(), 0.0, 1.0, off.x();
  return turn * thing.covariance * turn.transpose() + by_pose * from.covariance * by_pose.transpose();
}

}  // namespace

ThingSight::ThingSight(const FloorThingParams& floor, const ThingMapParams& map, std::optional<ObjectBook> book)
    : params_{floor}, map_{map}, book_{std::move(book)}, rng_{kPlaneSeed} {}

void ThingSight::set_depth_camera(const DepthCamera& camera) {
  depth_ = camera;
  finder_.emplace(camera, params_);
}

void ThingSight::see(pictures::Image picture, const ThingViewpoint& from) { colours_ = {std::move(picture), from}; }

std::vector<KeptPatch> ThingSight::see(const DepthPicture& picture, const ThingViewpoint& from) {
  std::vector<KeptPatch> patches;
  const FloorView view = finder_->find(picture, rng_);
  if (!view.sees_floor) return patches;
  looked_ = from.taken;
  for (const FloorThing& thing : view.things) {
    ThingLook look{
        from.map_from_base * thing.middle, covariance_in_map(thing, from), thing.width, thing.height, false, ""};
    if (auto patch = patch_of(thing, look.in_map, from.taken)) {
      if (book_) {
        const auto found = book_->name(vision::see(*patch).features);
        look.is_named = true;
        if (found.is_known) look.object = found.object;
      }
      patches.push_back({std::move(*patch), look.in_map});
    }
    map_.add(look, from.taken);
  }
  look_for_gaps(from);
  return patches;
}

std::optional<pictures::Image> ThingSight::patch_of(const FloorThing& thing, Point2 in_map, Time taken) const {
  if (!colours_ || !front_) return std::nullopt;
  if (taken - colours_->from.taken > kSameMoment || colours_->from.taken - taken > kSameMoment) return std::nullopt;
  return thing_patch(colours_->picture, *front_,
                     {inverse(colours_->from.map_from_base) * in_map, thing.width, thing.height});
}

/// So that what somebody has picked up is forgotten.
void ThingSight::look_for_gaps(const ThingViewpoint& from) {
  constexpr double kNearest = 1.0, kFarthest = 2.2, kAside = 0.3;  // [m], [m], [rad]
  constexpr double kRadius = 0.04;                                 // [m]
  std::vector<std::uint32_t> bare;
  for (const MappedThing& thing : map_.things()) {
    const Point2 in_base = inverse(from.map_from_base) * thing.in_map;
    const double away = norm(in_base);
    if (thing.last == from.taken || away < kNearest || away > kFarthest) continue;
    if (std::abs(std::atan2(in_base.y, in_base.x)) > kAside) continue;
    if (finder_->is_bare(in_base, kRadius)) bare.push_back(thing.id);
  }
  for (const std::uint32_t id : bare) map_.see_bare(id);
}

}  // namespace docent::vision
