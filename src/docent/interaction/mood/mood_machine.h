#pragma once

#include <optional>

#include "docent/base/random.h"
#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// How fast moods follow one another. A rate is 1 / the mean time that a mood lasts.
struct MoodParams {
  double to_neutral_s = 3.0;  ///< [s] > 0, mean time blocked until a happy robot is neutral: it first asks friendly
  double to_sad_s = 5.0;      ///< [s] > 0, then until a neutral one pleads
  double to_angry_s = 8.0;  ///< [s] > 0, then until a pleading one is angry: about when the reaction ladder asks again
  double calm_s = 2.0;      ///< [s] > 0, mean time with a free way until it is one mood happier
  double glide_s = 0.7;     ///< [s] > 0, in which a face does two thirds of the way to the next mood
  double sad_valence = -0.4;  ///< -1..0, of a pleading face, between neutral (0) and angry (-1)
  template <class V>
  void visit(V& v) {
    v("to_neutral_s", to_neutral_s);
    v("to_sad_s", to_sad_s);
    v("to_angry_s", to_angry_s);
    v("calm_s", calm_s);
    v("glide_s", glide_s);
    v("sad_valence", sad_valence);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// The stochastic finite-state machine of [Minerva2000] Fig. 14. While a person stands in the robot's way it goes from
/// happy through neutral and sad (it pleads) to angry; while the way is free it comes back, mood by mood. Departure:
/// the figure's three moods are four here, for the voice has a sad one.
///
/// A continuous-time Markov chain: each mood lasts for an exponential time. That time is drawn as an amount of hazard
/// when the mood begins and is used up at the rate that holds, so that the moods do not depend on how often `step` is
/// called. Deterministic by the generator.
class MoodMachine {
 public:
  /// Begins happy.
  MoodMachine(const MoodParams& params, const Rng& rng);

  /// From the last step until now it was blocked, or not. Several times a second; times must not fall, an older one
  /// changes nothing.
  void step(bool is_blocked, Time now);
  /// Puts on a face, whatever the mood is below it; nullopt: takes it off.
  void put_on(std::optional<Mood> face) { face_ = face; }
  /// The mood that is shown.
  [[nodiscard]] Mood mood() const { return face_.value_or(mood_); }
  /// -1 (angry) .. 1 (happy), on its way to that of the mood, for a face between moods.
  [[nodiscard]] double valence() const { return valence_; }

 private:
  [[nodiscard]] double rate(bool is_blocked) const;  ///< [1/s] 0: the mood stays
  [[nodiscard]] double valence_of(Mood mood) const;
  void glide(double seconds);

  MoodParams params_;
  Rng rng_;
  Mood mood_ = Mood::happy;
  std::optional<Mood> face_;
  double valence_ = 1.0;
  double hazard_left_ = 0.0;  ///< until the next change
  std::optional<Time> last_;
};

}  // namespace docent::interaction
