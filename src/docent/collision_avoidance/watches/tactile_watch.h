#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "docent/collision_avoidance/watches/complaint.h"

namespace docent::collision_avoidance {

struct TactileWatchParams {
  ComplaintParams complaints{.patience = 0.8};  ///< the ring is felt less often than the lasers look
  int repeats = 2;                              ///< of a count; one may be a message that was sent twice
  double memory = 0.4;                          ///< a message's share in the running mean
  double many_missing = 0.25;                   ///< share of the segments that give no reading
  double nearly_all = 0.9;                      ///< likewise: the ring tells nothing at all
};

/// Watches the tactile ring. A ring that nobody touches says the same for hours, so its electronics count their scans:
/// who repeats the count is frozen. What has sent must go on.
class TactileWatch {
 public:
  explicit TactileWatch(const TactileWatchParams& params = {}) : params_{params} {}

  static constexpr std::uint8_t kNoReading = 255;  ///< of a segment

  /// @param scan  count of the ring's own scans; 0: it keeps none
  void feel(Time now, Time stamp, std::span<const std::uint8_t> segments, std::uint32_t scan);

  /// @param required  complain about a ring that never spoke, too
  [[nodiscard]] std::optional<Complaint> complaint(Time now, bool required) const;

 private:
  TactileWatchParams params_;
  Freshness freshness_;
  std::uint32_t scan_ = 0;
  int repeats_ = 0;
  double missing_ = 0.0;  ///< share of the segments, lately
};

}  // namespace docent::collision_avoidance
