#pragma once

#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/task_control/tour_scheduler/programme.h"
#include "docent/task_control/travel_times/travel_times.h"

namespace docent::task_control {

/// Section `mission.composition` of robot.yaml.
struct CompositionParams {
  int least_exhibits = 3;        ///< >= 1 of a composed tour, however long they take
  double plan_ahead_s = 420;     ///< [s] >= 0 before the end, from where on all sequences are compared
  double spread_ahead_s = 150;   ///< [s] >= 0 before the end, from where on the spread of ways counts in the plan
  double way_cost = 1.0;         ///< [s^2/s] >= 0 of a second on the way: rather near exhibits, where all else is equal
  double question_gain = 20.0;   ///< [s^2] >= 0 of a question: visitors are asked unless the end comes out worse
  double wished_gain = 400.0;    ///< [s^2] >= 0 of what others wait for: worth an end that is 20 s off
  double odd_pair_cost = 225.0;  ///< [s^2] >= 0 of a pair that is not sensible: worth an end that is 15 s off
  template <class V>
  void visit(V& v) {
    v("least_exhibits", least_exhibits);
    v("plan_ahead_s", plan_ahead_s);
    v("spread_ahead_s", spread_ahead_s);
    v("way_cost", way_cost);
    v("question_gain", question_gain);
    v("wished_gain", wished_gain);
    v("odd_pair_cost", odd_pair_cost);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// A composed tour as it stands between two exhibits.
struct TourSoFar {
  Point2 robot;                       ///< [m] map
  std::vector<std::string> done{};    ///< exhibits that are not shown (again)
  std::string after{};                ///< the exhibit that was shown last; empty: none yet
  int explained = 0;                  ///< exhibits that were
  double left_s = 0.0;                ///< [s] to the end of its farewell
  std::vector<std::string> wished{};  ///< exhibits that others wait for
  std::string language{};
  bool may_ask = true;  ///< whether visitors may be asked: more, or next?
};

/// How a tour goes on.
struct TourPlan {
  std::vector<std::string> stops;  ///< as it looks now, the next one first; empty: it is over
  bool asks = true;                ///< at the next stop: more, or next?
  bool is_sensible = true;         ///< the next stop makes sense after the one before
  double expected_loss = 0.0;      ///< [s^2] mean square of the time by which the end will be off, and the costs above
};

/// Chooses how a composed tour goes on, so that it ends as near as possible to its target ([Minerva2000] 5.3): the
/// least mean square of what is missing or too much at the end.
///
/// The choice looks ahead over all sequences of sensible pairs. Far from the end a way counts with its mean; in the
/// last `spread_ahead_s` it is foreseen as three ways (mean, and 1.73 deviations more and less, weighed 4:1:1, which
/// has the right mean and spread), after each of which the tour goes on in the best manner, and a question has two
/// answers. So the plan knows that it will choose again at each exhibit. The tour ends where no exhibit makes the end
/// better. While fewer than `least_exhibits` were explained, it goes on as long as there are any. Where no sensible
/// exhibit is left, any other is taken, at a cost. Exhibits for the Web alone and those without a way are left out.
///
/// At most kMostFirst exhibits are tried first and kMostNext after each, the nearest in time; more than `plan_ahead_s`
/// before the end the nearest alone. O(kMostFirst kMostNext^k) for k stops within plan_ahead_s; states that were seen
/// (place, exhibits done, time left in steps of 4 s) are not computed twice. The first choice of six minutes costs
/// 16 ms with 23 exhibits of three sensible successors each, 0.7 s with five (composition_benchmark); later ones cost
/// less. Deterministic.
[[nodiscard]] TourPlan plan_tour(const Programme& programme, const TourSoFar& tour, const TravelDistance& travel,
                                 const TravelTimes& times, Time now, const CompositionParams& params);
inline constexpr std::size_t kMostFirst = 8;
inline constexpr std::size_t kMostNext = 4;

/// How long it takes to go to an exhibit and show it in the short version [s], with the question if `asks`, nobody
/// wanting more.
[[nodiscard]] double stop_duration(const SpokenLength& spoken, double way_s, bool asks, const TravelTimes& times);

}  // namespace docent::task_control
