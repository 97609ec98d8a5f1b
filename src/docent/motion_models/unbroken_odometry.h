#pragma once

#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::motion_models {

/// What a base can do at most (robot.yaml, section body).
struct BaseReach {
  double max_speed = 0.8;      ///< [m/s]
  double max_turn_rate = 1.2;  ///< [rad/s]
  /// [s] for which it may go on while nobody hears its odometry: it is stopped then. Who is longer silent and comes
  /// back elsewhere has begun anew.
  double longest_unheard = 2.0;
  /// Of a base that nobody has described and that was driven by others, as in a recording.
  [[nodiscard]] static BaseReach of_any() { return {2.0, 3.0, 1e9}; }
};

struct UnbrokenOdometryParams {
  BaseReach base{};
  double margin = 1.5;  ///< of the base's speeds: who pushes or steers it by hand is faster than it drives itself
  double linear_noise = 0.06;    ///< [m] in a step that is none of the base
  double angular_noise = 0.087;  ///< [rad] likewise
  double jitter = 0.03;          ///< [s] by which a stamp may be wrong although all were regular
  double most_held = 0.5;        ///< [s] by which messages may have been held
  double held_memory = 1.0;      ///< [s] in which it is forgotten that messages were held: drops look the same
  double learning = 0.1;         ///< an interval's share in the usual one
  double longest_frozen = 3.0;   ///< [s] the robot may have driven on meanwhile
  double in_full_drive = 0.1;    ///< [m/s], [rad/s]: no base stands from it within one reading
  double reboot = 1.0;           ///< [s] a clock that is set back so far tells nothing of how long nothing came
  double pause = 1.0;            ///< [s] without a message, after which who comes back near zero has begun anew
  double near_zero = 0.05;       ///< [m], [rad] likewise: its first message may tell of some motion already
  int enough = 3;  ///< readings in succession older than the newest, by rising stamps: the clock was set back
};

/// Odometry whose jumps are taken out: an encoder that skips, a driver that begins anew at zero. No base makes such a
/// step, so the robot has not moved by it; what is kept in the odometry's frame would be torn by it.
///
/// A step is a jump when it is longer than the base can go, by `BaseReach`, in the time that it may have taken. That is
/// the time between the stamps, or the usual one where that is longer, and what stamps can hide: those of a driver that
/// stamps on arrival come late after a stall, and those that were held meanwhile follow at once. So each interval that
/// is longer than usual is credit for the shorter ones after it, as in a leaky bucket; where stamps are regular there
/// is none, and steps of some centimetres show. Nothing else is carried from reading to reading: whatever came before,
/// the next step is judged by the last pose alone. A pose of exactly zero far from the last one is a jump after any
/// pause, and so is one near zero after a pause in which nothing came.
///
/// A reading that is older than the last one tells nothing new (reordered or doubled), unless some come in succession
/// by rising stamps: then the clock was set back, and they count. An odometry that repeats itself in full drive is
/// taken for frozen, not for standing, and is believed again wherever it wakes. O(1) a reading.
class UnbrokenOdometry {
 public:
  explicit UnbrokenOdometry(const UnbrokenOdometryParams& params = {}) : params_{params} {}
  explicit UnbrokenOdometry(const BaseReach& base) { params_.base = base; }

  struct Reading {
    Pose2 odom_from_base;      ///< without jumps: the same as the odometry's own until the first one
    bool jumped = false;       ///< in this reading
    bool is_late = false;      ///< older than what came before, or a double: `odom_from_base` is that of the newest
    bool is_set_back = false;  ///< the clock was set back: the stamps of all readings before are of another time
  };

  /// Readings in the order in which they came.
  Reading add(Time stamp, const Pose2& raw_from_base);

  /// From the odometry's own frame, as it was at `stamp`, to the one without jumps. Knows the last jump only.
  [[nodiscard]] const Pose2& odom_from_raw(Time stamp) const;
  /// Stamp of the last jump; long ago before the first.
  [[nodiscard]] Time jumped() const { return jumped_; }

 private:
  struct Gap {
    double elapsed = 0.0;  ///< [s] by stamps, or as usual
    double longest = 0.0;  ///< [s] that may have passed in truth
  };
  [[nodiscard]] bool counts(Time stamp);
  [[nodiscard]] Gap gap_to(Time stamp, bool is_set_back) const;
  void learn(double interval);
  [[nodiscard]] bool begins_anew(const Gap& gap, const Pose2& raw_from_base) const;
  [[nodiscard]] bool is_jump(const Gap& gap, const Pose2& raw_from_base, const Pose2& motion) const;
  [[nodiscard]] bool in_full_drive() const;
  void leave_out_step(Time stamp, const Gap& gap, const Pose2& raw_from_base);

  UnbrokenOdometryParams params_;
  std::optional<Time> stamp_;  ///< of the newest reading that counts
  Time late_stamp_{};          ///< of the last one that was older
  int late_ = 0;               ///< readings older than the newest, since it came
  int rising_ = 0;             ///< of these, in succession by rising stamps
  double period_ = 0.0;        ///< [s] usual between two; 0: not known
  double held_ = 0.0;          ///< [s] by which the newest stamp may be late
  Time changed_{};             ///< when the pose last counted: it changed, or the base stands
  Pose2 raw_from_base_;        ///< newest
  double linear_ = 0.0;        ///< [m/s] of the last step that was no jump
  double angular_ = 0.0;       ///< [rad/s]
  Pose2 odom_from_raw_;        ///< now
  Pose2 odom_from_raw_before_;
  Time jumped_{};
};

}  // namespace docent::motion_models
