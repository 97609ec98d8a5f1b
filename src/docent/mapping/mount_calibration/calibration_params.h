#pragma once

#include "docent/base/result.h"
#include "docent/mapping/scan_matching/line_matcher.h"
#include "docent/mapping/scan_matching/point_sweep.h"

namespace docent::mapping {

/// When two sweeps of a scanner are laid onto each other.
struct ScanFollowerParams {
  double step = 0.08;        ///< [m], > 0: a sweep is looked at after this way
  double step_turn = 4.0;    ///< [deg], > 0: or this turn, by odometry;
  double first_way = 0.4;    ///< [m], > 0: and makes a pair with the one that was taken so far back,
  double way = 0.8;          ///< [m], >= first_way: or so far, once mounts are known: longer ways tell headings better
  double turn = 25.0;        ///< [deg], > 0: or turned by so much. More: fewer walls are in both
  double least_way = 0.25;   ///< [m], > 0: or so far, or
  double least_turn = 12.0;  ///< [deg], > 0: turned by so much, where the next sweep does not fit any more
  double longest = 4.0;      ///< [s], > 0: between both; people have changed places meanwhile
  double least_overlap = 0.45;    ///< 0..1: share of the points that must lie on surfaces of the other one
  double most_residual = 0.07;    ///< [m], > 0: root mean square of their distances; more: nothing fits
  double most_disagreement = 20;  ///< [deg], > 0: between the turns that odometry and scans see; more: one of them errs
  int most_points = 240;          ///< > 0: of a sweep; more cost more and say little more
  PointSweepParams points{.reach = 20.0, .nearest = 0.4};  ///< nearer is the robot itself, or whoever touches it
  LineMatcherParams lines{.sigma = 0.02, .independent_points = 40.0};
  [[nodiscard]] Result<void> validate() const;
};

/// How mounts are found from pairs.
struct MountFitParams {
  // How odometry errs between two sweeps.
  double way_noise = 0.012;         ///< [m / sqrt(m)], > 0, along
  double aside_noise = 0.006;       ///< [m / sqrt(m)], > 0, aside: the turn in between is that of the scans
  double turn_noise = 0.012;        ///< [rad / sqrt(rad)], > 0
  double least_noise = 0.004;       ///< [m], > 0: of a match, whatever it says of itself
  double least_turn_noise = 0.003;  ///< [rad], > 0
  // What is known before anything was driven, by one standard deviation.
  double heading_prior = 3.0;   ///< [rad]: nothing
  double position_prior = 0.5;  ///< [m]
  double delay_prior = 0.15;    ///< [s]
  double way_prior = 0.1;       ///< share, of the base's scale of way: a wheel that is worn, or a figure that is wrong
  double turn_prior = 0.1;      ///< share, of its scale of turn
  double veer_prior = 0.03;     ///< [rad/m]: how much one wheel outruns the other
  double outlier = 3.0;         ///< sigmas, > 0: beyond it a pair counts less and less (Cauchy)
  double caution = 1.1;         ///< >= 1: errors are told so many times larger: neighbouring pairs share a sweep
  int piece = 8;                ///< > 0, pairs at most: of one piece of the way, in which all may err alike,
  int pieces = 6;               ///< >= 4: or, of few pairs, into so many pieces
  int few_pairs = 24;           ///< >= 0: up to so many one witness more or less may turn all round
  int iterations = 8;           ///< > 0
  [[nodiscard]] Result<void> validate() const;
};

/// Section `calibrate` of robot.yaml.
struct MountCalibratorParams {
  ScanFollowerParams follower;
  MountFitParams fit;
  int pairs = 150;       ///< > 10: as many of the last ones as count: some 70 m of way
  int fewest_pairs = 6;  ///< > 0: before that nothing is said
  // From what error on robot.yaml is contradicted. A laser that is screwed on by hand is off by half a degree and 1 cm.
  double named_heading = 1.5;    ///< [deg], > 0
  double named_position = 0.03;  ///< [m], > 0
  double named_delay = 0.04;     ///< [s], > 0: half of a sweep of 12 Hz is one, too
  double named_scale = 0.04;     ///< share, > 0, of way and of turn
  double sigmas = 2.5;           ///< > 0: and from how many standard deviations beyond half of that
  // When mounts count as known.
  double known_heading = 1.5;    ///< [deg], > 0: standard deviation
  double known_position = 0.04;  ///< [m], > 0
  // And as so well known that a look now and then will do: it costs a tenth.
  double settled_heading = 0.4;    ///< [deg], > 0
  double settled_position = 0.01;  ///< [m], > 0
  double rest_way = 4.0;           ///< [m], >= 0: between two such looks, or
  double rest_turn = 90.0;         ///< [deg], >= 0
  // What is believed before.
  double doubt_heading = 7.0;    ///< [deg], >= 0: standard deviation of a mount that nothing has confirmed
  double doubt_position = 0.07;  ///< [m], >= 0
  double unknown_speed = 0.3;    ///< [m/s], > 0: so fast at most until mounts are known
  double mirrored_speed = 0.1;   ///< [m/s], > 0: and for ever while one mirrors left and right
  double unknown_way = 60.0;     ///< [m], >= 0: but no longer than that: there are halls in which nothing is to be seen
  double borne_out_way = 10.0;   ///< [m], >= 0: after it they need not be known as well as that, if so many
  int borne_out_pairs = 20;      ///< > 0: pairs of sweeps bear them out
  bool corrects = true;          ///< drives with what it has found; false: it is named alone
  template <class V>
  void visit(V& v) {
    v("named_heading", named_heading);
    v("named_position", named_position);
    v("named_delay", named_delay);
    v("named_scale", named_scale);
    v("known_heading", known_heading);
    v("known_position", known_position);
    v("doubt_heading", doubt_heading);
    v("doubt_position", doubt_position);
    v("unknown_speed", unknown_speed);
    v("mirrored_speed", mirrored_speed);
    v("unknown_way", unknown_way);
    v("corrects", corrects);
  }
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace docent::mapping
