#include "docent/evaluation/reference/reference_poses.h"

#include <algorithm>
#include <cmath>

#include "docent/base/files.h"
#include "docent/evaluation/reference/number_lines.h"

namespace docent::evaluation {
namespace {

constexpr double kSameTime = 1e-5;    // [s]
constexpr double kOwnScans = 0.05;    // of the scans have a pose's very time, and more: the poses are of these scans
constexpr double kMetreOfTurn = 0.5;  // [m/rad] a turn is worth that much of a way

Pose2 between(const Pose2& a, const Pose2& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          a.theta + Angle::radians(share * (b.theta - a.theta).radians())};
}

/// Odometry at any time, between the readings of a log.
class OdometryTrack {
 public:
  explicit OdometryTrack(const recording::LaserLog& log) {
    for (const recording::LoggedScan& scan : log.scans) track_.push_back({scan.time, scan.odom_from_base});
    for (const recording::LoggedOdometry& reading : log.odometry)
      track_.push_back({reading.time, reading.odom_from_base});
    std::stable_sort(track_.begin(), track_.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  }
  [[nodiscard]] Pose2 at(Time time) const {
    const auto after =
        std::lower_bound(track_.begin(), track_.end(), time, [](const auto& a, Time t) { return a.time < t; });
    if (after == track_.end()) return track_.back().map_from_base;
    if (after == track_.begin() || after->time == time) return after->map_from_base;
    const auto before = std::prev(after);
    return between(before->map_from_base, after->map_from_base,
                   to_seconds(time - before->time) / to_seconds(after->time - before->time));
  }

 private:
  std::vector<TimedPose> track_;
};

double length(const Pose2& motion) { return norm(motion.position()) + kMetreOfTurn * std::abs(motion.theta.radians()); }

/// Where two poses and odometry disagree so little that odometry tells the way between them.
bool agrees(const Pose2& missed, const ReferenceGaps& gaps) {
  return norm(missed.position()) <= gaps.most_missed && std::abs(missed.theta.degrees()) <= gaps.most_missed_degrees;
}

/// Fills the scans between `from` and `to`, whose poses are known.
void follow_odometry(const recording::LaserLog& log, std::size_t from, std::size_t to, const ReferenceGaps& gaps,
                     ScanReference& reference) {
  const auto carried = [&](std::size_t i) {
    return *reference[from] * (inverse(log.scans[from].odom_from_base) * log.scans[i].odom_from_base);
  };
  const Pose2 missed = inverse(carried(to)) * *reference[to];
  if (!agrees(missed, gaps)) return;
  std::vector<double> way{0.0};  // odometry errs by the way, not by the time
  for (std::size_t i = from + 1; i <= to; ++i)
    way.push_back(way.back() + length(inverse(log.scans[i - 1].odom_from_base) * log.scans[i].odom_from_base));
  for (std::size_t i = from + 1; i < to; ++i)
    reference[i] = carried(i) * between({}, missed, way.back() > 0.0 ? way[i - from] / way.back() : 0.0);
}

/// The poses at the very times of scans.
ScanReference poses_at_scans(const recording::LaserLog& log, std::span<const TimedPose> poses) {
  ScanReference reference(log.scans.size());
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const Time time = log.scans[i].time;
    const auto after =
        std::lower_bound(poses.begin(), poses.end(), time, [](const auto& a, Time t) { return a.time < t; });
    double nearest = kSameTime;
    for (const auto near : {after, after == poses.begin() ? after : std::prev(after)}) {
      if (near == poses.end() || std::abs(to_seconds(near->time - time)) > nearest) continue;
      nearest = std::abs(to_seconds(near->time - time));
      reference[i] = near->map_from_base;
    }
  }
  return reference;
}

/// Fills the scans between poses that another clock stamped.
void follow_time(const recording::LaserLog& log, std::span<const TimedPose> poses, const ReferenceGaps& gaps,
                 ScanReference& reference) {
  const OdometryTrack odometry{log};
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const Time time = log.scans[i].time;
    const auto after =
        std::lower_bound(poses.begin(), poses.end(), time, [](const auto& a, Time t) { return a.time < t; });
    if (reference[i] || after == poses.begin() || after == poses.end()) continue;
    const TimedPose& from = *std::prev(after);
    const TimedPose& to = *after;
    const double apart = to_seconds(to.time - from.time);
    const double turn = (to.map_from_base.theta - from.map_from_base.theta).degrees();
    if (apart > gaps.most_seconds || std::abs(turn) > gaps.most_degrees) continue;
    const Pose2 odom_from_base = odometry.at(from.time);
    const auto carried = [&](Time at) { return from.map_from_base * (inverse(odom_from_base) * odometry.at(at)); };
    const Pose2 missed = inverse(carried(to.time)) * to.map_from_base;
    if (!agrees(missed, gaps)) continue;
    reference[i] = carried(time) * between({}, missed, to_seconds(time - from.time) / apart);
  }
}

}  // namespace

Result<std::vector<TimedPose>> parse_timed_poses(std::string_view text, const std::string& name) {
  const auto lines = parse_number_lines(text, name, "time x y theta");
  if (!lines) return tl::unexpected<Error>(lines.error());
  std::vector<TimedPose> poses;
  for (const std::vector<double>& line : *lines) {
    poses.push_back({time_from_seconds(line[0]), {line[1], line[2], Angle::radians(line[3])}});
  }
  if (poses.empty()) return fail(name + ": holds no pose");
  std::stable_sort(poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return poses;
}

Result<std::vector<TimedPose>> load_timed_poses(const std::filesystem::path& path) {
  const auto text = read_maybe_gzipped(path);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse_timed_poses(*text, path.string());
}

ScanReference reference_of(const recording::LaserLog& log, std::span<const TimedPose> poses,
                           const ReferenceGaps& gaps) {
  ScanReference reference(log.scans.size());
  if (poses.empty()) return reference;
  reference = poses_at_scans(log, poses);
  std::vector<std::size_t> known;
  std::size_t in_time = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (reference[i]) known.push_back(i);
    in_time += log.scans[i].time >= poses.front().time && log.scans[i].time <= poses.back().time ? 1 : 0;
  }
  if (known.size() < 2 || static_cast<double>(known.size()) < kOwnScans * static_cast<double>(in_time)) {
    follow_time(log, poses, gaps, reference);
  } else if (gaps.between_own_scans) {
    for (std::size_t n = 1; n < known.size(); ++n) follow_odometry(log, known[n - 1], known[n], gaps, reference);
  }
  return reference;
}

ScanReference logged_reference(const recording::LaserLog& log) {
  ScanReference reference;
  reference.reserve(log.scans.size());
  for (const recording::LoggedScan& scan : log.scans) {
    // Where both poses of a line agree but for the laser's mount, they are the laser's and the robot's.
    const Pose2 base = scan.logged_pose * inverse(scan.base_from_laser);
    const bool is_laser = distance(base.position(), scan.odom_from_base.position()) < 0.05 &&
                          std::abs((base.theta - scan.odom_from_base.theta).radians()) < 0.1;
    reference.emplace_back(is_laser ? base : scan.logged_pose);
  }
  return reference;
}

}  // namespace docent::evaluation
