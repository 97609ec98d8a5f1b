#include "docent/mapping/graph_mapping/map_judgement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "docent/mapping/pose_graph/marginal_covariance.h"

namespace docent::mapping {
namespace {

constexpr std::size_t kRecent = 3;  ///< submaps that the chain itself has matched to each other

void compare_pieces(const PoseGraph& graph, const std::deque<Submap>& submaps, const MapJudgementParams& params,
                    MapJudgement& judgement) {
  double sum = 0.0;
  std::size_t in_conflict = 0;
  for (std::size_t newer = kRecent; newer < submaps.size(); ++newer) {
    for (std::size_t older = 0; older + kRecent <= newer; ++older) {
      const Pose2& a = graph.poses()[submaps[older].middle()];
      const Pose2& b = graph.poses()[submaps[newer].middle()];
      if (distance(a.position(), b.position()) > params.near) continue;
      const double share = share_in_conflict(submaps[older], submaps[newer], inverse(a) * b);
      sum += share;
      in_conflict += share > params.conflict + judgement.restless ? 1U : 0U;
      ++judgement.pairs;
    }
  }
  if (judgement.pairs == 0) return;
  judgement.mean_conflict = sum / static_cast<double>(judgement.pairs);
  judgement.in_conflict = static_cast<double>(in_conflict) / static_cast<double>(judgement.pairs);
}

/// Mean expected error of places 1, 5, 20, 60 and 150 m of way apart.
double expected_error(const PoseGraph& graph) {
  const MarginalCovariances covariances{graph};
  constexpr std::array kApart{1.0, 5.0, 20.0, 60.0, 150.0};
  constexpr std::size_t kSamples = 16;
  std::vector<double> way(graph.poses().size(), 0.0);
  for (std::size_t i = 1; i < way.size(); ++i) {
    way[i] = way[i - 1] + distance(graph.poses()[i - 1].position(), graph.poses()[i].position());
  }
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t sample = 0; sample < kSamples; ++sample) {
    const std::size_t from = sample * way.size() / kSamples;
    for (const double apart : kApart) {
      const auto to = std::lower_bound(way.begin(), way.end(), way[from] + apart);
      if (to == way.end()) continue;
      const Eigen::Matrix3d covariance = covariances.between(from, static_cast<std::size_t>(to - way.begin()));
      sum += std::sqrt(covariance(0, 0) + covariance(1, 1));
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

Result<void> MapJudgementParams::validate() const {
  if (!(near > 0.0)) return fail("near must be > 0 m");
  if (!(conflict >= 0.0 && conflict <= 1.0)) return fail("conflict must be 0..1");
  if (!(most_in_conflict >= 0.0 && most_in_conflict <= 1.0)) return fail("most_in_conflict must be 0..1");
  if (!(most_error >= 0.0)) return fail("most_error must be >= 0 m");
  return {};
}

MapJudgement judge(const PoseGraph& graph, const std::deque<Submap>& submaps, double restless, double odometry_scale,
                   const MapJudgementParams& params) {
  MapJudgement judgement;
  if (graph.poses().empty()) {
    judgement.reason = "there is no scan";
    return judgement;
  }
  judgement.restless = restless;
  judgement.odometry_scale = odometry_scale;
  compare_pieces(graph, submaps, params, judgement);
  judgement.expected_error = expected_error(graph.with_odometry(odometry_scale));
  char text[160];
  if (judgement.in_conflict > params.most_in_conflict) {
    std::snprintf(text, sizeof text, "of the pieces of the way that lie near each other, %.0f %% contradict each other",
                  100.0 * judgement.in_conflict);
    judgement.reason = text;
  } else if (!(judgement.expected_error <= params.most_error)) {  // nor one that is no number
    std::snprintf(text, sizeof text, "too few places were seen twice: distances may be wrong by %.1f m on average",
                  judgement.expected_error);
    judgement.reason = text;
  }
  judgement.is_trusted = judgement.reason.empty();
  return judgement;
}

}  // namespace docent::mapping
