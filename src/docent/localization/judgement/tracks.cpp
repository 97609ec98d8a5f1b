#include "docent/localization/judgement/tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "docent/localization/judgement/beam_fit.h"
#include "docent/localization/judgement/view_matcher.h"

namespace docent::localization {
namespace {

constexpr std::size_t kMostFound = 24;  // of the places that a search finds, those that fit best

}  // namespace

Result<void> TracksParams::validate() const {
  if (!(spacing > 0.0 && turned > 0.0)) return fail("tracks.spacing and turned must be > 0");
  if (!(most_views >= 1 && most_views <= 1000)) return fail("tracks.most_views must be 1..1000");
  if (!(most_tracks >= 2 && most_tracks <= 1000)) return fail("tracks.most_tracks must be 2..1000");
  if (!(beams >= 10 && beams <= 720)) return fail("tracks.beams must be 10..720");
  if (!(nats > 0.0 && part > 0.0 && wall_part > 0.0)) return fail("tracks.nats, part and wall_part must be > 0");
  if (!(first_short > 0.0)) return fail("tracks.first_short must be > 0");
  if (!(too_short >= 0.0 && too_short <= 1.0)) return fail("tracks.too_short must be 0..1");
  if (!(part_beams >= 0.0)) return fail("tracks.part_beams must be >= 0");
  if (!(hopeless > 0.0 && given >= 0.0 && followed >= 0.0 && carried_off >= 0.0 && startled >= 0.0 &&
        startled_given >= 0.0 && most_heard >= 0.0))
    return fail(
        "tracks.hopeless must be > 0, given, followed, carried_off, startled, startled_given and most_heard >= 0");
  if (!(search_way > 0.0 && search_way_kept > 0.0 && search_way_calm > 0.0))
    return fail("tracks.search_way, search_way_kept and search_way_calm must be > 0");
  if (!(usual_nats > 0.0 && doubt_nats > 0.0)) return fail("tracks.usual_nats and doubt_nats must be > 0");
  return {};
}

void Tracks::forget() {
  views_.clear();
  tracks_.clear();
  given_ = 0.0;
  startled_ = params_.startled;
  search_watch_.begin();
}

void Tracks::start_at(std::span<const BeliefMode> modes, const Pose2& odom_from_robot) {
  forget();
  given_ = params_.given;
  startled_ = params_.startled_given;
  odom_from_start_ = odom_from_robot;
  for (const BeliefMode& mode : modes) {
    Track track{{mode.map_from_robot}, {}, 0, PartSums{params_.part_beams}};
    track.past = -std::log(std::max(mode.mass, 1e-3));
    tracks_.push_back(std::move(track));
  }
}

bool Tracks::is_due(const Pose2& odom_from_robot, bool is_startled) const {
  if (views_.empty()) return true;
  const View& last = views_.back();
  if (is_startled && !last.is_startled) return true;
  return !is_one_view(last.odom_from_robot, odom_from_robot);
}

bool Tracks::is_one_view(const Pose2& odom_from_robot, const Pose2& other) const {
  const Pose2 moved = inverse(odom_from_robot) * other;
  return norm(moved.position()) < params_.spacing && std::abs(moved.theta.degrees()) < params_.turned;
}

std::vector<PartCost> Tracks::costs_at(const View& view, const Pose2& pose) const {
  return beam_costs(*caster_, view.sweep, pose, {max_range_, params_.part, params_.wall_part});
}

Pose2 Tracks::followed(const Pose2& from, const View& view, const View& next) const {
  const Pose2 step = inverse(view.odom_from_robot) * next.odom_from_robot;
  return matched(*caster_, next.sweep, max_range_, from * step, guess_error(motion_, step));
}

double Tracks::nats(const PartSums& sums) const {
  // A crowd explains many readings that end too early nearly as well as few.
  const double all = params_.nats * sums.floor();
  const double first = params_.first_short * -std::expm1(-all / params_.first_short);
  const double shorts = first + params_.too_short * (all - first);
  return params_.nats * sums.walls() + shorts;
}

double Tracks::nats(const Track& track) const { return nats(track.sums) + track.past; }

double Tracks::least_nats() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Track& track : tracks_) least = std::min(least, nats(track));
  return least;
}

void Tracks::drop_first_view() {
  // What is forgotten of a way is still held against it, but for what another view of the same place goes on saying: a
  // robot that turns on one spot for minutes would else be told ever more of it.
  const bool is_seen_again = std::any_of(views_.begin() + 1, views_.end(), [&](const View& view) {
    return is_one_view(views_.front().odom_from_robot, view.odom_from_robot);
  });
  for (Track& track : tracks_) {
    if (track.since > 0) {
      --track.since;
      continue;
    }
    const double before = nats(track);
    track.sums.take_out(track.costs.front());
    track.costs.pop_front();
    track.poses.pop_front();
    if (!is_seen_again) track.past += before - nats(track);
  }
  views_.pop_front();
  if (is_seen_again) return;
  // Whoever has followed one way for long is not told by a place that explains the last metres alone.
  given_ = std::max(given_, std::min(params_.followed, given_ + params_.followed / params_.most_views));
}

void Tracks::add_view(const sensor_models::RangeSweep& sweep, const Pose2& odom_from_robot, bool is_startled,
                      const std::optional<Pose2>& best) {
  const bool is_first = views_.empty();
  View view{thinned(sweep, params_.beams), odom_from_robot, is_startled};
  if (static_cast<int>(views_.size()) >= params_.most_views) drop_first_view();
  const double before = least_nats();
  const View from = is_first ? View{{}, odom_from_start_, false} : views_.back();
  const Pose2 step = inverse(from.odom_from_robot) * odom_from_robot;
  views_.push_back(std::move(view));
  for (Track& track : tracks_) {
    const Pose2 expected = track.poses.back() * step;
    const Pose2 pose = best && is_same_place(expected, *best)
                           ? matched(*caster_, views_.back().sweep, max_range_, *best, kMatchError)
                           : followed(track.poses.back(), from, views_.back());
    if (is_first) track.poses.clear();
    track.poses.push_back(pose);
    track.costs.push_back(costs_at(views_.back(), pose));
    track.sums.add(track.costs.back());
  }
  search_watch_.see(is_first ? 0.0 : norm(step.position()), tracks_.empty() ? 0.0 : least_nats() - before);
  prune();
}

std::vector<double> Tracks::best_before() const {
  std::vector<double> best(views_.size(), std::numeric_limits<double>::infinity());
  for (const Track& track : tracks_) {
    if (track.since >= views_.size()) continue;
    PartSums sums{params_.part_beams};
    best[track.since] = std::min(best[track.since], track.past);
    for (std::size_t k = track.since; k + 1 < views_.size(); ++k) {
      sums.add(track.costs[k - track.since]);
      best[k + 1] = std::min(best[k + 1], track.past + nats(sums));
    }
  }
  return best;
}

Tracks::Track Tracks::followed_back(const Pose2& map_from_robot, std::span<const double> before) const {
  const std::size_t last = views_.size() - 1;
  Track way{{}, {}, last, PartSums{params_.part_beams}};
  const double best_now = tracks_.empty() ? 0.0 : least_nats();
  const double least_past = std::isfinite(before.front()) ? before.front() : 0.0;
  Track found = way;
  double least = std::numeric_limits<double>::infinity();
  Pose2 pose = matched(*caster_, views_[last].sweep, max_range_, map_from_robot, {0.15, 0.05});
  for (std::size_t k = last + 1; k-- > 0;) {
    if (k < last) pose = followed(pose, views_[k + 1], views_[k]);
    way.since = k;
    way.poses.push_front(pose);
    way.costs.push_front(costs_at(views_[k], pose));
    way.sums.add(way.costs.front());
    const double own = nats(way.sums);
    const bool is_whole = k == 0;
    const double past =
        is_whole ? least_past + given_ : before[k] + (views_[k].is_startled ? startled_ : params_.carried_off);
    if (std::isfinite(past) && own + past < least) {
      least = own + past;
      found = way;
      found.past = past;
    }
    if (std::isfinite(least) && own > best_now + 2.0 * params_.hopeless) break;
  }
  if (!std::isfinite(least)) found.past = std::numeric_limits<double>::infinity();
  return found;
}

void Tracks::take_in(std::span<const Pose2> map_from_robot) {
  if (views_.empty()) return;
  std::vector<double> before = best_before();
  if (tracks_.empty()) before.front() = 0.0;
  bool has_new = false;
  for (const Pose2& pose : map_from_robot) {
    const bool is_known = std::any_of(tracks_.begin(), tracks_.end(),
                                      [&](const Track& track) { return is_same_place(track.poses.back(), pose); });
    if (is_known) continue;
    Track track = followed_back(pose, before);
    if (!std::isfinite(track.past)) continue;
    tracks_.push_back(std::move(track));
    has_new = true;
  }
  if (has_new) prune();
}

void Tracks::prune() {
  std::stable_sort(tracks_.begin(), tracks_.end(), [&](const Track& a, const Track& b) { return nats(a) < nats(b); });
  std::vector<Track> kept;
  const double least = tracks_.empty() ? 0.0 : nats(tracks_.front());
  for (Track& track : tracks_) {
    if (static_cast<int>(kept.size()) >= params_.most_tracks || nats(track) > least + params_.hopeless) break;
    const bool has_met = std::any_of(kept.begin(), kept.end(), [&](const Track& other) {
      return is_same_place(other.poses.back(), track.poses.back());
    });
    if (!has_met) kept.push_back(std::move(track));
  }
  tracks_ = std::move(kept);
  double least_past = std::numeric_limits<double>::infinity();
  for (const Track& track : tracks_) least_past = std::min(least_past, track.past);
  if (!tracks_.empty())
    for (Track& track : tracks_) track.past -= least_past;
}

bool Tracks::is_search_due(bool keeps_its_place, bool in_doubt) const {
  return search_watch_.is_due(keeps_its_place, in_doubt) || (!views_.empty() && views_.back().is_startled);
}

void Tracks::search(const PlaceSearch& places) {
  if (views_.empty()) return;
  search_watch_.searched();
  PlaceSearch::Wanted wanted;
  wanted.max_range = max_range_;
  std::vector<Pose2> poses;
  struct Candidate {
    Pose2 pose;
    double cost = 0.0;
  };
  std::vector<Candidate> candidates;
  for (const FoundPlace& place : places.find(views_.back().sweep, wanted)) {
    const Pose2 pose = matched(*caster_, views_.back().sweep, max_range_, place.map_from_robot, {0.15, 0.05});
    PartSums sums{params_.part_beams};
    sums.add(costs_at(views_.back(), pose));
    candidates.push_back({pose, nats(sums)});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  for (const Candidate& candidate : candidates)
    if (poses.size() < kMostFound) poses.push_back(candidate.pose);
  take_in(poses);
}

Pose2 Tracks::now(const Track& track, const Pose2& odom_from_robot) const {
  const Pose2& then = views_.empty() ? odom_from_start_ : views_.back().odom_from_robot;
  return track.poses.back() * (inverse(then) * odom_from_robot);
}

void Tracks::hear(const ObservationModels& others, double weight, const Pose2& odom_from_robot) {
  if (tracks_.empty() || others.none()) return;
  std::vector<double> costs;
  for (const Track& track : tracks_) costs.push_back(others.cost(now(track, odom_from_robot)));
  const double least = *std::min_element(costs.begin(), costs.end());
  double least_heard = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    tracks_[i].heard += weight * (costs[i] - least);
    least_heard = std::min(least_heard, tracks_[i].heard);
  }
  for (Track& track : tracks_) track.heard = std::min(track.heard - least_heard, params_.most_heard);
}

std::vector<Tracks::Place> Tracks::places(const Pose2& odom_from_robot) const {
  std::vector<Place> places;
  double least = std::numeric_limits<double>::infinity();
  for (const Track& track : tracks_) least = std::min(least, nats(track) + track.heard);
  double sum = 0.0;
  for (const Track& track : tracks_) {
    places.push_back({now(track, odom_from_robot), std::exp(least - nats(track) - track.heard)});
    sum += places.back().share;
  }
  for (Place& place : places) place.share /= sum;
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.share > b.share; });
  return places;
}

}  // namespace docent::localization
