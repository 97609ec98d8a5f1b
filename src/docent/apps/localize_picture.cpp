#include "docent/apps/localize_picture.h"

#include <cmath>

#include "docent/pictures/colors.h"

namespace docent {

namespace {

constexpr double kRobotRadius = 0.3;  // [m] in pictures

std::vector<Point2> endpoints_at(const LoggedScan& scan, double max_range, const Pose2& map_from_laser) {
  std::vector<Point2> ends;
  for (const SweepBeam& beam : sweep_of(scan, max_range).beams)
    if (!beam.no_return) ends.push_back(map_from_laser * endpoint(beam));
  return ends;
}

}  // namespace

Image draw_belief(const Image& map_picture, const MapView& view, const Localizer& localizer, const LoggedScan& scan,
                  double max_range, bool two_lasers) {
  Image image = map_picture;
  const PositionDensity density = localizer.density();
  draw_density(image, view, density.frame, density.mass);
  const Pose2 tracked = base_from_tracked(two_lasers, scan);
  if (const auto best = localizer.map_from_robot(scan.odom_from_base * tracked)) {
    const Pose2 map_from_base = *best * inverse(tracked);
    const Color color = localizer.verdict().localized() ? colors::kGreen : colors::kGrey;
    draw_points(image, view, endpoints_at(scan, max_range, map_from_base * scan.base_from_laser), 3.0,
                with_alpha(color, 180));
    draw_robot(image, view, map_from_base, kRobotRadius, color);
  }
  return image;
}

BeliefMovie::BeliefMovie(const OccupancyGrid& map, Animation animation)
    : view_{MapView::whole(map.frame)}, map_picture_{draw_map(map, view_)}, animation_{std::move(animation)} {}

Result<BeliefMovie> BeliefMovie::create(const OccupancyGrid& map) {
  const MapView view = MapView::whole(map.frame);
  auto animation = Animation::create(view.width(), view.height());
  if (!animation) return tl::unexpected<Error>(animation.error());
  return BeliefMovie{map, std::move(*animation)};
}

bool BeliefMovie::is_full() const { return frames_localized_ >= 12 || frames_ >= 150; }

Result<void> BeliefMovie::add(const Localizer& localizer, const LoggedScan& scan, double max_range, bool two_lasers) {
  ++frames_;
  if (localizer.verdict().localized()) ++frames_localized_;
  const Duration shown = std::chrono::milliseconds(is_full() ? 3000 : 300);
  return animation_.add(draw_belief(map_picture_, view_, localizer, scan, max_range, two_lasers), shown);
}

Result<void> BeliefMovie::save(const std::filesystem::path& path) { return animation_.save(path); }

Image draw_scan(const OccupancyGrid& map, const LoggedScan& scan, double max_range, const LoggedPose& pose) {
  constexpr double kAround = 12.0;  // [m]
  const Point2 centre = pose.map_from_base.position();
  const MapView view{centre - Point2{kAround, kAround}, centre + Point2{kAround, kAround}, 30.0};
  Image image = draw_map(map, view);
  const Color color = pose.localized ? colors::kGreen : colors::kGrey;
  draw_points(image, view, endpoints_at(scan, max_range, pose.map_from_base * scan.base_from_laser), 5.0, color);
  draw_robot(image, view, pose.map_from_base, kRobotRadius, color);
  return image;
}

Image draw_run(const OccupancyGrid& map, const LaserLog& log, const LogRun& run, std::size_t stride,
               const std::vector<std::optional<Pose2>>& reference) {
  const MapView view = MapView::whole(map.frame, 1600);
  Image image = draw_map(map, view);
  std::vector<Point2> true_way;
  for (const auto& pose : reference)
    if (pose) true_way.push_back(pose->position());
  if (true_way.size() > 1) draw_path(image, view, true_way, 6.0, with_alpha(colors::kGrey, 150));
  std::vector<Point2> way;
  for (std::size_t i = 0; i < run.poses.size(); ++i) {
    const LoggedPose& pose = run.poses[i];
    if (!pose.localized) continue;
    way.push_back(pose.map_from_base.position());
    if (i % stride != 0) continue;
    const double along = static_cast<double>(i) / static_cast<double>(run.poses.size());
    const Color color = rainbow(along);
    draw_points(image, view,
                endpoints_at(log.scans[i], log.max_range, pose.map_from_base * log.scans[i].base_from_laser), 2.5,
                color);
    draw_robot(image, view, pose.map_from_base, kRobotRadius, color);
  }
  if (way.size() > 1) draw_path(image, view, way, 2.0, colors::kInk);
  return image;
}

}  // namespace docent
