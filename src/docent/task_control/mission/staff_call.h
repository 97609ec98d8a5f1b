#pragma once

#include <optional>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/task_control/tour_scheduler/programme.h"
#include "docent/vocabulary/reason.h"

namespace docent::task_control {

/// When a robot that does not get its charge calls for help.
struct StaffCallParams {
  double call_below = 0.13;     ///< 0..1: with less, and no charge in sight, the staff are called whatever is known
  double trouble_below = 0.25;  ///< 0..1: with less, a first failure at the charger is told at once
  int trouble_tries = 2;        ///< >= 1: with more than that, after so many failures
  int way_tries = 3;            ///< >= 1: after so many, where people or things on the way are the cause
  double call_again_s = 600.0;  ///< [s] > 0 between two calls of the same reason
  double retry_most_s = 120.0;  ///< [s] >= 0: each failure doubles the wait for the next try, up to this
  double current_s = 300.0;     ///< [s] > 0 at a charger without any rise, then it gives no current
  template <class V>
  void visit(V& v) {
    v("call_below", call_below);
    v("trouble_below", trouble_below);
    v("trouble_tries", trouble_tries);
    v("way_tries", way_tries);
    v("call_again_s", call_again_s);
    v("retry_most_s", retry_most_s);
    v("current_s", current_s);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Knows what keeps the robot from charging, and calls the staff in time: something stands on its charger, the charger
/// gives no current (also where the battery says that it charges, and does not), no way leads there, or simply too
/// little is left. Charge: share of a full battery, 0..1. Deterministic.
class StaffCall {
 public:
  static constexpr double kRise = 0.01;   ///< of the charge, at the charger: it gives current
  static constexpr double kFall = 0.015;  ///< likewise: it gives none; gauges tremble by less
  static constexpr double kStep = 0.005;  ///< likewise: it still rises

  explicit StaffCall(const StaffCallParams& params) : params_{params} {}

  /// A way to the charger, or docking there, has failed.
  void failed(const Reason& why);
  /// It has docked.
  void docked();
  /// Once or twice a second. @param is_at_charger  it stands there, and nothing says that it does not charge
  /// @returns the call, when it is time for one
  [[nodiscard]] std::optional<Happening> watch(double charge, bool is_at_charger, bool is_full, Time now);

  /// What keeps it from charging; none: nothing is known to.
  [[nodiscard]] const Reason& trouble() const { return why_; }
  /// It stands at its charger in vain.
  [[nodiscard]] bool has_no_current() const { return dock_ && dock_->gives_none; }
  [[nodiscard]] int failures() const { return failures_; }
  /// [s] until the next try. @param first_s  after a first failure
  [[nodiscard]] double retry_s(double first_s) const;
  /// What the staff were told and is still so, in English; empty: nothing.
  [[nodiscard]] std::string told() const { return told_ ? words() : ""; }

 private:
  struct Dock {
    Time since;
    double began_with = 0.0;  ///< charge
    double most = 0.0;        ///< charge since then
    Time rose;                ///< when it was that first
    bool gives_none = false;
  };
  void watch_current(double charge, bool is_at_charger, bool is_full, Time now);
  [[nodiscard]] bool is_time_to_call(double charge, Time now) const;
  [[nodiscard]] Reason reason() const;
  [[nodiscard]] std::string words() const;

  StaffCallParams params_;
  Reason why_;
  int failures_ = 0;
  std::optional<Dock> dock_;
  struct Told {
    Reason why;
    Time when;
  };
  std::optional<Told> told_;
};

}  // namespace docent::task_control
