#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/collision_avoidance/local_planner/speed_cap.h"
#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"
#include "docent/collision_avoidance/plausibility/scanner_watch.h"
#include "docent/collision_avoidance/watches/complaint.h"
#include "docent/collision_avoidance/watches/freshness.h"
#include "docent/collision_avoidance/watches/odometry_watch.h"
#include "docent/collision_avoidance/watches/ring_watch.h"
#include "docent/collision_avoidance/watches/tactile_watch.h"

namespace docent::collision_avoidance {

struct InputWatchesParams {
  bool needs_sonar = true;    ///< complains about sonars that never spoke
  bool has_infrared = false;  ///< likewise about these rings
  bool has_tactile = false;
  double virtual_timeout = 1.5;  ///< [s] without new virtual measurements, then the robot stands
  double nearly_all = 0.9;       ///< of a sweep's readings are none: the laser is covered or has failed
  double many_missing = 0.35;    ///< of a sweep's readings are none: more than black clothes and glass ever take
  double crippled_speed = 0.25;  ///< [m/s] as ComplaintParams::crippled_speed, with such a laser
  double camera_patience = 1.5;  ///< [s] a camera sees a few pictures a second, and may look away from one
  double fresh = 0.2;            ///< [s] what is so old costs no speed: lasers and odometry come ten times a second
  double fading = 0.3;           ///< [s] in which, from then on, all speed goes
  double position_fresh = 0.6;   ///< [s] likewise, of virtual measurements: beliefs come less often
  double position_worn = 0.3;    ///< [m] of driving after which the measurements of before are worth nothing
  double nearly_due = 0.25;      ///< of a period: a fast laser is not for ever about to come
};

/// Watches all that the robot hears: what is stale, silent, frozen or half gone, and how fast it may still drive.
class InputWatches {
 public:
  /// @param lasers  their names for a person
  InputWatches(const BaseLimits& limits, const InputWatchesParams& params, std::vector<std::string> lasers)
      : params_{params}, lasers_{std::move(lasers)}, sweeps_(lasers_.size()), odometry_{limits} {
    know_map(limits, nullptr);
  }

  /// What the sweeps are compared with; before the first of them. @param map  null: there is none
  void know_map(const BaseLimits& limits, const std::shared_ptr<const OccupancyGrid>& map) {
    scanners_.clear();
    const auto walls = known_walls(map);
    for (const std::string& name : lasers_) scanners_.emplace_back(name, limits, walls);
  }
  [[nodiscard]] std::size_t lasers() const { return lasers_.size(); }

  // Each takes the local time of receipt, and the stamp by whatever clock.
  void hear_odometry(Time now, Time stamp, const BaseState& state, bool jumped, const CommandHistory& commands) {
    odometry_.receive(now, stamp, state, jumped, commands);
  }
  void hear_sweep(Time now, Time stamp, std::size_t laser) { sweeps_[laser].receive(now, stamp); }
  /// The sweep as far as it is to be believed. @param odom_from_base  at its stamp, which is local time
  [[nodiscard]] SensorSweep judge_sweep(std::size_t laser, SensorSweep sweep, const Pose2& odom_from_base,
                                        bool is_motion_known) {
    std::vector<ScannerWatch::Word> others;
    for (std::size_t i = 0; i < scanners_.size(); ++i)
      if (i != laser) others.push_back(scanners_[i].word());
    return scanners_[laser].judge(std::move(sweep), odom_from_base, is_motion_known, others, echoes_.all());
  }
  /// Whether its newest sweep can follow those before it.
  [[nodiscard]] Succession::Finding succession_of(std::size_t laser) const { return scanners_[laser].word().follows; }
  /// Where the robot believes to be, odometry's frame at `stamp`. @param mass  of the belief there
  void believe(Time stamp, const Pose2& map_from_odom, double mass) {
    for (ScannerWatch& scanner : scanners_) scanner.believe(stamp, map_from_odom, mass);
  }
  void hear_sonar(Time now, Time stamp, std::size_t index, const SonarReading& reading, const Pose2& odom_from_base) {
    sonars_.hear(now, stamp, index, reading.range, reading.range < reading.max_range, odom_from_base);
    echoes_.hear(0, index, reading, odom_from_base);
  }
  void hear_infrared(Time now, Time stamp, std::size_t index, const SonarReading& reading,
                     const Pose2& odom_from_base) {
    infrareds_.hear(now, stamp, index, reading.range, reading.range < reading.max_range, odom_from_base);
    echoes_.hear(1, index, reading, odom_from_base);
  }
  void hear_lines(Time now, Time stamp, const std::string& camera) { cameras_[camera].receive(now, stamp); }
  void feel(Time now, Time stamp, std::span<const std::uint8_t> segments, std::uint32_t scan) {
    tactile_.feel(now, stamp, segments, scan);
  }
  void hear_virtual(Time now, Time stamp) { virtual_.receive(now, stamp); }

  /// The worst of all; nullopt when all is well. @param memory  of what the lasers met
  [[nodiscard]] std::optional<Complaint> complaint(Time now, const ObstacleMemory& memory) const;
  /// Slower the older the odometry and the sweeps are.
  void cap_by_age(Time now, double max_speed, SpeedCap& cap) const;
  /// Slow until motion or the map has borne out every laser.
  void cap_by_proof(SpeedCap& cap) const;
  /// Slower the older the virtual measurements are: what was computed for where the robot was still holds while it
  /// stands; driving wears it out.
  /// @param driven  [m] since they were taken
  void cap_by_position(Time now, double driven, double max_speed, SpeedCap& cap) const;
  /// True when another laser's sweep is due by its period within `soon` [s].
  [[nodiscard]] bool await_sweep(Time now, double soon) const;

 private:
  [[nodiscard]] std::optional<Complaint> complaint_of_laser(Time now, std::size_t index,
                                                            const ObstacleMemory& memory) const;
  [[nodiscard]] std::optional<Complaint> complaint_of_lasers(Time now, const ObstacleMemory& memory) const;

  InputWatchesParams params_;
  std::vector<std::string> lasers_;
  std::vector<Freshness> sweeps_;       ///< [lasers]
  std::vector<ScannerWatch> scanners_;  ///< [lasers]
  RingEchoes echoes_;
  OdometryWatch odometry_;
  RingWatch sonars_{"sonar reading", "sonars"};
  RingWatch infrareds_{"infrared reading", "infrared sensors"};
  TactileWatch tactile_;
  std::map<std::string, Freshness> cameras_;  ///< by their lines; one that has sent must go on
  Freshness virtual_;
};

}  // namespace docent::collision_avoidance
