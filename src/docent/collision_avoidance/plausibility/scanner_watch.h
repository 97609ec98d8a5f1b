#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/expected_sweeps/parallax.h"
#include "docent/collision_avoidance/expected_sweeps/range_law.h"
#include "docent/collision_avoidance/expected_sweeps/straight_walls.h"
#include "docent/collision_avoidance/expected_sweeps/succession.h"
#include "docent/collision_avoidance/plausibility/blind_sectors.h"
#include "docent/collision_avoidance/plausibility/map_check.h"
#include "docent/collision_avoidance/plausibility/motion_check.h"
#include "docent/collision_avoidance/plausibility/near_things.h"
#include "docent/collision_avoidance/plausibility/old_sweeps.h"
#include "docent/collision_avoidance/plausibility/repeated_sweeps.h"
#include "docent/collision_avoidance/plausibility/ring_check.h"
#include "docent/collision_avoidance/plausibility/sweep_form.h"
#include "docent/collision_avoidance/watches/complaint.h"

namespace docent::collision_avoidance {

struct ScannerWatchParams {
  SweepFormParams form{};
  RangeLawParams law{};
  RepeatedSweepsParams repeats{};
  OldSweepsParams old{};
  BlindSectorsParams sectors{};
  NearThingsParams near{};
  MotionCheckParams motion{};
  MapCheckParams map{};
  RingCheckParams rings{};
  StraightWallsCheckParams straight{};
  ParallaxCheckParams parallax{};
  SuccessionParams succession{};
  double crippled_speed = 0.25;  ///< [m/s] as ComplaintParams::crippled_speed, with a scanner that is blind in part
  double unproven_speed = 0.25;  ///< [m/s] until motion or the map has borne a scanner out,
  double alone_speed = 0.1;     ///< [m/s] likewise, without sonars and lost on a map: a factor shows after 0.3 m of way
  double trusts = 0.8;          ///< of what a scanner that is tried should say by its law
  double trial_speed = 0.06;    ///< [m/s] to find out whether a scanner that lied tells the truth again
  double stands = 8.0;          ///< [s] after the last sign of a lie, before that,
  double stands_briefly = 1.0;  ///< [s] where a few decimetres of way tell it from a robot that was carried off
  double onset = 0.6;           ///< [s] since the sweep before, at most: then people and places have changed
  double breaks = 0.4;        ///< of the samples that answer at most as the sweep before has it: something has happened
  int breaks_least = 12;      ///< of them at least
  double with_others = 0.35;  ///< [s] since another scanner saw a break: this one was carried off, too
  double alone = 0.9;         ///< of the samples follow a law where no other scanner bears it out,
  RangeLawParams closely{.noise = 0.06, .per_metre = 0.012};  ///< so closely, and
  double alone_as_before = 0.15;                              ///< of them at most are as before
  int alone_at_most = 5;          ///< sweeps to find so many; then the robot was carried off
  double same_offset = 0.08;      ///< [m] between the laws of two scanners that are one
  double same_factor = 0.08;      ///< likewise, of the factor
  double unsettled = 10.0;        ///< [s] after a break: the place that is believed may be the one before it
  double map_alone = 0.8;         ///< of the samples follow a law by the map where no other scanner fits it
  double returns = 0.35;          ///< of the samples at least as before the lie, or by its law: people have moved since
  double clearly = 2.0;           ///< times as many as of the other
  int sure = 2;                   ///< sweeps that say the same
  int rings_sure = 3;             ///< likewise, against sonars and infrared sensors
  double unseen = 0.5;            ///< [m] a greater offset shows to the sweep before when it begins, and
  double unseen_factor = 1.5;     ///< a greater factor: if it did not, it is glass that the ring hears
  int good_again = 3;             ///< sweeps without a fault of form until it is forgotten
  double gone = 0.15;             ///< of the samples at most should still meet something: a silence is no wonder
  double people_stay = 3.0;       ///< [s] then those who were all that was seen may have left; walls have not
  double silence_map = 3.0;       ///< [s] in which the map's word on a silent sweep holds
  int map_silences = 3;           ///< comparisons with the map in which a sector is blind
  double map_patience = 0.75;     ///< [s] as if the map's sector had been seen so long ago: a wider one is asked for
  double walls_longest = 2.0;     ///< [s] for which walls that were seen are expected,
  double walls_way = 1.0;         ///< [m] and so far from there,
  double walls_turn = 0.8;        ///< [rad] and turned so far
  double walls_least_turn = 0.2;  ///< [rad] and at least so far, or
  double walls_least_way = 0.3;   ///< [m] at least so far: before, the same beams meet them
  double walls_hole = 0.35;       ///< [rad] between them, where somebody hid one
  double walls_patience = 0.25;   ///< [s] as if they had been seen so long ago: walls do not step aside
  double mount_settles = 10.0;    ///< [s] after a mount was corrected the belief proves nothing: it came of the old one
  double ahead = 1.75;            ///< [rad] a scanner that looks so far from ahead does not see where it drives
};

/// Judges every sweep of one scanner before anything else takes it for true: what no scanner in order says, what does
/// not follow from the sweeps before, from the motion or from the map. What is not to be believed becomes "no reading",
/// which nothing takes for free floor.
class ScannerWatch {
 public:
  /// @param name  for a person: "front laser" @param walls  `known_walls` of the map; null: there is none
  ScannerWatch(std::string name, const BaseLimits& limits, std::shared_ptr<const sensor_models::RayCaster> walls,
               const ScannerWatchParams& params = {});

  /// What a scanner says of the last moments to the others: who is carried off is so with all of them.
  struct Word {
    Time newest{};                                              ///< sweep that could be compared
    Time unbroken{};                                            ///< since when each was as the one before let expect
    Time broken{};                                              ///< when the last break began
    std::optional<RangeLaw> law{};                              ///< that holds for the newest sweeps instead
    Time fits_map{};                                            ///< when it was last as the map has it
    std::optional<RangeLaw> by_map{};                           ///< that holds by the map instead
    Time remounted{};                                           ///< when it was found to be mounted elsewhere
    Succession::Finding follows = Succession::Finding::untold;  ///< whether the newest sweep can follow those before
  };
  [[nodiscard]] const Word& word() const { return word_; }

  /// The sweep as far as it is to be believed. @param odom_from_base  at its stamp
  /// @param is_motion_known  odometry is as fresh as the sweep: else it is judged by itself alone
  /// @param others  what the other scanners said last
  /// @param rings  what sonars and infrared sensors heard last
  [[nodiscard]] SensorSweep judge(SensorSweep sweep, const Pose2& odom_from_base, bool is_motion_known = true,
                                  std::span<const Word> others = {}, std::span<const RingEcho> rings = {});
  /// Where the robot believes to be. @param mass  of the belief there
  void believe(Time stamp, const Pose2& map_from_odom, double mass) { map_.believe(stamp, map_from_odom, mass); }

  /// What is wrong with the scanner; nullopt: nothing that is known of.
  [[nodiscard]] std::optional<Complaint> complaint() const;
  /// Nothing has borne it out yet: neither motion nor the map.
  [[nodiscard]] bool is_unproven() const { return !is_proven_ || lies_ > 0; }
  [[nodiscard]] double unproven_speed() const { return is_alone() ? params_.alone_speed : params_.unproven_speed; }

 private:
  /// A lie of the whole sweep, other than one of its form.
  struct Lie {
    /// How it was found: by the sweep before it began, which tells when it ends; by the motion; by the map;
    /// by sonars and infrared sensors; by walls that are not straight, or pass by otherwise than they should.
    enum class By { sweeps, motion, map, rings, walls };
    std::string what;  ///< for a person
    By by = By::sweeps;
    RangeLaw law{};  ///< of sweeps and map
    bool is_late = false;
    bool is_brief = false;  ///< may be a robot that was carried off: a little way tells
    Time first_sign{};      ///< when it showed first,
    Time last_sign{};       ///< and last
  };
  /// A mount was found to be another one: what was seen before lies elsewhere, and what did not fit it was no lie.
  void follow_mount(const SensorSweep& sweep);
  void judge_form(const SensorSweep& sweep);
  /// Somebody may have carried the robot. A scanner that lies, or seems to, tells nothing of that.
  void judge_succession(const SweepView& view) {
    if (form_fault_ != FormFault::none || lie_ || lies_ > 0) return forget_succession();
    word_.follows = succession_.add(view, before_says_.share_as_expected(params_.law.least));
  }
  void forget_succession() {
    succession_.forget();
    word_.follows = Succession::Finding::untold;
  }
  void judge_onset(const SweepView& view, std::span<const Word> others);
  /// Something has happened that is no lie: the robot was carried off, or a crowd has closed in.
  void begin_anew(const SweepView& view);
  /// Is this sweep as the one before lets expect? For this scanner and the others.
  void watch_for_breaks(const SweepView& view, std::span<const Word> others);
  [[nodiscard]] std::vector<float> surely_expected(const SweepView& view) const;
  /// What was found by comparing places that may not be one.
  void forget_places();
  [[nodiscard]] bool is_clear(const RangeLaw& law, const SweepView& view) const;
  /// What others say to a law that this scanner seems to follow since `since`.
  enum class Verdict { none, borne_out, carried_off };
  [[nodiscard]] Verdict verdict(const RangeLaw& law, Time since, std::span<const Word> others) const;
  [[nodiscard]] bool is_same(const RangeLaw& a, const RangeLaw& b) const {
    return std::abs(a.offset - b.offset) <= params_.same_offset &&
           std::abs(std::log(a.scale / b.scale)) <= params_.same_factor;
  }
  [[nodiscard]] bool is_borne_out_by_map(const RangeLaw& law, Time now, std::span<const Word> others) const;
  void judge_age(const SweepView& view, const SensorSweep& sweep, const Pose2& odom_from_base);
  void judge_motion(const SweepView& view);
  void judge_by_map(const SweepView& view, std::span<const Word> others);
  void judge_by_rings(const SweepView& view, const RingCheck::Finding& found);
  /// The map said last that the ranges are right.
  [[nodiscard]] bool does_map_fit(Time now) const {
    return word_.fits_map != Time{} && word_.fits_map >= map_said_ &&
           now - word_.fits_map < seconds(params_.silence_map);
  }
  /// The ring has borne the scanner out, and every sweep since was as the one before let expect.
  [[nodiscard]] bool is_glass(const RangeLaw& law) const;
  void judge_by_walls(const SweepView& view);
  /// An offset from the start, by what passes by while the robot drives; where a ring hears, it tells sooner, and
  /// crowds that pass by do not deceive it.
  void judge_by_parallax(const SweepView& view);
  void judge_silence(const SweepView& view);
  /// Walls that other beams saw a moment ago: who turns brings them into a sector that has been blind all the while.
  void look_for_walls(const SweepView& view);
  void convict(Lie lie, Time when);
  /// While a lie lasts that was seen to begin: do the sweeps follow it still, or are they as before?
  void follow_lie(const SweepView& view, const RangeLaw& law);
  /// Whether motion can show that it has ended: an offset moves along.
  [[nodiscard]] bool may_try() const { return lie_->law.offset == 0.0; }
  /// It stood long enough: very slowly it finds out.
  [[nodiscard]] bool is_tried(Time now) const {
    return may_try() && now - lie_->last_sign > seconds(lie_->is_brief ? params_.stands_briefly : params_.stands);
  }
  void acquit() {
    lie_.reset();
    lies_ = 0;
    motion_.forget();
    is_proven_ = true;
  }
  void hide(SensorSweep& sweep, const SweepView& view) const;
  /// No sonar and no infrared sensor bears it out; where there is a map it soon might.
  [[nodiscard]] bool is_alone() const { return !has_ring_ && map_.has_map(); }
  [[nodiscard]] bool looks_ahead() const { return std::abs(base_from_sensor_.theta.radians()) < params_.ahead; }

  std::string name_;
  BaseLimits limits_;
  ScannerWatchParams params_;
  MapCheck map_;
  MotionCheck motion_;
  RepeatedSweeps repeats_;
  OldSweeps old_;
  Succession succession_;
  BlindSectors sectors_;
  BlindSectors of_map_;  ///< that the map alone shows, not yet believed
  int of_map_row_ = 0;
  NearThings near_;
  RingCheck rings_;
  StraightWallsCheck straight_;
  ParallaxCheck parallax_;
  int rings_row_ = 0;  ///< sweeps in succession of which the rings say that they are too long,
  Time fits_rings_{};  ///< when they last bore it out; never, if what came since does not follow from that sweep
  bool has_ring_ = false;
  Pose2 base_from_sensor_;
  std::shared_ptr<const SampleRays> rays_of_samples_;  ///< of the last sweep
  SweepForm form_;
  enum class FormFault { none, units, covered, silent };
  FormFault form_fault_ = FormFault::none;
  int well_formed_ = 0;  ///< sweeps since a fault of form
  bool is_silence_explained_ = false;
  std::optional<SweepView> before_;  ///< the last sweep that was believed
  std::optional<SweepView> walls_;   ///< what lay on long straight pieces a moment ago
  std::vector<float> expected_;
  RangeLaw before_says_;  ///< of the newest sweep, by the sweep before
  bool breaks_ = false;   ///< it is not as expected at all
  Time joined_{};         ///< the last break of another scanner that counted for this one
  int lies_ = 0;          ///< sweeps in succession that follow a law, or none while a lie lasts
  Time suspected_{};      ///< the first of them
  Word word_;
  std::optional<Lie> lie_;
  Time newest_{};
  Time map_said_{};               ///< when the map said last
  bool map_has_nothing_ = false;  ///< that nothing is within reach
  bool is_proven_ = false;
};

}  // namespace docent::collision_avoidance
