#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/time.h"
#include "docent/collision_avoidance/expected_sweeps/succession.h"
#include "docent/collision_avoidance/local_planner/speed_cap.h"

namespace docent::collision_avoidance {

struct CarriedOffParams {
  double same_moment = 0.02;  ///< [s] between stamps of sweeps that were taken together
  double waits = 0.3;         ///< [s] for the sweep of another scanner, which may say otherwise
  double alive = 0.6;         ///< [s] since its last sweep: a scanner that is waited for
  double settles = 0.5;       ///< [s] after it: a belief of before then still tells of the place before
  int sure = 3;               ///< beliefs in a row that say "here"
  double turns_only = 20.0;   ///< [s] without knowing; turning on the spot finds most places. Then it creeps
  double creep = 0.15;        ///< [m/s] where the whole belief leaves floor free
};

/// Somebody has carried the robot elsewhere: the sweeps of all its scanners cannot follow those before them, whatever
/// the base did (Succession). What it believes of hazards, which no sensor sees, is then wrong from one moment to the
/// next: it stops at the first such sweep, and turns only, until localization says "here" of a later moment.
class CarriedOff {
 public:
  explicit CarriedOff(std::size_t scanners, const CarriedOffParams& params = {}) : params_{params}, looks_(scanners) {}

  /// A sweep. @param stamp  local time
  void see(std::size_t scanner, Time stamp, Succession::Finding finding);
  /// A belief of that moment, local time, which says "here" or not.
  void believe(Time stamp, bool says_here);

  /// Why it must not drive now, but may turn; nullopt: it may.
  [[nodiscard]] std::optional<std::string> forbids_driving(Time now) const;
  /// Later it creeps.
  void cap(Time now, SpeedCap& cap) const;
  /// It does not know yet where it was put.
  [[nodiscard]] bool is_unsettled() const { return since_.has_value(); }
  [[nodiscard]] std::uint32_t times() const { return times_; }  ///< so far

 private:
  struct Look {
    std::optional<Time> stamp;
    Succession::Finding finding = Succession::Finding::untold;
    Time strange{};  ///< the first sweep in a row that could not follow
    Time broken{};   ///< likewise, of the last break that was borne out
  };
  /// What the scanners say of a break that began then.
  enum class Word { waits, denies, agrees };
  [[nodiscard]] Word word_of(const Look& look, Time first, Time newest) const;
  void judge(Time newest);

  CarriedOffParams params_;
  std::vector<Look> looks_;      ///< [scanners]
  std::optional<Time> pending_;  ///< a break that one scanner saw, and others have not told of yet
  std::optional<Time> since_;    ///< it was carried off, and does not know where to
  bool is_suspected_ = false;
  int here_ = 0;  ///< beliefs in a row that say "here"
  std::uint32_t times_ = 0;
};

}  // namespace docent::collision_avoidance
