#pragma once

#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/result.h"
#include "docent/base/time.h"

namespace docent::simulator {

/// What happens to a sensor's messages on their way, and to the clock that stamps them. All at once, or nothing: as it
/// is without any.
struct WireParams {
  double delay = 0.0;    ///< [s] 0..2: each comes so much later at least
  double jitter = 0.0;   ///< [s] 0..1: each comes so much later at most, evenly; none overtakes another
  double hiccups = 0.0;  ///< [1/min] 0..600: nothing comes for a while, then all that was held, at once
  double hold = 0.1;     ///< [s] 0.001..10: the longest of these; each lasts a fifth of it or more
  /// Or receipt: as drivers stamp that read a line when they are given time to; moving: of the last message that told
  /// of something else, as of odometry that repeats itself while the base stands; zero: none.
  std::string stamps = "sending";
  double reorder = 0.0;   ///< 0..1, share that is overtaken by those after it
  double twice = 0.0;     ///< 0..1, share that comes twice
  double drop = 0.0;      ///< 0..1, share that never comes
  double clock = 0.0;     ///< [s] by which the sensor's clock is ahead
  double drift = 0.0;     ///< [s/s] by which it runs fast
  double set_back = 0.0;  ///< [s] by which it is set back, and again each `every`
  double every = 60.0;    ///< [s] > 0
  template <class V>
  void visit(V& v) {
    v("delay", delay);
    v("jitter", jitter);
    v("hiccups", hiccups);
    v("hold", hold);
    v("stamps", stamps);
    v("reorder", reorder);
    v("twice", twice);
    v("drop", drop);
    v("clock", clock);
    v("drift", drift);
    v("set_back", set_back);
    v("every", every);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// The way of one sensor's messages to whoever hears them: a line, a driver that stamps, a network.
class Wire {
 public:
  /// @pre params are valid
  Wire(const WireParams& params, const Rng& rng, Time begins);

  struct Delivery {
    Duration after{};  ///< from the sending on, >= 0
    Time stamp{};      ///< by the sensor's clock
  };
  /// Of a message that is sent at `now`, which never falls: when it comes, and how it is stamped; nothing: it never
  /// does. @param is_news  false: it says the same as the one before
  [[nodiscard]] std::vector<Delivery> carry(Time now, bool is_news = true);

 private:
  [[nodiscard]] Time by_clock(Time time) const;
  [[nodiscard]] Time stamp(Time now, Time comes, bool is_news);
  [[nodiscard]] Time free_at(Time now);

  WireParams params_;
  Rng rng_;
  Time begins_;
  Time last_;         ///< when the last one came that was not overtaken
  Time next_hiccup_;  ///< when it begins
  Time held_until_;   ///< end of the last one
  Time news_;         ///< stamp of the last message that said something else
};

}  // namespace docent::simulator
