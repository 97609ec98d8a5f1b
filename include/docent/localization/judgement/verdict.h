#pragma once

#include <optional>

#include "docent/base/result.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/expected_ranges/agreement.h"
#include "docent/localization/judgement/glance.h"

namespace docent::localization {

/// When the robot says "here", and how likely it is lost.
struct VerdictParams {
  double here = 0.1;                ///< P(lost) below which it says "here"; above
  double no_longer_here = 0.25;     ///< it takes that back, and
  double given_up = 0.9;            ///< above, for eight glances in a row, it no longer keeps its place
  double enough_share = 0.93;       ///< of all that may be, see Tracks, to find its place, and
  double enough_mass = 0.995;       ///< of the best mode
  double too_little_mass = 0.6;     ///< to take "here" back
  double widest_spread = 0.35;      ///< [m] standard deviation of the best mode
  double confirmations = 6.0;       ///< full updates of one view in a row that kept to one mode
  double travelled = 1.0;           ///< [m] driven since, or
  double turned = 120.0;            ///< [deg] turned since
  double least_agreement = 0.2;     ///< share of the readings that the map explains
  double blind_way = 20.0;          ///< [m] to say "here" by odometry while people hide all that the map holds; after
                                    ///< three times as many the place is given up
  double most_contradiction = 0.2;  ///< share of the readings that pass through walls of the map
  double startled_through = 0.45;   ///< share of one sweep that does so, or
  double startled_hidden = 0.35;    ///< that is suddenly too short: nobody steps before so many beams at once
  template <class V>
  void visit(V& v) {
    v("here", here);
    v("no_longer_here", no_longer_here);
    v("given_up", given_up);
    v("enough_share", enough_share);
    v("enough_mass", enough_mass);
    v("too_little_mass", too_little_mass);
    v("widest_spread", widest_spread);
    v("confirmations", confirmations);
    v("travelled", travelled);
    v("turned", turned);
    v("least_agreement", least_agreement);
    v("blind_way", blind_way);
    v("most_contradiction", most_contradiction);
    v("startled_through", startled_through);
    v("startled_hidden", startled_hidden);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What P(lost) is made of, see Verdict.
struct Doubt {
  double mass = 0.0;           ///< of the best mode
  double share = 1.0;          ///< of it among the places that the whole way leaves possible, see Tracks
  double confirmation = 0.0;   ///< 0..1 of what it takes to say "here"
  double agreement = 0.0;      ///< share of the readings that the map explains, running mean
  double contradiction = 0.0;  ///< that pass through walls, likewise
  double surprise = 0.0;       ///< of the last sweep, see Glance::through
  double hidden = 0.0;         ///< share of the last sweep that is newly too short
  double unmapped = 0.0;       ///< walls that the map lacks, running mean, see Glance
  double spread = 0.0;         ///< [m] of the best mode
};

/// What one update says about the best mode.
struct Evidence {
  double weight = 1.0;        ///< of the update, 0..1
  double views = 1.0;         ///< >= 1: how many scans the scan counts for, LocalizerParams::views
  double mass = 0.0;          ///< of the best mode
  double share = 1.0;         ///< of the best mode among the places that the whole way leaves possible, see Tracks
  double spread = 0.0;        ///< [m]
  bool is_same_mode = false;  ///< the mode of the last update, moved by odometry
  double way = 0.0;           ///< [m] since the last update
  double turn = 0.0;          ///< [rad], >= 0
  Agreement readings;         ///< of one sweep
  /// What a sensor says that finds the robot by itself, where there is one: P(wrong) if it has it at the best mode,
  /// above 1 if it has it elsewhere.
  std::optional<double> witness{};
};

/// `evidence` with what a summary says of its best mode. `predicted`: the best pose of the last update, moved by
/// odometry.
[[nodiscard]] Evidence with_best_mode(Evidence evidence, const BeliefSummary& summary,
                                      const std::optional<Pose2>& predicted);

/// Decides whether the robot may say where it is. It says "I do not know" until one mode has held nearly all the mass
/// over several updates and some motion, and the readings bear it out. From then on "here" is P(lost) below one bound,
/// with hysteresis. Whoever asks for more or less certainty compares P(lost) with a bound of its own.
class Verdict {
 public:
  explicit Verdict(const VerdictParams& params) : params_{params} {}  ///< "I do not know". @pre params are valid

  /// An update of the belief.
  void add(const Evidence& evidence);
  /// A sweep between updates, or the one that led to the last, against the best pose. What one sweep alone says is
  /// believed when eight in a row leave P(lost) above a bound: somebody who steps before the robot is no other place.
  void look(const Glance& glance);
  /// After a restart or a given start: the mode was known already, and needs one confirmation only.
  void assume_localized();
  /// Somebody has carried the robot, so others found: it knows nothing until it is confirmed anew.
  void uproot();
  void reset();  ///< back to "I do not know"

  [[nodiscard]] bool localized() const { return localized_; }  ///< it may say "here"
  /// The robot may be too unsure to say "here" – people have hidden the map for long, two places share the mass – but
  /// since it last did nothing speaks against that place: what it sees is evidence about its neighbourhood, not about
  /// others.
  [[nodiscard]] bool keeps_its_place() const { return keeps_its_place_; }
  /// It found a place, however great the doubt, and the belief has kept to it since: what looks back sets out from it.
  [[nodiscard]] bool has_found() const { return has_found_; }
  /// Probability that the best hypothesis is wrong: a logistic function of what its mass leaves, of how far it has been
  /// confirmed, of how wide it is and of how the readings contradict it. Its weights are learned, see
  /// scripts/evaluation/calibration.py. Besides, another place may be the right one, as far as the whole way leaves
  /// it possible: a building in which two places look the same need not have been among those that were learned from.
  /// And a robot that sees nothing is never sure, unless another sensor finds it where it thinks to be: then the odds
  /// of both count, as of sensors that err by themselves. Before it has said "here" it is no less than the bound for
  /// that.
  [[nodiscard]] double p_lost() const;
  /// Readings pass through walls of the map, so many that the place must be wrong, or for so long nothing of the map
  /// was seen that odometry tells nothing any more.
  [[nodiscard]] bool contradicted() const;
  /// The last sweep is of another place, as it seems: someone may have carried the robot.
  [[nodiscard]] bool startled() const {
    return glance_.through > params_.startled_through || hidden_ > params_.startled_hidden;
  }
  /// What p_lost is made of now.
  [[nodiscard]] Doubt doubt() const {
    return {mass_, share_, confirmation(), agreement_, contradiction_, glance_.through, hidden_, unmapped_, spread_};
  }
  /// Of the best mode among the places that the whole way leaves possible.
  [[nodiscard]] double share() const { return share_; }
  [[nodiscard]] double agreement() const { return agreement_; }          ///< share of the readings, running mean
  [[nodiscard]] double contradiction() const { return contradiction_; }  ///< likewise
  [[nodiscard]] double surprise() const { return glance_.through; }      ///< of the last sweep, see Glance
  [[nodiscard]] double hidden() const { return hidden_; }      ///< share of the last sweep that is newly too short
  [[nodiscard]] double confirmation() const;                   ///< 0..1 of what it takes to say "here"
  [[nodiscard]] double unmapped() const { return unmapped_; }  ///< walls that the map lacks, running mean, see Glance
  [[nodiscard]] double blind_way() const { return blind_; }    ///< [m] driven since readings last agreed with the map
  /// The readings have contradicted the belief for a while: better to start over.
  [[nodiscard]] bool collapsed() const;

 private:
  /// By the weights of a robot that has said "here", or of one that has not.
  [[nodiscard]] double p_lost(bool has_said) const;
  /// The same without what the last sweep alone says.
  [[nodiscard]] double lasting_doubt() const;
  [[nodiscard]] double with_witness(double lost) const;
  [[nodiscard]] bool is_witnessed() const;
  /// 0..1: a robot whose readings nearly all end on people sees nothing, and knows only what odometry says. Updates
  /// tell it, or, where the robot stands and they weigh little, the glances.
  [[nodiscard]] double blindness(bool has_said) const;
  [[nodiscard]] bool hopelessly_blind() const;
  [[nodiscard]] double moved() const;
  [[nodiscard]] double seen() const;

  VerdictParams params_;
  bool localized_ = false;
  bool keeps_its_place_ = false;
  bool has_said_ = false;  ///< "here", of the place that it keeps
  bool has_found_ = false;
  bool is_told_ = false;  ///< somebody told a place, and it has not been borne out since
  double mass_ = 0.0;     ///< of the best mode
  double share_ = 1.0;    ///< of the best mode among the places that the whole way leaves possible
  double spread_ = 0.0;   ///< [m] of the best mode
  Glance glance_;
  double shorter_ = 0.0;  ///< Glance::shorter, running mean
  double hidden_ = 0.0;
  int unsure_ = 0;         ///< sweeps in a row that leave too much doubt to say "here", and
  int hopeless_ = 0;       ///< to keep the place
  double unmapped_ = 0.0;  ///< Glance::unmapped, running mean
  double confirmed_ = 0.0;
  double way_ = 0.0;
  double turn_ = 0.0;
  double agreement_ = 0.5;
  double contradiction_ = 0.0;
  double bad_ = 0.0;                 ///< [m] with bad readings; a radian turned counts half a metre
  double blind_ = 0.0;               ///< [m] driven since readings last agreed with the map
  std::optional<double> witness_{};  ///< see Evidence
};

}  // namespace docent::localization
