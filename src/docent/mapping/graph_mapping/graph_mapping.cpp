#include "docent/mapping/graph_mapping/graph_mapping.h"

#include <algorithm>
#include <cmath>

#include "docent/mapping/pose_graph/marginal_covariance.h"
#include "docent/mapping/pose_graph/relative_covariance.h"

namespace docent::mapping {
namespace {

constexpr std::size_t kFewestSteps = 20;  ///< that were matched: before, nothing is known of the odometry

}  // namespace

GraphMapping::GraphMapping(const GraphMapperParams& params)
    : params_{params}, chain_{params.chain, params.chain_grid, params.lines}, closer_{params.loops, params.lines} {}

void GraphMapping::add(MappingScan scan) {
  scans_.push_back(std::move(scan));
  const std::size_t i = scans_.size() - 1;
  points_ += scans_[i].points.size();
  if (i == 0) {
    graph_.add_pose(scans_.front().odom_from_base);
    return;
  }
  ChainStep step = chain_.step(scans_, graph_.poses(), i);
  if (contradicts_odometry(step, scans_[i])) step = chain_.odometry_step(scans_, i);
  graph_.add_pose(graph_.poses()[i - 1] * step.before_from_after);
  graph_.add({i - 1, i, step.before_from_after, step.information, false, !step.is_matched});
  unmatched_ += step.is_matched ? 0U : 1U;
  if (step.is_matched) surprises_.push_back(step.surprise);
  way_ += norm(step.before_from_after.position());
  turn_ += std::abs(step.before_from_after.theta.radians());
  if (is_submap_full(i)) end_submap(i);
  if (!has_begun_anew_ && surprises_.size() >= static_cast<std::size_t>(params_.first_steps)) begin_anew();
}

/// With what has been learned of odometry and of scans.
void GraphMapping::begin_anew() {
  GraphMapping anew{params_};
  anew.has_begun_anew_ = true;
  anew.surprises_ = std::move(surprises_);
  anew.revision_ = revision_ + 1;
  for (MappingScan& scan : scans_) anew.add(std::move(scan));
  *this = std::move(anew);
}

GraphMap GraphMapping::finish(const std::function<void(const MappingProgress&)>& progress) {
  if (scans_.empty()) return {};
  const auto tell = [&](const char* stage, std::size_t done) {
    if (progress) progress({stage, done, scans_.size(), loops_, graph_.poses()});
  };
  if (first_ + 1 < scans_.size()) end_submap(scans_.size() - 1);
  // Once more over all submaps, now that the map is as good as the drive could make it.
  for (std::size_t newer = 0; newer < submaps_.size(); ++newer) {
    if (close_loops(newer)) optimise();
    tell("loops", submaps_[newer].last());
  }
  optimise();
  for (int round = 0; round < params_.fine_rounds; ++round) refine(round);
  tell("fine", scans_.size());
  GraphMap map{graph_.poses(),
               loops_,
               refused_,
               unmatched_,
               0,
               0.0,
               judge(graph_, submaps_, restlessness(), odometry_scale(), params_.judgement)};
  map.revisits = revisits_.size();
  for (const PoseConstraint& revisit : revisits_) map.revisit_error += missed_by(revisit);
  if (map.revisits > 0) map.revisit_error /= static_cast<double>(map.revisits);
  return map;
}

/// A scan with few points that odometry, as good as it has proved to be, cannot have made so wrong: a person that walks
/// along, in a hall whose walls are far away.
bool GraphMapping::contradicts_odometry(const ChainStep& step, const MappingScan& scan) const {
  if (!step.is_matched || surprises_.size() < kFewestSteps) return false;
  const double usual = static_cast<double>(points_) / static_cast<double>(scans_.size());
  if (static_cast<double>(scan.points.size()) >= params_.few_points * usual) return false;
  const double sigmas = params_.contradiction * odometry_scale();
  return step.surprise > sigmas * sigmas;
}

bool GraphMapping::is_submap_full(std::size_t last) const {
  const SubmapParams& bounds = params_.submaps;
  return way_ >= bounds.way || turn_ >= bounds.turn || last - first_ + 1 >= static_cast<std::size_t>(bounds.scans);
}

void GraphMapping::end_submap(std::size_t last) {
  submaps_.emplace_back(scans_, graph_.poses(), first_, last, params_.submaps, params_.loop_grid);
  first_ = last;  // the next one shares this scan
  way_ = 0.0;
  turn_ = 0.0;
  if (submaps_.back().points().empty()) {
    submaps_.pop_back();
    return;
  }
  note_restlessness();
  if (close_loops(submaps_.size() - 1)) optimise();
  rate_marks();
}

void GraphMapping::optimise() {
  ++revision_;
  const double scale = binding_scale();
  graph_.optimise(params_.graph, scale);
  const std::size_t removed = graph_.remove_wrong_loops(params_.graph);
  refused_ += removed;
  if (removed > 0) graph_.optimise(params_.graph, scale);
}

/// Between the newest submap and the last but two, which the chain has matched to each other: what walks about.
void GraphMapping::note_restlessness() {
  constexpr std::size_t kApart = 2;
  if (submaps_.size() <= kApart) return;
  const std::size_t newest = submaps_.size() - 1;
  const Pose2 older_from_newer = inverse(middle_of(newest - kApart)) * middle_of(newest);
  restless_.push_back(share_in_conflict(submaps_[newest - kApart], submaps_[newest], older_from_newer));
}
double GraphMapping::restlessness() const {
  constexpr std::size_t kFewest = 5;
  if (restless_.size() < kFewest) return 0.0;
  std::vector<double> shares = restless_;
  const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
  std::nth_element(shares.begin(), middle, shares.end());
  return *middle;
}

/// How odometry errs by the steps that scans bear out, as a share of what was expected of it: a mean without the
/// largest, which are wrong matches as likely.
double GraphMapping::odometry_scale() const {
  constexpr double kKept = 0.95;
  constexpr double kLeast = 0.01;  // no odometry is perfect
  if (surprises_.size() < kFewestSteps) return 1.0;
  std::vector<double> sorted = surprises_;
  std::sort(sorted.begin(), sorted.end());
  const auto kept = static_cast<std::size_t>(kKept * static_cast<double>(sorted.size()));
  double sum = 0.0;
  for (std::size_t i = 0; i < kept; ++i) sum += sorted[i];
  return std::max(kLeast, std::sqrt(sum / static_cast<double>(kept)));
}

double GraphMapping::binding_scale() const {
  return std::clamp(params_.odometry_margin * odometry_scale(), params_.least_odometry_scale, 1.0);
}

/// A mark at the newest pose, told in the frame of the first one: if that frame, seen from here, lies wrong by (x, y,
/// theta), the mark is off by (x, y) + theta * the normal of the way to it.
void GraphMapping::rate_marks() {
  const PoseGraph rated = graph_.with_odometry(binding_scale());
  const Eigen::Matrix3d covariance = MarginalCovariances{rated}.between(graph_.poses().size() - 1, 0);
  const Point2 first = (inverse(graph_.poses().back()) * graph_.poses().front()).position();
  Eigen::Matrix<double, 2, 3> from_frame;
  from_frame << 1.0, 0.0, first.y, 0.0, 1.0, -first.x;
  const Eigen::Matrix2d of_mark = from_frame * covariance * from_frame.transpose();
  doubt_of_marks_ = std::sqrt(std::max(0.0, 0.5 * of_mark.trace()));
}

/// Older submaps that may show the same place, the likeliest first.
std::vector<GraphMapping::LoopCandidate> GraphMapping::candidates_for(std::size_t newer) {
  constexpr std::size_t kRecent = 3;  ///< submaps that the chain itself is matched to, nearly
  std::vector<LoopCandidate> candidates;
  if (newer < kRecent) return candidates;
  const auto covariances = covariances_seen_from(graph_, submaps_[newer].middle());
  const Eigen::Matrix3d& first = covariances.front();
  spread_ = {std::sqrt(std::max(first(0, 0), first(1, 1))), std::sqrt(first(2, 2))};
  for (std::size_t older = 0; older + kRecent <= newer; ++older) {
    if (closed_.contains({older, newer})) continue;
    const Eigen::Matrix3d& covariance = covariances[submaps_[older].middle()];
    const double sigma = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
    const double apart = distance(middle_of(older).position(), middle_of(newer).position());
    if (apart - params_.loops.sigmas * sigma > params_.loop_reach) continue;
    candidates.push_back({older, apart / (params_.loop_reach + sigma), covariance});
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const LoopCandidate& a, const LoopCandidate& b) {
    return a.likelihood_order < b.likelihood_order;
  });
  if (candidates.size() > static_cast<std::size_t>(params_.candidates)) {
    candidates.resize(static_cast<std::size_t>(params_.candidates));
  }
  return candidates;
}

/// @returns whether any was found that is to be believed.
bool GraphMapping::close_loops(std::size_t newer) {
  bool is_any = false;
  const double restless = restlessness();
  for (const LoopCandidate& candidate : candidates_for(newer)) {
    const Pose2 expected = inverse(middle_of(candidate.submap)) * middle_of(newer);
    auto found = closer_.close(submaps_[candidate.submap], submaps_[newer], expected, candidate.covariance, restless);
    if (!found) continue;
    found->from = candidate.submap;
    found->to = newer;
    is_any = believe(*found) || is_any;
  }
  return is_any;
}

/// A loop far from where it was expected may be a place that looks alike: it waits until another one says the same.
bool GraphMapping::believe(const LoopClosure& closure) {
  constexpr double kExpected = 1.0;  // [m]
  if (closure.surprise <= kExpected) {
    accept(closure);
    return true;
  }
  bool is_borne_out = false;
  for (auto other = waiting_.begin(); other != waiting_.end();) {
    if (agree(closure, *other)) {
      accept(*other);
      other = waiting_.erase(other);
      is_borne_out = true;
    } else {
      ++other;
    }
  }
  if (is_borne_out) {
    accept(closure);
  } else {
    waiting_.push_back(closure);
  }
  return is_borne_out;
}

void GraphMapping::accept(const LoopClosure& closure) {
  closed_[{closure.from, closure.to}] = true;
  graph_.add(closure.constraint);
  ++loops_;
}

/// Both loops join the same two pieces of the way, and say the same of how they lie to each other.
bool GraphMapping::agree(const LoopClosure& a, const LoopClosure& b) const {
  constexpr std::size_t kNear = 4;  // submaps
  constexpr double kApart = 0.7;    // [m]
  constexpr double kTurned = 0.2;   // [rad]
  const auto gap = [](std::size_t i, std::size_t k) { return i > k ? i - k : k - i; };
  if (gap(a.from, b.from) > kNear || gap(a.to, b.to) > kNear) return false;
  if (a.to == b.to && a.from == b.from) return false;
  const Pose2 from_from_from = inverse(middle_of(a.from)) * middle_of(b.from);
  const Pose2 to_from_to = inverse(middle_of(b.to)) * middle_of(a.to);
  const Pose2 by_other = from_from_from * b.constraint.from_from_to * to_from_to;
  const Pose2 difference = inverse(a.constraint.from_from_to) * by_other;
  return norm(difference.position()) < kApart && std::abs(difference.theta.radians()) < kTurned;
}

/// For each scan the nearest scans of other pieces of the way.
std::map<std::size_t, std::vector<std::size_t>> GraphMapping::pairs_by_reference() const {
  std::map<std::size_t, std::vector<std::size_t>> sweeps_of;
  const std::vector<Pose2>& poses = graph_.poses();
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> nearest;
    for (const Submap& submap : submaps_) {
      if (submap.last() + static_cast<std::size_t>(params_.chain.scans) >= i) break;
      std::pair<double, std::size_t> best{params_.fine_reach, 0};
      for (std::size_t k = submap.first(); k <= submap.last(); ++k) {
        best = std::min(best, {distance(poses[i].position(), poses[k].position()), k});
      }
      if (best.first < params_.fine_reach) nearest.push_back(best);
    }
    std::sort(nearest.begin(), nearest.end());
    if (nearest.size() > static_cast<std::size_t>(params_.fine_pairs)) {
      nearest.resize(static_cast<std::size_t>(params_.fine_pairs));
    }
    for (const auto& [apart, k] : nearest) sweeps_of[k].push_back(i);
  }
  return sweeps_of;
}

void GraphMapping::refine(int round) {
  constexpr double kLeastOverlap = 0.35;
  std::vector<PoseConstraint> kept;
  for (const PoseConstraint& constraint : graph_.constraints()) {
    if (!constraint.is_loop || (round == 0 && params_.fine_rounds == 1)) kept.push_back(constraint);
  }
  const std::vector<Pose2> poses = graph_.poses();
  for (const auto& [reference, sweeps] : pairs_by_reference()) {
    const auto fewest = static_cast<std::size_t>(params_.chain.fewest_points);
    if (scans_[reference].points.size() < fewest) continue;
    const SurfaceIndex index{scans_[reference].points};
    for (const std::size_t i : sweeps) {
      if (scans_[i].points.size() < fewest) continue;
      const auto match = line_match(index, scans_[i].points, inverse(poses[reference]) * poses[i], params_.lines);
      if (!match || match->overlap < kLeastOverlap) continue;
      kept.push_back({reference, i, match->reference_from_sweep, match->information, true});
    }
  }
  graph_.clear_constraints();
  revisits_.clear();
  for (const PoseConstraint& constraint : kept) {
    graph_.add(constraint);
    if (constraint.is_loop) revisits_.push_back(constraint);
  }
  optimise();
}

/// [m] between how two scans lie to each other in the map and how they match.
double GraphMapping::missed_by(const PoseConstraint& match) const {
  const Pose2 in_map = inverse(graph_.poses()[match.from]) * graph_.poses()[match.to];
  return norm((inverse(match.from_from_to) * in_map).position());
}

}  // namespace docent::mapping
