#include "docent/task_control/tour_scheduler/composition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "docent/task_control/tour_scheduler/stop_lists.h"

namespace docent::task_control {
namespace {

constexpr std::size_t kMostExhibits = 64;  // bits of a set
constexpr double kTimeStep = 4.0;          // [s] of the states that are the same
constexpr double kHopeless = 60.0;         // [s] behind its time a tour does not look for more
constexpr double kNever = 1e12;            // [s^2] dearer than any tour

struct Outcome {
  double off;     // [standard deviations]
  double weight;  // of all
};
// Gauss-Hermite with three points: exact up to the fifth moment of a normal distribution.
constexpr std::array<Outcome, 3> kOutcomes{{{0.0, 4.0 / 6.0}, {-1.7320508, 1.0 / 6.0}, {1.7320508, 1.0 / 6.0}}};

struct State {
  std::size_t at = 0;      // where the robot is
  std::uint64_t done = 0;  // set of exhibits that are not shown any more
  double left_s = 0.0;
  int explained = 0;
};
struct Key {
  std::size_t at;
  std::uint64_t done;
  std::int64_t left;
  int explained;
  friend bool operator==(const Key&, const Key&) = default;
};
struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t hash = key.done * 0x9E3779B97F4A7C15ULL;
    hash = (hash ^ static_cast<std::uint64_t>(key.left) ^ (static_cast<std::uint64_t>(key.at) << 32U)) *
           0xBF58476D1CE4E5B9ULL;
    return static_cast<std::size_t>(hash ^ (hash >> 29U) ^ static_cast<std::uint64_t>(key.explained));
  }
};

/// How long a visit lasts from the arrival on [s].
struct VisitLengths {
  double unasked_s = 0.0;
  double went_on_s = 0.0;
  double heard_more_s = 0.0;
  bool can_ask = false;
};

struct Step {
  double loss = kNever;
  std::size_t next = kMostExhibits;  // none: the end
  bool asks = false;
  bool is_sensible = true;
};

struct Choices {
  std::array<std::size_t, std::max(kMostFirst, kMostNext)> exhibits{};
  std::size_t count = 0;
  bool are_sensible = true;
};

class Search {
 public:
  Search(const Programme& programme, const TourSoFar& tour, const TravelDistance& travel, const TravelTimes& times,
         Time now, const CompositionParams& params)
      : params_{params}, farewell_s_{programme.farewell_s} {
    gather(programme, tour, travel);
    const std::string start = place_at(programme, tour.robot);
    foresee(start, tour.robot, travel, times, now);
    for (std::size_t i = 0; i < exhibits_.size(); ++i) {
      const SpokenLength spoken = exhibits_[i]->length_in(tour.language);
      lengths_.push_back({spoken.short_s + times.beyond_speech(VisitCourse::unasked),
                          spoken.short_s + times.beyond_speech(VisitCourse::went_on),
                          spoken.short_s + spoken.long_s + times.beyond_speech(VisitCourse::heard_more),
                          tour.may_ask && spoken.long_s > 0.0});
      is_wished_.push_back(holds(tour.wished, exhibits_[i]->id));
    }
    share_of_more_ = times.share_of_more();
    link(programme, tour);
  }

  [[nodiscard]] TourPlan plan(const TourSoFar& tour) {
    State state{exhibits_.size(), done_, tour.left_s, tour.explained};
    TourPlan plan;
    for (bool is_first = true;; is_first = false) {
      const Step step = best(state, is_first);
      if (is_first) plan.expected_loss = step.loss;
      if (step.next == kMostExhibits) return plan;
      if (is_first) {
        plan.asks = step.asks;
        plan.is_sensible = step.is_sensible;
      }
      plan.stops.push_back(exhibits_[step.next]->id);
      const double asked_s = share_of_more_ * more_s(step.next) + (1.0 - share_of_more_) * asked_short_s(step.next);
      state = after(state, step.next, way(state.at, step.next).mean_s + (step.asks ? asked_s : short_s(step.next)));
    }
  }

 private:
  /// The exhibits that a tour may show, the nearest ones if there are more than a set can hold.
  void gather(const Programme& programme, const TourSoFar& tour, const TravelDistance& travel) {
    std::vector<std::pair<double, const ProgrammeExhibit*>> near;
    for (const ProgrammeExhibit& exhibit : programme.exhibits) {
      if (exhibit.is_point) continue;
      if (exhibit.web_only || holds(tour.done, exhibit.id)) continue;
      const double way_m = travel(tour.robot, exhibit.pose.position());
      if (std::isfinite(way_m)) near.emplace_back(way_m, &exhibit);
    }
    if (near.size() > kMostExhibits) {
      std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      near.resize(kMostExhibits);
    }
    for (const auto& [way_m, exhibit] : near) exhibits_.push_back(exhibit);
  }

  /// The ways between all of them, and (last row) from where the robot stands.
  void foresee(const std::string& start, Point2 robot, const TravelDistance& travel, const TravelTimes& times,
               Time now) {
    const std::size_t n = exhibits_.size();
    for (std::size_t from = 0; from <= n; ++from) {
      const Point2 place = from < n ? exhibits_[from]->pose.position() : robot;
      const std::string& name = from < n ? exhibits_[from]->id : start;
      for (const ProgrammeExhibit* to : exhibits_)
        ways_.push_back(times.way(name, to->id, travel(place, to->pose.position()), now));
    }
  }

  /// Which exhibits are tried after each, the nearest first.
  void link(const Programme& programme, const TourSoFar& tour) {
    const std::size_t n = exhibits_.size();
    const ProgrammeExhibit* before = programme.find_exhibit(tour.after);
    for (std::size_t from = 0; from <= n; ++from) {
      const ProgrammeExhibit* exhibit = from < n ? exhibits_[from] : before;
      std::vector<std::size_t> all(n);
      std::iota(all.begin(), all.end(), std::size_t{0});
      std::erase_if(all, [&](std::size_t to) { return !std::isfinite(way(from, to).mean_s); });
      std::stable_sort(all.begin(), all.end(),
                       [&](std::size_t a, std::size_t b) { return way(from, a).mean_s < way(from, b).mean_s; });
      std::vector<std::size_t> sensible;
      for (const std::size_t to : all) {
        if (exhibit != nullptr && to != from && holds(exhibit->next, exhibits_[to]->id)) sensible.push_back(to);
      }
      nearest_.push_back(std::move(all));
      sensible_.push_back(std::move(sensible));
    }
    is_started_ = before != nullptr;
  }

  [[nodiscard]] const Foreseen& way(std::size_t from, std::size_t to) const {
    return ways_[from * exhibits_.size() + to];
  }
  [[nodiscard]] double short_s(std::size_t i) const { return lengths_[i].unasked_s; }
  [[nodiscard]] double asked_short_s(std::size_t i) const { return lengths_[i].went_on_s; }
  [[nodiscard]] double more_s(std::size_t i) const { return lengths_[i].heard_more_s; }
  [[nodiscard]] static State after(const State& state, std::size_t next, double seconds) {
    return {next, state.done | (std::uint64_t{1} << next), state.left_s - seconds, state.explained + 1};
  }

  /// Sensible exhibits that are left; where there are none, any; none that was done.
  [[nodiscard]] Choices choices(const State& state, bool is_first) const {
    Choices found;
    const std::size_t most = is_first ? kMostFirst : state.left_s > params_.plan_ahead_s ? 1 : kMostNext;
    const auto take = [&](const std::vector<std::size_t>& list) {
      for (const std::size_t i : list) {
        if (found.count < most && ((state.done >> i) & 1U) == 0) found.exhibits[found.count++] = i;
      }
    };
    const bool is_begin = state.at == exhibits_.size() && !is_started_;
    if (!is_begin) take(sensible_[state.at]);
    if (found.count > 0) return found;
    found.are_sensible = is_begin;
    take(nearest_[state.at]);
    return found;
  }

  [[nodiscard]] double loss_after(const State& state) {
    const Key key{state.at, state.done, std::llround(state.left_s / kTimeStep), state.explained};
    if (const auto place = known_.find(key); place != known_.end()) return place->second;
    const double loss = best(state, false).loss;
    known_.emplace(key, loss);
    return loss;
  }

  [[nodiscard]] bool is_near_end(const State& state) const {
    return state.left_s < params_.spread_ahead_s && state.left_s > -kHopeless;
  }

  /// The mean loss when the tour goes on with `next`.
  [[nodiscard]] double loss_of(const State& state, std::size_t next, bool asks) {
    const Foreseen& on_way = way(state.at, next);
    const bool is_near = is_near_end(state);
    double loss = 0.0;
    for (const Outcome& outcome : kOutcomes) {
      const double weight = is_near ? outcome.weight : 1.0;
      const double way_s = std::max(0.0, on_way.mean_s + outcome.off * on_way.spread_s);
      if (!asks) {
        loss += weight * loss_after(after(state, next, way_s + short_s(next)));
      } else if (is_near) {
        loss += weight * (share_of_more_ * loss_after(after(state, next, way_s + more_s(next))) +
                          (1.0 - share_of_more_) * loss_after(after(state, next, way_s + asked_short_s(next))));
      } else {
        const double mean_s = share_of_more_ * more_s(next) + (1.0 - share_of_more_) * asked_short_s(next);
        loss += weight * loss_after(after(state, next, way_s + mean_s));
      }
      if (!is_near) break;  // the first outcome is the mean
    }
    return loss;
  }

  [[nodiscard]] Step best(const State& state, bool is_first) {
    Step best;
    const bool may_end = state.explained >= params_.least_exhibits;
    const double off_s = state.left_s - farewell_s_;
    if (may_end) best.loss = off_s * off_s;
    if (may_end && off_s <= 0.0) return best;
    const Choices open = choices(state, is_first);
    for (std::size_t k = 0; k < open.count; ++k) {
      const std::size_t next = open.exhibits[k];
      const double way_s = way(state.at, next).mean_s;
      if (may_end && way_s + short_s(next) > 2.0 * off_s + kHopeless) continue;
      const double cost = params_.way_cost * way_s + (open.are_sensible ? 0.0 : params_.odd_pair_cost) -
                          (is_wished_[next] ? params_.wished_gain : 0.0);
      for (const bool asks : {true, false}) {
        const bool can_ask = lengths_[next].can_ask;
        if (asks ? !can_ask : can_ask && state.left_s >= params_.spread_ahead_s) continue;  // there is time to ask
        const double loss = loss_of(state, next, asks) + cost - (asks ? params_.question_gain : 0.0);
        if (loss < best.loss) best = {loss, next, asks, open.are_sensible};
      }
    }
    if (best.next == kMostExhibits && !may_end) best.loss = off_s * off_s;  // there are no more
    return best;
  }

  CompositionParams params_;
  double farewell_s_;
  double share_of_more_ = 0.0;
  std::vector<const ProgrammeExhibit*> exhibits_;
  std::vector<Foreseen> ways_;
  std::vector<VisitLengths> lengths_;
  std::vector<bool> is_wished_;
  std::vector<std::vector<std::size_t>> nearest_;   // by where the robot is
  std::vector<std::vector<std::size_t>> sensible_;  // likewise
  bool is_started_ = false;
  std::uint64_t done_ = 0;
  std::unordered_map<Key, double, KeyHash> known_;
};

}  // namespace

Result<void> CompositionParams::validate() const {
  if (least_exhibits < 1) return fail("mission.composition.least_exhibits must be >= 1");
  const std::array<std::pair<const char*, double>, 6> others{{{"plan_ahead_s", plan_ahead_s},
                                                              {"spread_ahead_s", spread_ahead_s},
                                                              {"way_cost", way_cost},
                                                              {"question_gain", question_gain},
                                                              {"wished_gain", wished_gain},
                                                              {"odd_pair_cost", odd_pair_cost}}};
  for (const auto& [name, value] : others) {
    if (!(value >= 0.0)) return fail("mission.composition." + std::string{name} + " must be >= 0");
  }
  return {};
}

TourPlan plan_tour(const Programme& programme, const TourSoFar& tour, const TravelDistance& travel,
                   const TravelTimes& times, Time now, const CompositionParams& params) {
  return Search{programme, tour, travel, times, now, params}.plan(tour);
}

double stop_duration(const SpokenLength& spoken, double way_s, bool asks, const TravelTimes& times) {
  return way_s + spoken.short_s + times.beyond_speech(asks ? VisitCourse::went_on : VisitCourse::unasked);
}

}  // namespace docent::task_control
