#include "docent/planning/navigator/lookout.h"

#include <algorithm>
#include <utility>

#include "docent/planning/exploration/clearances.h"
#include "docent/planning/exploration/tell_apart.h"

namespace docent::planning {
namespace {

constexpr Duration kSweepStaleAfter = std::chrono::seconds{2};
constexpr Duration kPastLooks = std::chrono::milliseconds{5500};  ///< a full turn; odometry's poses are kept for 6 s
constexpr Duration kBetweenLooks = std::chrono::milliseconds{300};

/// False: there is no such sweep, or it is older than `stale`.
bool enter(const Sweep& sweep, const Pose2& base_from_scanner, const Whereabouts& where, Time now, Duration stale,
           Clearances& clearances) {
  const auto odom_from_then = where.odom_from_base_at(sweep.taken);
  if (sweep.ranges.empty() || now - sweep.taken > stale || !odom_from_then) return false;
  const Pose2 base_from_then = inverse(*where.odom_from_base) * *odom_from_then;
  clearances.add(base_from_then * base_from_scanner, sweep.first_bearing, sweep.bearing_step, sweep.max_range,
                 sweep.ranges);
  return true;
}

}  // namespace

Lookout::Lookout(std::vector<Pose2> base_from_scanner)
    : base_from_scanner_{std::move(base_from_scanner)}, newest_(base_from_scanner_.size()) {}

std::vector<double> Lookout::clearances(const Whereabouts& where, Time now) {
  Clearances real;
  Clearances virtual_ones;
  bool complete = !newest_.empty() && enter(hazards_, Pose2{}, where, now, kSweepStaleAfter, virtual_ones);
  for (std::size_t i = 0; i < newest_.size() && complete; ++i)
    complete = enter(newest_[i], base_from_scanner_[i], where, now, kSweepStaleAfter, real);
  if (!complete) return {};
  for (auto past = past_.rbegin(); past != past_.rend(); ++past) {
    Clearances then;
    for (std::size_t i = 0; i < past->sweeps.size(); ++i)
      (void)enter(past->sweeps[i], base_from_scanner_[i], where, now, kPastLooks, then);
    real.fill(then);
  }
  remember(now);
  std::vector<double> result = real.free();
  widest_real_ = 0.0;
  for (int i = 0; i < static_cast<int>(result.size()); ++i)
    widest_real_ = std::max(widest_real_, clearance_of_cone(result, i));
  const auto of_hazards = virtual_ones.free();
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::min(result[i], of_hazards[i]);
  return result;
}

std::string Lookout::hindrance() const {
  constexpr double kRoom = 0.7;  // [m], as LookAround asks for at least
  if (widest_real_ < kRoom) return "looking for the position, hemmed in: people or things all round";
  return "looking for the position; where it may be, hazards or the area's border are near all round";
}

void Lookout::remember(Time now) {
  while (!past_.empty() && now - past_.front().at > kPastLooks) past_.pop_front();
  if (past_.empty() || now - past_.back().at >= kBetweenLooks) past_.push_back({now, newest_});
}

double Lookout::reach() const {
  double reach = 0.0;
  for (const Sweep& sweep : newest_) reach = std::max(reach, sweep.max_range);
  return reach;
}

}  // namespace docent::planning
