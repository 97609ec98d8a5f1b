#include "docent/apps/localize/localize_log.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "docent/apps/shared/log_defaults.h"
#include "docent/base/files.h"
#include "docent/localization/beam_choice/moved_things.h"
#include "docent/localization/judgement/told_pose.h"
#include "docent/localization/judgement/view_matcher.h"

namespace docent::apps::localize_command {

namespace {

using WallClock = std::chrono::steady_clock;

constexpr const char* kHeader =
    "scan,time,x,y,heading_deg,has_pose,localized,p_lost,hindsight_x,hindsight_y,hindsight_heading_deg,mass,share,"
    "confirmation,agreement,contradiction,surprise,hidden,unmapped,spread";
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // in a file: "nan"

/// First and last scan, in the order of the log, from which on (until which) a run knew where it was.
std::pair<std::size_t, std::size_t> known_span(const std::vector<LoggedPose>& poses) {
  std::size_t first = 0;
  while (first < poses.size() && !poses[first].is_known()) ++first;
  std::size_t last = poses.size();
  while (last > first && !poses[last - 1].is_known()) --last;
  return {first, last};
}

}  // namespace

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(q * static_cast<double>(values.size())))];
}

sensor_models::RangeSweep sweep_of(const recording::LoggedScan& scan, double max_range) {
  sensor_models::RangeSweep sweep;
  const double reach = scan.max_range > 0.0 ? std::min(scan.max_range, max_range) : max_range;
  sensor_models::append(sweep, {scan.ranges, scan.first_bearing, scan.bearing_step, 0.02, reach}, {});
  return sweep;
}

double moving_share(const recording::LaserLog& log) {
  constexpr std::size_t kPairs = 150;
  constexpr double kApart = 0.8, kMostApart = 1.6;    // [s]: who walks has left his place, and odometry still holds
  constexpr double kMostWay = 1.0, kMostTurn = 60.0;  // [m], [deg]: farther they see other things
  localization::MovedThings sum;
  const std::size_t stride = std::max<std::size_t>(1, log.scans.size() / kPairs);
  for (std::size_t i = 0; i < log.scans.size(); i += stride) {
    const recording::LoggedScan& before = log.scans[i];
    const auto is_partner = [&](const recording::LoggedScan& scan) {
      return scan.rear == before.rear && to_seconds(scan.time - before.time) >= kApart;
    };
    const auto now = std::find_if(log.scans.begin() + static_cast<std::ptrdiff_t>(i), log.scans.end(), is_partner);
    if (now == log.scans.end() || to_seconds(now->time - before.time) > kMostApart) continue;
    const Pose2 moved =
        inverse(before.odom_from_base * before.base_from_laser) * now->odom_from_base * now->base_from_laser;
    if (norm(moved.position()) > kMostWay || std::abs(moved.theta.degrees()) > kMostTurn) continue;
    sum += localization::moved_things(sweep_of(before, log.max_range), sweep_of(*now, log.max_range), moved);
  }
  return sum.share();
}

bool has_two_lasers(const recording::LaserLog& log) {
  return std::any_of(log.scans.begin(), log.scans.end(),
                     [&](const recording::LoggedScan& scan) { return scan.rear != log.scans.front().rear; });
}

Pose2 base_from_tracked(bool has_two_lasers, const recording::LoggedScan& scan) {
  return has_two_lasers ? Pose2{} : scan.base_from_laser;
}

namespace {

/// Odometry alone from a known pose on.
LoggedPose reckoned(const LoggedPose& from, const recording::LoggedScan& at_from, std::size_t scan,
                    const recording::LoggedScan& now) {
  LoggedPose pose = from;
  pose.scan = scan;
  pose.time = to_seconds(now.time);
  pose.map_from_base = from.map_from_base * (inverse(at_from.odom_from_base) * now.odom_from_base);
  return pose;
}

}  // namespace

LogRun localize_log(const recording::LaserLog& log, localization::Localizer& localizer, const LogRunOptions& options) {
  LogRun run;
  run.poses.resize(log.scans.size());
  const bool has_two = has_two_lasers(log);
  std::size_t fitted = 0;
  localization::ToldPose told;
  std::optional<std::size_t> known;  // the first scan at which the robot said where it is
  const double end = log.scans.empty() ? 0.0 : to_seconds(log.scans.back().time);
  for (std::size_t n = 0; n < log.scans.size(); ++n) {
    const std::size_t i = options.reverse ? log.scans.size() - 1 - n : n;
    const recording::LoggedScan& scan = log.scans[i];
    if (options.dead_reckoning && known) {
      run.poses[i] = reckoned(run.poses[*known], log.scans[*known], i, scan);
      continue;
    }
    const double logged = to_seconds(scan.time);
    const Time time = time_from_seconds(options.reverse ? end - logged : logged);
    const Pose2 tracked = base_from_tracked(has_two, scan);
    const Pose2 odom_from_tracked = scan.odom_from_base * tracked;
    if (n == 0 && options.start) {
      const localization::BeliefMode mode{*options.start * tracked, {0.04, 0, 0, 0, 0.04, 0, 0, 0, 0.01}, 1.0};
      localizer.start_at(std::span{&mode, 1}, odom_from_tracked, time);
    }
    const auto begin = WallClock::now();
    const sensor_models::RangeSweep of_laser = sweep_of(scan, log.max_range);
    const auto step = localizer.observe(has_two ? sensor_models::seen_from(of_laser, scan.base_from_laser) : of_laser,
                                        odom_from_tracked, time);
    const double seconds = std::chrono::duration<double>(WallClock::now() - begin).count();
    if (n == 0) run.seconds_first = seconds;
    if (step.updated) {
      run.seconds.push_back(seconds);
      run.beams_used += step.beams_used;
      run.beams_filtered += step.beams_filtered;
      ++run.updates;
      if (step.fit) {
        run.fit += *step.fit;
        ++fitted;
      }
    }
    LoggedPose& pose = run.poses[i];
    const localization::Verdict& verdict = localizer.verdict();
    pose = {.scan = i,
            .time = logged,
            .localized = verdict.localized(),
            .has_found = verdict.has_found(),
            .p_lost = verdict.p_lost(),
            .doubt = verdict.doubt()};
    const auto best = localizer.map_from_robot(odom_from_tracked);
    if (best) pose.best_mode = *best * inverse(tracked);
    if (const auto said = told.tell(best, odom_from_tracked, verdict.localized() || verdict.keeps_its_place())) {
      pose.map_from_base = *said * inverse(tracked);
      pose.has_pose = true;
    }
    if (!known && (pose.localized || options.start)) known = i;
    if (pose.localized && !run.localized_after) run.localized_after = n + 1;
    if (options.watch) options.watch(localizer, i, step);
  }
  run.fit = fitted > 0 ? run.fit / static_cast<double>(fitted) : -std::numeric_limits<double>::infinity();
  return run;
}

void look_back(const recording::LaserLog& log, bool reverse, const sensor_models::RayCaster& caster,
               localization::HindsightParams params, LogRun& run) {
  params.max_range = reach_of_log(log.max_range);
  const bool has_two = has_two_lasers(log);
  const std::size_t count = run.poses.size();
  const auto at = [&](std::size_t n) { return reverse ? count - 1 - n : n; };  // by the order of the run
  std::vector<localization::PastSweep> sweeps;
  for (std::size_t n = 0; n < count; ++n) {
    const recording::LoggedScan& scan = log.scans[at(n)];
    const LoggedPose& pose = run.poses[at(n)];
    const Pose2 tracked = base_from_tracked(has_two, scan);
    const sensor_models::RangeSweep of_laser = sweep_of(scan, log.max_range);
    sweeps.push_back({has_two ? sensor_models::seen_from(of_laser, scan.base_from_laser) : of_laser,
                      scan.odom_from_base * tracked,
                      pose.best_mode ? std::optional{*pose.best_mode * tracked} : std::nullopt, pose.has_found});
  }
  const auto poses = localization::seen_in_hindsight(caster, sweeps, params);
  for (std::size_t n = 0; n < count; ++n)
    if (poses[n]) run.poses[at(n)].hindsight = *poses[n] * inverse(base_from_tracked(has_two, log.scans[at(n)]));
}

bool LoggedPose::is_taken_back() const {
  return localized && hindsight && !localization::is_same_place(*hindsight, map_from_base);
}

std::optional<double> endpoints_near_walls(const recording::LaserLog& log, const LogRun& run,
                                           const sensor_models::RayCaster& caster, double distance) {
  std::size_t near = 0;
  std::size_t all = 0;
  const auto [first, last] = known_span(run.poses);
  for (std::size_t i = first; i < last; ++i) {
    if (!run.poses[i].has_best()) continue;
    const Pose2 map_from_laser = run.poses[i].best() * log.scans[i].base_from_laser;
    for (const sensor_models::SweepBeam& beam : sweep_of(log.scans[i], log.max_range).beams) {
      if (beam.no_return) continue;
      ++all;
      const float clearance = caster.clearance(map_from_laser * sensor_models::endpoint(beam));
      near += static_cast<double>(clearance) <= distance ? 1 : 0;
    }
  }
  if (all == 0) return std::nullopt;
  return static_cast<double>(near) / static_cast<double>(all);
}

RunAgreement agreement_of(const std::vector<LoggedPose>& first, const std::vector<LoggedPose>& second) {
  RunAgreement result;
  if (first.size() != second.size()) return result;
  const auto [first_from, first_to] = known_span(first);
  const auto [second_from, second_to] = known_span(second);
  std::vector<double> off;
  std::size_t agreed = 0;
  for (std::size_t i = std::max(first_from, second_from); i < std::min(first_to, second_to); ++i) {
    ++result.scans;
    if (!first[i].is_known() || !second[i].is_known()) continue;
    const Pose2& a = first[i].best();
    const Pose2& b = second[i].best();
    off.push_back(distance(a.position(), b.position()));
    const bool near = off.back() <= 0.5 && std::abs((a.theta - b.theta).degrees()) <= 10.0;
    agreed += near ? 1 : 0;
  }
  result.both_know = off.size();
  if (off.empty()) return result;
  result.share = static_cast<double>(agreed) / static_cast<double>(off.size());
  result.median_m = quantile(off, 0.5);
  result.p95_m = quantile(off, 0.95);
  result.max_m = *std::max_element(off.begin(), off.end());
  return result;
}

RunAgreement agreement_there_and_then(std::vector<LoggedPose> first, std::vector<LoggedPose> second) {
  for (std::vector<LoggedPose>* poses : {&first, &second})
    for (LoggedPose& pose : *poses) pose.hindsight.reset();
  return agreement_of(first, second);
}

Result<void> save_poses(const std::vector<LoggedPose>& poses, const std::string& path) {
  std::string text = std::string{kHeader} + "\n";
  for (const LoggedPose& pose : poses) {
    const localization::Doubt& doubt = pose.doubt;
    const Pose2 back = pose.hindsight.value_or(Pose2{kNone, kNone, {}});
    char line[300];
    std::snprintf(line, sizeof line,
                  "%zu,%.6f,%.4f,%.4f,%.3f,%d,%d,%.5f,%.4f,%.4f,%.3f,%.5f,%.5f,%.3f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f\n",
                  pose.scan, pose.time, pose.map_from_base.x, pose.map_from_base.y, pose.map_from_base.theta.degrees(),
                  pose.has_pose ? 1 : 0, pose.localized ? 1 : 0, pose.p_lost, back.x, back.y,
                  pose.hindsight ? back.theta.degrees() : kNone, doubt.mass, doubt.share, doubt.confirmation,
                  doubt.agreement, doubt.contradiction, doubt.surprise, doubt.hidden, doubt.unmapped, doubt.spread);
    text += line;
  }
  return write_file_atomically(path, text);
}

Result<std::vector<LoggedPose>> load_poses(const std::string& path) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  std::vector<LoggedPose> poses;
  std::size_t begin = 0;
  for (int line = 1; begin < text->size(); ++line) {
    std::size_t end = text->find('\n', begin);
    if (end == std::string::npos) end = text->size();
    const std::string content = text->substr(begin, end - begin);
    begin = end + 1;
    if (line == 1) {
      if (content != kHeader) return fail(path + ":1: expected the columns " + kHeader);
      continue;
    }
    LoggedPose pose;
    double degrees = 0.0;
    int has_pose = 0;
    int localized = 0;
    Pose2 back;
    double back_degrees = 0.0;
    int used = 0;
    localization::Doubt& doubt = pose.doubt;
    const int fields = std::sscanf(
        content.c_str(), "%zu,%lf,%lf,%lf,%lf,%d,%d,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf%n", &pose.scan,
        &pose.time, &pose.map_from_base.x, &pose.map_from_base.y, &degrees, &has_pose, &localized, &pose.p_lost,
        &back.x, &back.y, &back_degrees, &doubt.mass, &doubt.share, &doubt.confirmation, &doubt.agreement,
        &doubt.contradiction, &doubt.surprise, &doubt.hidden, &doubt.unmapped, &doubt.spread, &used);
    if (fields != 20 || static_cast<std::size_t>(used) != content.size() || pose.scan != poses.size())
      return fail(path + ":" + std::to_string(line) + ": expected the next scan as " + kHeader);
    pose.map_from_base.theta = Angle::degrees(degrees);
    pose.has_pose = has_pose != 0;
    pose.localized = localized != 0;
    back.theta = Angle::degrees(back_degrees);
    if (!std::isnan(back.x)) pose.hindsight = back;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace docent::apps::localize_command
