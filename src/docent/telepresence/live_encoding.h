#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/time.h"
#include "docent/messages/driving_messages.h"
#include "docent/messages/interaction_messages.h"
#include "docent/messages/localization_messages.h"
#include "docent/messages/mission_messages.h"
#include "docent/messages/operation_messages.h"
#include "docent/messages/people_messages.h"
#include "docent/messages/request_messages.h"
#include "docent/telepresence/belief_carrier.h"
#include "docent/telepresence/tour_votes.h"
#include "docent/vocabulary/reason.h"

// What viewers get, as JSON text; docs/web-protocol.md describes it. Times are seconds of the bus's clock, lengths
// metres, angles radians; points of a scan are whole centimetres.

namespace docent::telepresence {

/// What moves, several times a second.
struct LiveFrame {
  Time now;
  std::optional<Pose2> map_from_base;  ///< empty: the robot does not know where it is
  double linear = 0.0;                 ///< [m/s]
  double angular = 0.0;                ///< [rad/s]
  double p_lost = 1.0;
  std::vector<CarriedHypothesis> hypotheses;  ///< while it does not know
  bool is_scan_in_map = false;                ///< else in the robot's frame
  Point2 scan_origin;                         ///< of the robot when it was taken, in the scan's frame
  std::vector<Point2> scan;
  docent_msgs::People people;
  std::optional<docent_msgs::AvoidState> avoid;
  std::optional<double> battery;  ///< 0..1
};

/// A module's health as last heard.
struct HealthEntry {
  docent_msgs::Health health;
  Time heard;
};

[[nodiscard]] std::string encode_live(const LiveFrame& frame);
/// Of the same frame what costs little: where the robot is, and how fast.
[[nodiscard]] std::string encode_pose(const LiveFrame& frame);
[[nodiscard]] std::string encode_belief(const docent_msgs::Belief& belief);
[[nodiscard]] std::string encode_path(const nav_msgs::Path& path, const docent_msgs::GoalState& state);
[[nodiscard]] std::string encode_mission(const docent_msgs::MissionState& mission);
[[nodiscard]] std::string encode_speech(const docent_msgs::SpeechState& speech);
/// The horn sounds at `t`; `file`: what it sounds like, HASH.wav, or empty while the robot is muted.
[[nodiscard]] std::string encode_horn(Time t, const std::string& file, double duration_s);
[[nodiscard]] std::string encode_sound(const docent_msgs::SoundState& sound);
/// Rounded, so that a face that is at rest gives the same text; a word that is no mood is neutral.
[[nodiscard]] std::string encode_expression(const docent_msgs::Expression& expression);
/// The button was pressed at `t`.
[[nodiscard]] std::string encode_button(Time t, int number);
/// All open requests and the newest closed ones. Viewers see the last 8 digits of an id only: who knows all of it may
/// cancel the request.
[[nodiscard]] std::string encode_board(const docent_msgs::RequestBoard& board);
[[nodiscard]] std::string encode_votes(const Tally& tally);
/// @param next_mode  comes next by itself; empty: none does. @param next_at  "HH:MM"
[[nodiscard]] std::string encode_hours(const std::string& mode, bool is_open, const std::string& next_mode = "",
                                       const std::string& next_at = "");
/// A module that was not heard for 2 s is silent. `viewers`: how many watch.
[[nodiscard]] std::string encode_health(const std::map<std::string, HealthEntry>& modules, std::size_t viewers,
                                        Time now);
/// The evaluated velocity window, for specialists.
[[nodiscard]] std::string encode_window(const docent_msgs::AvoidState& avoid);

/// @param virtual_scan  as fault_of_virtual_scan describes it; may be empty
[[nodiscard]] std::string encode_field(const sensor_msgs::LaserScan& virtual_scan,
                                       const docent_msgs::PersonBeams& beams);
[[nodiscard]] std::string encode_acknowledgement(const std::string& id);
/// @pre reason.word()
[[nodiscard]] std::string encode_refusal(const std::string& id, const Reason& reason);
[[nodiscard]] std::string encode_error(const Reason& reason);

/// Every n-th reading of a scan as points in the robot's frame; invalid readings are left out, those without a return
/// end at the largest range.
[[nodiscard]] std::vector<Point2> scan_points(const sensor_msgs::LaserScan& scan, const Pose2& base_from_sensor,
                                              std::size_t every);

}  // namespace docent::telepresence
