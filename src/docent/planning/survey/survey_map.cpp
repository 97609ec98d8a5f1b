#include "docent/planning/survey/survey_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "docent/mapping/occupancy/stray_floor.h"

namespace docent::planning {
namespace {

constexpr std::size_t kMomentsACall = 100;  // drawn anew
constexpr std::size_t kMomentsAPiece = 20;  // of the way, some four metres: see ScanMapper::end_piece
constexpr int kFewestHitsInTheEnd = 3;

}  // namespace

double free_area(const OccupancyGrid& map) {
  const auto cells = std::count(map.cells.begin(), map.cells.end(), OccupancyGrid::kFree);
  return static_cast<double>(cells) * map.frame.resolution * map.frame.resolution;
}

SurveyMap::SurveyMap(const mapping::GraphMapperParams& mapping, const mapping::ScanMapperParams& map,
                     double body_radius)
    : params_{map}, poses_{mapping}, map_{map, body_radius} {}

Pose2 SurveyMap::add(Keyframe moment) {
  constexpr std::size_t kMost = 80;  // a moment
  std::vector<mapping::SurfacePoint> some;
  const std::size_t step = std::max<std::size_t>(1, moment.scan.points.size() / kMost);
  for (std::size_t i = walls_.size() % step; i < moment.scan.points.size(); i += step)
    if (moment.scan.points[i].has_normal()) some.push_back(moment.scan.points[i]);
  walls_.push_back(std::move(some));
  poses_.add(std::move(moment.scan));
  const Pose2 map_from_base = site_from_survey_ * poses_.map_from_base().back();
  map_.add(std::move(moment.sweeps), map_from_base);
  return map_from_base;
}

void SurveyMap::lie(const Pose2& site_from_survey) {
  site_from_survey_ = site_from_survey;
  lies_elsewhere_ = true;
}

std::vector<mapping::SurfacePoint> SurveyMap::walls(double apart) const {
  std::map<std::array<int, 3>, mapping::SurfacePoint> places;  // by cell and side
  const auto poses = poses_.map_from_base();
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    for (const mapping::SurfacePoint& point : walls_[i]) {
      const mapping::SurfacePoint at = transformed(poses[i], point);
      const int side = static_cast<int>(std::lround(std::atan2(at.normal.y, at.normal.x) * 4.0 / std::numbers::pi));
      places.try_emplace(
          {static_cast<int>(std::floor(at.at.x / apart)), static_cast<int>(std::floor(at.at.y / apart)), side}, at);
    }
  }
  std::vector<mapping::SurfacePoint> walls;
  for (const auto& [cell, point] : places) walls.push_back(point);
  return walls;
}

std::vector<Pose2> SurveyMap::in_site(std::span<const Pose2> survey_from_base) const {
  std::vector<Pose2> poses;
  for (const Pose2& pose : survey_from_base) poses.push_back(site_from_survey_ * pose);
  return poses;
}

std::vector<Point2> SurveyMap::trail() const {
  std::vector<Point2> places;
  for (const Pose2& pose : poses_.map_from_base()) places.push_back(site_from_survey_ * pose.position());
  return places;
}

void SurveyMap::follow() {
  if (std::exchange(lies_elsewhere_, false) || poses_.revision() != revision_) {
    revision_ = poses_.revision();
    map_.move(in_site(poses_.map_from_base()));
  }
  map_.work(kMomentsACall);
}

void SurveyMap::look() {
  seen_ = map_.map();
  known_m2_ = free_area(seen_);
}

Result<SurveyMap::Finished> SurveyMap::finish(const LastTouches& touches, const SiteOf& site_of) {
  mapping::GraphMap result = poses_.finish();
  mapping::ScanMapperParams params = params_;
  params.fewest_hits = std::max(params.fewest_hits, kFewestHitsInTheEnd);
  // The best poses may have turned all of it about the first one.
  if (site_of) site_from_survey_ = site_of(walls(kWallsApart));
  result.map_from_base = in_site(result.map_from_base);
  const auto placed = map_.placed(result.map_from_base);
  const auto frame = mapping::ScanMapper::frame_of(placed, params);
  if (!frame) return tl::unexpected<Error>(frame.error());
  mapping::ScanMapper mapper{*frame, params};
  const std::size_t piece = kMomentsAPiece * placed.size() / std::max<std::size_t>(1, map_.moments());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    mapper.add(placed[i]);
    if ((i + 1) % piece == 0) mapper.end_piece();
  }
  mapper.end_piece();
  for (const Pose2& pose : result.map_from_base) mapper.stand(pose.position(), touches.standing_room);
  Finished finished{mapper.map(), std::move(result.map_from_base),
                    result.judgement.is_trusted ? "" : result.judgement.reason};
  mapping::forget_stray_floor(finished.map, touches.stray_floor);
  known_m2_ = free_area(finished.map);
  return finished;
}

}  // namespace docent::planning
