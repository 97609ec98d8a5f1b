#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "docent/apps/shared/robot_maker.h"
#include "docent/base/result.h"
#include "docent/evaluation/deployment_report.h"
#include "docent/geometry/pose2.h"
#include "docent/museum/museum.h"
#include "docent/robot/robot_config.h"

namespace docent::apps::replay_command {

struct ReplayOptions {
  std::string recording;
  std::vector<std::string> modules;  ///< empty: all that decide something (not record, web, sound)
  std::string out;                   ///< MCAP file of what happened this time; empty: none
  std::string claims;                ///< CSV file of every belief beside the truth; empty: none
  std::optional<Pose2> start;        ///< map_from_robot, told to localize at the first odometry; empty: unknown
  std::uint64_t seed = 1;
  std::string cache;                           ///< folder, see ModuleContext; empty: nothing is kept
  std::function<void(double share)> progress;  ///< may be empty
  std::shared_ptr<RobotMaker> robot_maker = std::make_shared<RobotMaker>();
};

/// An event as far as two runs can share it: not its time, not ids that each run makes anew.
struct ReplayEvent {
  double at_s = 0.0;  ///< since the start of the recording
  std::string kind;
  std::string subject;
  /// Of the mission, not of the executive on its way (docs/terminology.md, Events).
  [[nodiscard]] bool is_of_mission() const;
  friend bool operator==(const ReplayEvent& a, const ReplayEvent& b) {
    return a.kind == b.kind && a.subject == b.subject;
  }
};

struct ReplayOutcome {
  double seconds = 0.0;  ///< of the recording
  std::vector<std::string> modules;
  std::vector<std::string> replayed_topics;  ///< fed from the recording
  std::vector<ReplayEvent> recorded;  ///< docent/event of the recording; empty where no chosen module makes events
  std::vector<ReplayEvent> repeated;  ///< of this run
  std::optional<evaluation::DeploymentReport> report;  ///< where the recording holds the truth
};

/// Runs modules again in virtual time on what was recorded. Topics that the chosen modules publish are theirs; all
/// others come from the recording at their times. What the robot does now moves nothing: the sensors show what they
/// showed.
///
/// An answer of a visitor belongs to a question, and questions have new ids in every run: it is given when the same
/// exhibit's question is on show again.
///
/// Speech takes as long as it took, unless `sound` is among the chosen modules: the loudspeaker is hardware, too.
///
/// @pre the maker has read `config`.
/// Error: the recording is damaged, a module is unknown or refuses its configuration, `out` cannot be written.
[[nodiscard]] Result<ReplayOutcome> replay(const museum::Museum& museum, const robot::RobotConfig& config,
                                           const ReplayOptions& options);

/// Name of the museum in the recording's truth; empty where there is none.
[[nodiscard]] Result<std::string> museum_of_recording(const std::string& recording);

/// The first place where the mission's events of two runs differ in their order, in words; empty for none. What only
/// one of them has in the last five seconds of `duration_s` [s] is no difference: the end cuts them at slightly
/// different places.
[[nodiscard]] std::string first_difference(const std::vector<ReplayEvent>& recorded,
                                           const std::vector<ReplayEvent>& repeated, double duration_s);

/// How a replayed robot was crippled: as the recorded one, and as it is now. Both have ", " between their names, and so
/// has the result, which holds each name once.
[[nodiscard]] std::string names_of_both(const std::string& recorded, const std::string& now);

}  // namespace docent::apps::replay_command
