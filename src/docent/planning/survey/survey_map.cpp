#include "docent/planning/survey/survey_map.h"

#include <algorithm>
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
  poses_.add(std::move(moment.scan));
  const Pose2 map_from_base = poses_.map_from_base().back();
  map_.add(std::move(moment.sweeps), map_from_base);
  return map_from_base;
}

void SurveyMap::follow() {
  if (poses_.revision() != revision_) {
    revision_ = poses_.revision();
    map_.move(poses_.map_from_base());
  }
  map_.work(kMomentsACall);
}

void SurveyMap::look() {
  seen_ = map_.map();
  known_m2_ = free_area(seen_);
}

Result<SurveyMap::Finished> SurveyMap::finish(const LastTouches& touches) {
  mapping::GraphMap result = poses_.finish();
  mapping::ScanMapperParams params = params_;
  params.fewest_hits = std::max(params.fewest_hits, kFewestHitsInTheEnd);
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
