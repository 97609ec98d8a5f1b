#pragma once

#include <array>
#include <vector>

#include "docent/interaction/attract/crowd_class.h"
#include "docent/interaction/attract/trial_memory.h"

namespace docent::interaction {

/// What the robot says of its styles.
enum class StyleClaim { none, friendly_attracts_more, friendly_attracts_fewer };
constexpr auto words_of(StyleClaim) { return std::array{"none", "friendly attracts more", "friendly attracts fewer"}; }

/// When a difference between the friendly and the upset styles is more than chance.
struct StyleEvidenceParams {
  double level = 0.05;  ///< 0..1, at most so often a claim is made at any time where there is no difference
  int settled = 6;      ///< >= 2, rewards of a class of crowds before one of them is compared with the others
  double clip = 2.5;    ///< [standard deviations] > 0: a reward farther off counts as this; one family is no proof
  /// [1/standard deviation] > 0, the differences that are looked for: half of what lies between the friendliest style
  /// and the most upset one. A small difference, a large one, and a very large one (Cohen's d of 0.4, 0.8, 1.6).
  std::vector<double> leans{0.2, 0.4, 0.8};
  template <class V>
  void visit(V& v) {
    v("level", level);
    v("settled", settled);
    v("clip", clip);
    v("leans", leans);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Whether friendlier styles attract more people, or fewer: a test that may be looked at after each trial.
///
/// The robot chooses by what it has seen, so the means of its styles are no fair samples and the usual intervals are
/// wrong. But it knows how probably it was to draw each style, given all that had happened before and the gaze that it
/// drew. Where styles do not matter, the reward x of a trial (in standard deviations of its crowd, from earlier trials)
/// says nothing of the friendliness g that was drawn, so that exp(l x g) / sum_g' P(g') exp(l x g') has expectation 1
/// for every l; and so has the product over all trials, and the mean of the products over several l. By Ville's
/// inequality such a product ever exceeds 2 / level with a probability of at most level / 2: one product for "more"
/// (l > 0), one for "fewer" (l < 0). The bound is exact for any policy and any rewards; it needs no normal distribution
/// and no planned number of trials.
class StyleEvidence {
 public:
  StyleEvidence(const StyleEvidenceParams& params, const CrowdClassParams& crowds);

  /// In the order in which the trials were made. O(leans).
  void add(const AttractionTrial& trial);
  /// The claim that was proved last. It stays: what was proved once was proved.
  [[nodiscard]] StyleClaim claim() const { return claim_; }
  /// After how many trials it was made; 0: there is none.
  [[nodiscard]] int claimed_after() const { return claimed_after_; }
  /// ln of the product for the claim; ln(2 / level) proves it. @pre claim is not none
  [[nodiscard]] double log_evidence(StyleClaim claim) const;

 private:
  StyleEvidenceParams params_;
  CrowdClassParams crowds_;
  MomentsByCrowd rewards_;
  std::array<std::vector<double>, 2> log_products_;  ///< [more, fewer][leans]
  StyleClaim claim_ = StyleClaim::none;
  int claimed_after_ = 0;
  int trials_ = 0;
};

}  // namespace docent::interaction
