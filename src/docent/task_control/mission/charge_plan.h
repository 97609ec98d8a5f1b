#pragma once

#include <algorithm>

#include "docent/base/result.h"
#include "docent/task_control/mission/hourly_demand.h"
#include "docent/task_control/tour_scheduler/request_board.h"

namespace docent::task_control {

/// When a robot charges: in gaps, by what waits and by how busy this hour of the day and the next one usually are.
struct ChargePlanParams {
  bool in_gaps = true;         ///< false: as if every hour were quiet, and whoever waits waited for a whole charge
  double busy_share = 0.3;     ///< 0..1 of an hour in which somebody wants it: then it charges in every gap
  double gap_missing = 0.08;   ///< 0..1 > 0: what must be missing to make the way to the charger worth while in a gap
  double least_gain = 0.1;     ///< 0..1 above battery_low that is charged at least while somebody waits
  double visit_s = 110.0;      ///< [s] > 0 that an exhibit keeps it busy,
  double tour_s = 360.0;       ///< [s] > 0 and a tour
  double spare_factor = 1.25;  ///< >= 1: so much more than that is charged before it serves who waits
  double rises = 1.3;          ///< > 1: the next hour is so much busier than this one: then it charges now
  int few = 1;                 ///< >= 0: while more wait, it does not charge before it must
  template <class V>
  void visit(V& v) {
    v("in_gaps", in_gaps);
    v("busy_share", busy_share);
    v("gap_missing", gap_missing);
    v("least_gain", least_gain);
    v("visit_s", visit_s);
    v("tour_s", tour_s);
    v("spare_factor", spare_factor);
    v("rises", rises);
    v("few", few);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What waits for the robot.
struct Waiting {
  int exhibits = 0;
  int tours = 0;
  [[nodiscard]] int all() const { return exhibits + tours; }
};
/// Different exhibits, places and tours that queued requests ask for.
[[nodiscard]] Waiting waiting_on(const RequestBoard& board);

/// Decides by the demand of the hours. Shares of a full battery are 0..1.
class ChargePlan {
 public:
  explicit ChargePlan(const ChargePlanParams& params) : params_{params} {}

  [[nodiscard]] HourlyDemand& demand() { return demand_; }
  [[nodiscard]] const HourlyDemand& demand() const { return demand_; }
  void set_hour(int hour) { hour_ = hour; }
  [[nodiscard]] int hour() const { return hour_; }

  /// What must be missing of a full battery for an idle robot to go to its charger. @param usual  in a quiet hour
  [[nodiscard]] double missing_in_gap(double usual) const;
  /// What is charged above what must be left, before it serves who waits. @param most  at most
  /// @param drain_per_s  [1/s] of a busy robot
  [[nodiscard]] double gain_for(const Waiting& waiting, double most, double drain_per_s) const;
  /// Whether it may charge between two tours though somebody waits, before it must.
  [[nodiscard]] bool may_charge_before(const Waiting& waiting) const;

 private:
  ChargePlanParams params_;
  HourlyDemand demand_;
  int hour_ = 12;
};

}  // namespace docent::task_control
