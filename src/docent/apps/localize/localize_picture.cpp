#include "docent/apps/localize/localize_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <span>
#include <utility>

namespace docent::apps::localize_command {

namespace {

constexpr double kRobotRadius = 0.3;  // [m] in pictures
constexpr double kDot = 1.5;          // [points] diameter of an endpoint
constexpr double kWay = 1.0;          // [points]
constexpr double kReferenceWay = 3.0;
constexpr double kJump = 1.0;  // [m] more than the wheels say: the robot was carried, or thinks better of its place
constexpr double kShownReach = 12.0;  // [m] of a reading, for which the picture is made larger
constexpr pictures::Color kStart = pictures::colors::kGreen;
constexpr pictures::Color kEnd = pictures::colors::kRed;
constexpr pictures::Color kReference = pictures::with_alpha(pictures::colors::kGrey, 150);

std::vector<Point2> endpoints_at(const recording::LoggedScan& scan, double max_range, const Pose2& map_from_laser) {
  std::vector<Point2> ends;
  for (const sensor_models::SweepBeam& beam : sweep_of(scan, max_range).beams)
    if (!beam.no_return) ends.push_back(map_from_laser * sensor_models::endpoint(beam));
  return ends;
}

pictures::Color color_when(bool localized) { return localized ? pictures::colors::kGreen : pictures::colors::kGrey; }

/// Seconds since the first scan of the log, in whichever way it is run.
double seconds_into(const recording::LaserLog& log, std::size_t scan) {
  return to_seconds(log.scans[scan].time) - to_seconds(log.scans.front().time);
}

/// "scan 12, 3.4 s"
std::string moment_of(const recording::LaserLog& log, std::size_t scan) {
  std::array<char, 60> text{};
  std::snprintf(text.data(), text.size(), "scan %zu, %.1f s", scan, seconds_into(log, scan));
  return text.data();
}

void add_robot_legend(pictures::Figure& figure) {
  figure.add_legend(pictures::legend_disc("robot and scan, localized", 6.0, color_when(true)));
  figure.add_legend(
      pictures::legend_disc("robot and scan at the best hypothesis, not localized", 6.0, color_when(false)));
}

}  // namespace

std::vector<std::vector<Point2>> ways_of(const recording::LaserLog& log, const LogRun& run, WayKind kind) {
  const auto is_of_kind = [kind](const LoggedPose& pose) {
    if (kind == WayKind::kTakenBack) return pose.is_taken_back();
    if (pose.localized && !pose.is_taken_back()) return kind == WayKind::kSaid;
    return pose.hindsight ? kind == WayKind::kHindsight : kind == WayKind::kUnsure && pose.has_pose;
  };
  const auto place_of = [kind](const LoggedPose& pose) {
    return (kind == WayKind::kTakenBack ? pose.map_from_base : pose.best()).position();
  };
  std::vector<std::vector<Point2>> ways;
  const LoggedPose* last = nullptr;
  for (const LoggedPose& pose : run.poses) {
    if (!is_of_kind(pose)) {
      last = nullptr;
      continue;
    }
    const auto driven = [&] {
      const Pose2& from = log.scans[last->scan].odom_from_base;
      return distance(from.position(), log.scans[pose.scan].odom_from_base.position());
    };
    if (last == nullptr || distance(place_of(*last), place_of(pose)) > driven() + kJump) ways.emplace_back();
    ways.back().push_back(place_of(pose));
    last = &pose;
  }
  return ways;
}

pictures::Axes belief_axes(const OccupancyGrid& map, const localization::Localizer& localizer,
                           const recording::LaserLog& log, std::size_t scan) {
  pictures::Axes axes = pictures::Axes::metres(map.frame, 400.0);
  axes.set_title(fmt::format("{}, P(lost) {:.3f}", moment_of(log, scan), localizer.verdict().p_lost()));
  pictures::draw_map(axes, map);
  const localization::PositionDensity density = localizer.density();
  pictures::draw_density(axes, density.frame, density.mass);
  const recording::LoggedScan& seen = log.scans[scan];
  const Pose2 tracked = base_from_tracked(has_two_lasers(log), seen);
  if (const auto best = localizer.map_from_robot(seen.odom_from_base * tracked)) {
    const Pose2 map_from_base = *best * inverse(tracked);
    const pictures::Color color = color_when(localizer.verdict().localized());
    pictures::draw_points(axes, endpoints_at(seen, log.max_range, map_from_base * seen.base_from_laser), kDot,
                          pictures::with_alpha(color, 180));
    pictures::draw_robot(axes, map_from_base, kRobotRadius, color);
  }
  return axes;
}

bool BeliefMovie::is_full() const { return frames_localized_ >= 12 || frames_ >= 150; }

Result<void> BeliefMovie::add(const localization::Localizer& localizer, std::size_t scan) {
  ++frames_;
  const bool is_localized = localizer.verdict().localized();
  if (is_localized) ++frames_localized_;
  pictures::Axes axes = belief_axes(map_, localizer, log_, scan);
  if (frames_ == 1 || frames_ == 3 || frames_ == 5) first_.push_back(axes);
  if (frames_localized_ == 0 || (is_localized && frames_localized_ == 1)) known_ = axes;
  axes.set_color_bar(pictures::density_bar());
  // The moment stands over the frame, where it takes the same room whatever it says: frames of a film have one size.
  pictures::Figure figure{""};
  figure.add(std::move(axes));
  pictures::add_map_legend(figure);
  add_robot_legend(figure);
  const pictures::Image frame = figure.raster();
  const Duration shown = std::chrono::milliseconds(is_full() ? 3000 : 300);
  if (!animation_) {
    auto animation = pictures::Animation::create(frame.width(), frame.height());
    if (!animation) return tl::unexpected<Error>(animation.error());
    animation_.emplace(std::move(*animation));
  }
  return animation_->add(frame, shown);
}

Result<void> BeliefMovie::save(const std::filesystem::path& path) {
  if (!animation_) return fail(path.string() + ": a movie needs a frame");
  return animation_->save(path);
}

pictures::Figure BeliefMovie::moments() const {
  std::vector<pictures::Axes> all = first_;
  if (known_) all.push_back(*known_);
  if (!all.empty()) all[std::min<std::size_t>(1, all.size() - 1)].set_color_bar(pictures::density_bar());
  pictures::Figure figure{"The belief at four moments"};
  for (std::size_t i = 0; i < all.size(); ++i) figure.add(std::move(all[i]), i == 2);
  pictures::add_map_legend(figure);
  add_robot_legend(figure);
  return figure;
}

pictures::Figure draw_scan(const OccupancyGrid& map, const recording::LaserLog& log, const LoggedPose& pose) {
  constexpr double kAround = 12.0;  // [m]
  const Point2 centre = pose.best().position();
  pictures::Figure figure{moment_of(log, pose.scan)};
  pictures::Axes& axes =
      figure.add(pictures::Axes::metres(centre - Point2{kAround, kAround}, centre + Point2{kAround, kAround}, 360.0));
  pictures::draw_map(axes, map);
  const recording::LoggedScan& scan = log.scans[pose.scan];
  const pictures::Color color = color_when(pose.is_known());
  pictures::draw_points(axes, endpoints_at(scan, log.max_range, pose.best() * scan.base_from_laser), 2.5, color);
  pictures::draw_robot(axes, pose.best(), kRobotRadius, color);
  pictures::add_map_legend(figure);
  add_robot_legend(figure);
  return figure;
}

namespace {

/// What the ways and the scans beside them take of the map, and some metres about it.
pictures::Axes cropped_axes(const OccupancyGrid& map, const std::vector<Point2>& shown) {
  constexpr double kMargin = 1.5;  // [m]
  if (shown.empty()) return pictures::Axes::metres(map.frame);
  Point2 low = shown.front(), high = shown.front();
  for (const Point2& point : shown) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  const Point2 origin = map.frame.origin;
  const Point2 end = origin + Point2{map.frame.columns * map.frame.resolution, map.frame.rows * map.frame.resolution};
  low = {std::max(low.x - kMargin, origin.x), std::max(low.y - kMargin, origin.y)};
  high = {std::min(high.x + kMargin, end.x), std::min(high.y + kMargin, end.y)};
  if (!(high.x > low.x && high.y > low.y)) return pictures::Axes::metres(map.frame);
  return pictures::Axes::metres(low, high);
}

/// Everything that `draw_run` shows beside the map [m].
std::vector<Point2> shown_points(const recording::LaserLog& log, const LogRun& run, std::size_t stride) {
  std::vector<Point2> shown;
  for (std::size_t i = 0; i < run.poses.size(); ++i) {
    const LoggedPose& pose = run.poses[i];
    if (!pose.has_best()) continue;
    shown.push_back(pose.best().position());
    if (i % stride != 0 || !pose.is_known()) continue;
    const auto ends =
        endpoints_at(log.scans[i], std::min(log.max_range, kShownReach), pose.best() * log.scans[i].base_from_laser);
    shown.insert(shown.end(), ends.begin(), ends.end());
  }
  return shown;
}

/// Where what is known begins and ends, by the time of the log.
void draw_ends(pictures::Figure& figure, pictures::Axes& axes, const LogRun& run) {
  const auto is_known = [](const LoggedPose& pose) { return pose.is_known(); };
  const auto first = std::find_if(run.poses.begin(), run.poses.end(), is_known);
  if (first == run.poses.end()) return;
  const auto last = std::find_if(run.poses.rbegin(), run.poses.rend(), is_known);
  constexpr double kSize = 7.0;  // [points]
  const Point2 start = first->best().position(), end = last->best().position();
  pictures::draw_points(axes, std::span{&start, 1}, kSize, kStart);
  pictures::draw_points(axes, std::span{&end, 1}, kSize, kEnd);
  figure.add_legend(pictures::legend_disc("start of what is known", kSize, kStart));
  figure.add_legend(pictures::legend_disc("end of it", kSize, kEnd));
}

struct WayLook {
  WayKind kind;
  pictures::Color color;
  const char* words;
};
// In the order of drawing: what is known lies on top.
constexpr std::array<WayLook, 4> kWays{
    {{WayKind::kUnsure, pictures::colors::kGrey, "best hypothesis while unsure"},
     {WayKind::kTakenBack, pictures::colors::kRed, "where it said that it was, taken back in hindsight"},
     {WayKind::kHindsight, pictures::colors::kBlue, "trajectory known in hindsight"},
     {WayKind::kSaid, pictures::colors::kInk, "trajectory while localized"}}};

}  // namespace

pictures::Figure draw_run(const OccupancyGrid& map, const recording::LaserLog& log, const LogRun& run,
                          std::size_t stride, const std::vector<std::optional<Pose2>>& reference) {
  const double end = seconds_into(log, log.scans.size() - 1);
  std::array<char, 60> title{};
  std::snprintf(title.data(), title.size(), "Scans 0 to %zu, 0 to %.0f s", log.scans.size() - 1, end);
  pictures::Figure figure{title.data()};
  pictures::Axes& axes = figure.add(cropped_axes(map, shown_points(log, run, stride)));
  pictures::draw_map(axes, map);
  pictures::add_map_legend(figure);
  std::vector<Point2> true_way;
  for (const auto& pose : reference)
    if (pose) true_way.push_back(pose->position());
  if (true_way.size() > 1) {
    pictures::draw_path(axes, true_way, kReferenceWay, kReference);
    figure.add_legend(pictures::legend_line("reference trajectory", kReferenceWay, kReference));
  }
  const auto color_at = [end](double seconds) { return pictures::rainbow(end > 0.0 ? seconds / end : 0.0); };
  for (const auto& [kind, color, words] : kWays)
    for (const std::vector<Point2>& way : ways_of(log, run, kind)) pictures::draw_path(axes, way, kWay, color);
  for (std::size_t i = 0; i < run.poses.size(); i += stride) {
    const LoggedPose& pose = run.poses[i];
    if (!pose.is_known()) continue;
    const pictures::Color color = color_at(seconds_into(log, i));
    pictures::draw_points(axes, endpoints_at(log.scans[i], log.max_range, pose.best() * log.scans[i].base_from_laser),
                          kDot, color);
    pictures::draw_robot(axes, pose.best(), kRobotRadius, color);
  }
  draw_ends(figure, axes, run);
  for (const auto& [kind, color, words] : kWays)
    if (kind == WayKind::kSaid || !ways_of(log, run, kind).empty())
      figure.add_legend(pictures::legend_line(words, kWay, color));
  figure.add_legend(
      pictures::legend_disc("robot and scan, some of them, at the time of their colour", 6.0, color_at(0.5 * end)));
  if (end > 0.0) axes.set_color_bar({"time [s]", color_at, 0.0, end, false});
  return figure;
}

}  // namespace docent::apps::localize_command
