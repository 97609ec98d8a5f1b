#include "docent/simulator/sensing/scanner_lies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::simulator {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr double kKept = 10.0;  // [s]

double usual_amount(Lie lie) {
  switch (lie) {
    case Lie::units:
      return 1000.0;
    case Lie::sector:
      return 60.0;
    case Lie::too_near:
    case Lie::blind_near:
      return 0.6;
    case Lie::offset:
      return 0.5;
    case Lie::scaled:
      return 2.0;
    case Lie::looped:
      return 3.0;
    case Lie::silent:
    case Lie::stale:
      return 1.0;
  }
  return 1.0;
}

void hide_sector(const ScanOnItsWay& scan, double bearing, double degrees) {
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double at =
        static_cast<double>(scan.first_bearing) + static_cast<double>(i) * static_cast<double>(scan.bearing_step);
    if (std::abs(Angle::radians(at - bearing).radians()) <= 0.5 * degrees * std::numbers::pi / 180.0)
      scan.ranges[i] = kNothing;
  }
}

/// What came back reads another distance.
template <class F>
void change(const ScanOnItsWay& scan, F to) {
  for (float& range : scan.ranges)
    if (range < scan.range_max) range = to(range);
}

}  // namespace

void ScannerLies::begin(const ScannerLie& lie, Time now) {
  lie_ = lie;
  since_ = now;
}

void ScannerLies::repeat_old(Time now, const ScanOnItsWay& scan) const {
  const double amount = lie_->amount.value_or(usual_amount(lie_->lie));
  double age = amount;
  if (lie_->lie == Lie::looped) {
    const double since = to_seconds(now - since_);
    age = since + amount - std::fmod(since, amount);  // the same `amount` seconds from before the lie
  }
  const Time wanted = now - seconds(age);
  const auto old = std::find_if(told_.begin(), told_.end(), [&](const Sweep& sweep) { return sweep.stamp >= wanted; });
  if (old != told_.end()) scan.ranges = old->ranges;
}

void ScannerLies::leave_out(double nearest, const ScanOnItsWay& scan) {
  for (float& range : scan.ranges) {
    if (!(range < static_cast<float>(nearest))) continue;
    range = kNothing;
    left_out_ += static_cast<double>(scan.bearing_step);
  }
}

void ScannerLies::tell(Time now, const ScanOnItsWay& scan) {
  left_out_ = 0.0;
  if (lie_ && lie_->duration > 0.0 && now - since_ >= seconds(lie_->duration)) lie_.reset();
  const bool is_looped = lie_ && lie_->lie == Lie::looped;
  const double loop = is_looped ? lie_->amount.value_or(usual_amount(Lie::looped)) : 0.0;
  const bool is_loop_full = is_looped && !told_.empty() && since_ - told_.front().stamp >= seconds(loop);
  if (is_looped && !is_loop_full) since_ = now;  // from the start: what is told again must have been told
  if (!is_loop_full) {                           // a loop goes on with what was told before it
    told_.push_back({now, scan.ranges});
    while (now - told_.front().stamp > seconds(kKept)) told_.pop_front();
  }
  if (!lie_ || (is_looped && !is_loop_full)) return;
  const auto amount = static_cast<float>(lie_->amount.value_or(usual_amount(lie_->lie)));
  switch (lie_->lie) {
    case Lie::units:
      return change(scan, [&](float range) { return amount * range; });
    case Lie::silent:
      std::fill(scan.ranges.begin(), scan.ranges.end(), kNothing);
      return;
    case Lie::sector:
      return hide_sector(scan, lie_->bearing, static_cast<double>(amount));
    case Lie::too_near:
      scan.range_min = amount;
      return leave_out(amount, scan);
    case Lie::blind_near:
      return leave_out(amount, scan);
    case Lie::offset:
      return change(scan, [&](float range) { return std::max(0.0F, range + amount); });
    case Lie::scaled:
      change(scan, [&](float range) { return amount * range; });
      scan.range_max *= amount;
      return;
    case Lie::stale:
    case Lie::looped:
      return repeat_old(now, scan);
  }
}

}  // namespace docent::simulator
