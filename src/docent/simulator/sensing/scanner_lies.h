#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "docent/base/time.h"
#include "docent/simulator/scenario/scenario.h"

namespace docent::simulator {

/// A scan on its way out of the driver.
struct ScanOnItsWay {
  std::vector<float>& ranges;  ///< [m]
  float& range_min;            ///< [m]
  float& range_max;            ///< [m]
  float first_bearing = 0.0F;  ///< [rad], sensor frame
  float bearing_step = 0.0F;   ///< [rad]
};

/// What one scanner says that works and is wrong.
class ScannerLies {
 public:
  void begin(const ScannerLie& lie, Time now);
  /// Makes of what was measured at `now` what the driver says. To be called with every scan, lie or not: old sweeps are
  /// told again later.
  void tell(Time now, const ScanOnItsWay& scan);
  /// [rad] of the last scan in which something is so near that the lie leaves it out.
  [[nodiscard]] double left_out() const { return left_out_; }

 private:
  void repeat_old(Time now, const ScanOnItsWay& scan) const;
  void leave_out(double nearest, const ScanOnItsWay& scan);

  std::optional<ScannerLie> lie_;
  Time since_{};
  double left_out_ = 0.0;
  struct Sweep {
    Time stamp;
    std::vector<float> ranges;
  };
  std::deque<Sweep> told_;  ///< of the last seconds, as they were measured
};

}  // namespace docent::simulator
