#pragma once

#include "docent/base/result.h"

namespace docent::people {

/// How broad people look at the height of the lasers.
struct BreadthParams {
  double broad = 0.22;    ///< [m], > 0: without a gap; one leg never is, stools, plants, pillars and bodies are
  double at_first = 0.5;  ///< 0..1: share of people who look broad before any were seen
  double trust = 60.0;    ///< > 0: sightings that `at_first` is worth: those of two persons
  int from = 10;          ///< sightings of somebody before they tell how broad they are
  int of_one = 30;        ///< > 0: sightings that one person tells at most
  double kept = 3000.0;   ///< >= trust: sightings that are remembered, those of a hundred persons
  template <class V>
  void visit(V& v) {
    v("broad", broad);
    v("at_first", at_first);
    v("trust", trust);
    v("from", from);
    v("of_one", of_one);
    v("kept", kept);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Learns from those who were seen to come or to move, and so are people, how many people look broad here. Lasers that
/// meet legs see few who do: what stands there and is broad is rather a thing then. Lasers that meet bodies see many.
class Breadth {
 public:
  explicit Breadth(const BreadthParams& params);  ///< @pre params are valid

  /// Somebody who surely is a person was seen. `sightings`: so far; `breadth` [m] of theirs.
  void learn(int sightings, double breadth);
  [[nodiscard]] bool is_broad(double breadth) const { return breadth > params_.broad; }  ///< [m]
  /// Share of people who look broad.
  [[nodiscard]] double share() const { return broad_ / all_; }

 private:
  BreadthParams params_;
  double broad_;  ///< sightings
  double all_;    ///< sightings
};

}  // namespace docent::people
