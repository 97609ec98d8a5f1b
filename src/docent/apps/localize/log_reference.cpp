#include "docent/apps/localize/log_reference.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <utility>

#include "docent/apps/localize/log_lies.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/log_defaults.h"

namespace docent::apps::localize_command {
namespace {

/// Keeps the scans for which `keep` says so, and their reference.
void filter_scans(ReferencedLog& referenced, const std::function<bool(std::size_t)>& keep) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < referenced.log.scans.size(); ++i) {
    if (!keep(i)) continue;
    if (kept != i) {
      referenced.log.scans[kept] = std::move(referenced.log.scans[i]);
      referenced.reference[kept] = referenced.reference[i];
    }
    ++kept;
  }
  referenced.log.scans.resize(kept);
  referenced.reference.resize(kept);
}

}  // namespace

void add_log_options(CLI::App& command, LogChoice& choice) {
  command
      .add_option("--log", choice.log,
                  "CARMEN text log (plain or .gz), MCAP recording, rosbag2 folder or database, or bag of ROS 1")
      ->required();
  add_topic_options(command, choice.topics);
  add_times_option(command, choice.times);
  command.add_option("--reference", choice.reference,
                     "where the robot truly was: a file of \"time x y theta\" [s, m, rad], or logged: the log is a "
                     "corrected one and holds the poses itself");
  command.add_option("--scans", choice.scans, "all, odd, even: which of the log's scans are used")
      ->check(CLI::IsMember({"all", "odd", "even"}))
      ->capture_default_str();
}

ReferencedLog load_referenced_log(const LogChoice& choice, const evaluation::ReferenceGaps& gaps) {
  const recording::LaserLogOptions options{.topics = choice.topics, .times = times_of(choice.times)};
  ReferencedLog referenced{value_or_fail(recording::read_laser_log(choice.log, options)), {}};
  const recording::LaserLog& log = referenced.log;
  if (!log.sources.empty()) std::fprintf(stderr, "note: %s is read as %s\n", choice.log.c_str(), log.sources.c_str());
  for (std::string& lie : lies_in(log)) referenced.log.notes.push_back(std::move(lie));
  if (choice.reference.empty()) {
    referenced.reference.resize(log.scans.size());
  } else if (choice.reference == "logged") {
    referenced.reference = evaluation::logged_reference(log);
  } else {
    referenced.reference =
        evaluation::reference_of(log, value_or_fail(evaluation::load_timed_poses(choice.reference)), gaps);
    if (std::none_of(referenced.reference.begin(), referenced.reference.end(), [](const auto& p) { return !!p; }))
      throw CommandFailed{choice.reference + ": no pose at the time of any scan of " + choice.log};
  }
  if (choice.scans == "all") return referenced;
  const std::size_t first = choice.scans == "odd" ? 0 : 1;
  filter_scans(referenced, [&](std::size_t i) { return i % 2 == first; });
  if (log.scans.empty()) throw CommandFailed{choice.log + ": holds no " + choice.scans + " scan"};
  return referenced;
}

void replace_odometry(ReferencedLog& referenced, const evaluation::OdometryNoiseParams& noise, std::uint64_t seed) {
  const evaluation::ScanReference before = referenced.reference;
  filter_scans(referenced, [&](std::size_t i) { return before[i].has_value(); });
  if (referenced.log.scans.empty()) throw CommandFailed{"odometry cannot be made: no scan has a reference", 2};
  std::vector<Pose2> way;
  for (const auto& pose : referenced.reference) way.push_back(*pose);
  const std::vector<Pose2> odometry = evaluation::noisy_odometry(way, noise, Rng{seed}.stream("odometry"));
  for (std::size_t i = 0; i < odometry.size(); ++i) referenced.log.scans[i].odom_from_base = odometry[i];
  referenced.log.odometry.clear();
}

void begin_where_known(ReferencedLog& referenced) {
  const evaluation::ScanReference& reference = referenced.reference;
  const auto known = [](const std::optional<Pose2>& pose) { return pose.has_value(); };
  const auto first = std::find_if(reference.begin(), reference.end(), known) - reference.begin();
  const auto after = reference.rend() - std::find_if(reference.rbegin(), reference.rend(), known);
  if (after == 0) throw CommandFailed{"--start reference: no scan has a reference (--reference)", 2};
  filter_scans(referenced, [&](std::size_t i) {
    return i >= static_cast<std::size_t>(first) && i < static_cast<std::size_t>(after);
  });
}

}  // namespace docent::apps::localize_command
