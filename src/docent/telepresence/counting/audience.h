#pragma once

#include <deque>
#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/people_messages.h"

namespace docent::telepresence {

struct AudienceParams {
  double round = 3.0;    ///< [m] from the robot's centre stand those whom it guides
  double window = 10.0;  ///< [s] that are looked back on: who is hidden behind others for a moment is there
  double walks = 0.5;    ///< [m/s] and more: somebody who passes by
};

/// How many people stand round the robot and listen, from the people that it tracks: in the median of the last seconds,
/// so that neither a passer-by nor a hidden one counts.
class Audience {
 public:
  Audience() = default;
  explicit Audience(const AudienceParams& params) : params_{params} {}
  /// The newest people; the same once more changes nothing. @param map_from_base  nullopt: nobody knows where they are
  void see(const docent_msgs::People& people, const std::optional<Pose2>& map_from_base);
  [[nodiscard]] int count() const;

 private:
  struct Sight {
    Time stamp;
    int people;
  };
  AudienceParams params_;
  std::deque<Sight> sights_;  ///< of the last seconds, the oldest first
};

}  // namespace docent::telepresence
