#include "docent/localization/judgement/hindsight.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "docent/localization/judgement/beam_fit.h"
#include "docent/localization/judgement/view_matcher.h"

namespace docent::localization {
namespace {

/// The way of one robot, view by view, from the last to the first.
class LookBack {
 public:
  LookBack(const sensor_models::RayCaster& caster, std::span<const PastSweep> sweeps, const HindsightParams& params)
      : caster_{caster}, sweeps_{sweeps}, params_{params} {
    choose_views();
    poses_.resize(views_.size());
    strange_.resize(views_.size(), 0.0);
  }

  [[nodiscard]] std::vector<std::optional<Pose2>> run() {
    std::size_t strange = 0;  // views on end
    for (std::size_t k = views_.size(); k-- > 0;) {
      const bool goes_on = k + 1 < views_.size() && poses_[k + 1].has_value();
      if (!goes_on && !said(k)) continue;
      set(k, goes_on ? followed(*poses_[k + 1], k + 1, k) : *said(k));
      strange = strange_[k] > params_.strange && !said(k) ? strange + 1 : 0;
      if (strange >= params_.most_strange_views) {
        for (std::size_t s = k; s < k + strange; ++s) poses_[s].reset();
        strange = 0;
      }
      if (is_disputed(k) && (k == 0 || !says_on(k - 1))) settle(k);
    }
    for (int round = 0; round < params_.smoothings; ++round) smooth();
    return of_all_sweeps();
  }

 private:
  void choose_views() {
    const auto is_far = [&](const Pose2& from, const Pose2& to) {
      const Pose2 moved = inverse(from) * to;
      return norm(moved.position()) >= params_.tracks.spacing ||
             std::abs(moved.theta.degrees()) >= params_.tracks.turned;
    };
    for (std::size_t i = 0; i < sweeps_.size(); ++i)
      if (views_.empty() || i + 1 == sweeps_.size() ||
          is_far(sweeps_[views_.back()].odom_from_robot, sweeps_[i].odom_from_robot))
        views_.push_back(i);
  }

  [[nodiscard]] const PastSweep& view(std::size_t k) const { return sweeps_[views_[k]]; }
  /// Where the robot said that it was.
  [[nodiscard]] std::optional<Pose2> said(std::size_t k) const { return view(k).is_sure ? view(k).best : std::nullopt; }

  [[nodiscard]] sensor_models::RangeSweep looked_at(std::size_t k) const {
    return within_reach(thinned(view(k).sweep, params_.tracks.beams), params_.max_range);
  }
  [[nodiscard]] Pose2 matched_at(std::size_t k, const Pose2& guess, const GuessError& error) const {
    return matched(caster_, looked_at(k), params_.max_range, guess, error);
  }
  [[nodiscard]] Pose2 odometry(std::size_t from, std::size_t to) const {
    return inverse(view(from).odom_from_robot) * view(to).odom_from_robot;
  }
  [[nodiscard]] Pose2 followed(const Pose2& pose, std::size_t from, std::size_t to) const {
    const Pose2 step = odometry(from, to);
    const Pose2 expected = pose * step;
    if (view(to).best && is_same_place(*view(to).best, expected)) return *view(to).best;
    return matched_at(to, expected, guess_error(params_.motion, step));
  }
  [[nodiscard]] std::vector<PartCost> costs(std::size_t k, const Pose2& pose) const {
    return beam_costs(caster_, looked_at(k), pose, {params_.max_range, params_.tracks.part, params_.tracks.wall_part});
  }
  /// Share of the view's readings that the map does not explain from there.
  [[nodiscard]] double strangeness(std::size_t k, const Pose2& pose) const {
    const auto of_view = costs(k, pose);
    double sum = 0.0;
    for (const PartCost& one : of_view) sum += static_cast<double>(one.cost);
    return of_view.empty() ? 0.0 : sum / static_cast<double>(of_view.size());
  }
  void set(std::size_t k, const Pose2& pose) {
    poses_[k] = pose;
    strange_[k] = strangeness(k, pose);
  }

  [[nodiscard]] bool is_disputed(std::size_t k) const {
    return poses_[k] && said(k) && !is_same_place(*said(k), *poses_[k]);
  }
  /// Whether what was said at the next view is the place that was said at this one.
  [[nodiscard]] bool says_on(std::size_t k) const {
    if (!said(k) || !said(k + 1)) return false;
    return is_same_place(*said(k) * odometry(k, k + 1), *said(k + 1));
  }

  /// The robot had said other places from the `first` view on, which now ends: which of the two ways was it?
  void settle(std::size_t first) {
    std::size_t end = first;
    PartSums of_way{params_.tracks.part_beams}, of_said{params_.tracks.part_beams};
    for (; end < views_.size() && is_disputed(end); ++end) {
      of_way.add(costs(end, *poses_[end]));
      of_said.add(costs(end, *said(end)));
    }
    const auto nats = [&](const PartSums& sums) { return params_.tracks.nats * (sums.walls() + sums.floor()); };
    if (nats(of_way) <= nats(of_said) + params_.tracks.carried_off) return;
    for (std::size_t k = first; k < end; ++k) set(k, *said(k));
    carry_on(end);
  }

  /// The robot was where it had said before the view `begin`, and somebody carried it later: when?
  void carry_on(std::size_t begin) {
    std::vector<Pose2> stayed;        // had nobody carried it
    double gained = 0.0, most = 0.0;  // what the way explains worse than having stayed, summed
    std::size_t carried = begin;
    for (std::size_t k = begin; k < std::min(views_.size(), begin + params_.carried_within) && poses_[k]; ++k) {
      stayed.push_back(followed(k == begin ? *poses_[k - 1] : stayed.back(), k - 1, k));
      gained += strange_[k] - strangeness(k, stayed.back());
      if (gained <= most) continue;
      most = gained;
      carried = k + 1;
    }
    for (std::size_t k = begin; k < carried; ++k) set(k, stayed[k - begin]);
  }

  /// Every pose between those before and after it: what was believed came from one side of the way only.
  void smooth() {
    for (std::size_t k = 1; k + 1 < views_.size(); ++k) {
      if (!poses_[k - 1] || !poses_[k] || !poses_[k + 1]) continue;
      const Pose2 step = odometry(k - 1, k);
      const Pose2 from_before = *poses_[k - 1] * step;
      const Pose2 from_after = *poses_[k + 1] * odometry(k + 1, k);
      if (!is_same_place(from_before, from_after)) continue;  // carried off
      const Pose2 between{0.5 * (from_before.x + from_after.x), 0.5 * (from_before.y + from_after.y),
                          from_before.theta + Angle::radians(0.5 * (from_after.theta - from_before.theta).radians())};
      const Pose2 pose = matched_at(k, between, guess_error(params_.motion, step));
      const double strange = strangeness(k, pose);
      if (strange > strange_[k] + params_.much_stranger) continue;  // people, not walls, were matched
      poses_[k] = pose;
      strange_[k] = strange;
    }
  }

  [[nodiscard]] std::vector<std::optional<Pose2>> of_all_sweeps() const {
    std::vector<std::optional<Pose2>> all(sweeps_.size());
    for (std::size_t k = 0; k < views_.size(); ++k) {
      if (!poses_[k]) continue;
      const Pose2 map_from_odom = *poses_[k] * inverse(view(k).odom_from_robot);
      const std::size_t first = k == 0 ? 0 : views_[k - 1] + 1;
      for (std::size_t i = first; i <= views_[k]; ++i) all[i] = map_from_odom * sweeps_[i].odom_from_robot;
    }
    return all;
  }

  const sensor_models::RayCaster& caster_;
  std::span<const PastSweep> sweeps_;
  const HindsightParams& params_;
  std::vector<std::size_t> views_;           // of the sweeps, some tenths of a metre from one to the next
  std::vector<std::optional<Pose2>> poses_;  // at the views
  std::vector<double> strange_;              // likewise, share that the map does not explain
};

}  // namespace

std::vector<std::optional<Pose2>> seen_in_hindsight(const sensor_models::RayCaster& caster,
                                                    std::span<const PastSweep> sweeps, const HindsightParams& params) {
  return LookBack{caster, sweeps, params}.run();
}

}  // namespace docent::localization
