#include "docent/mapping/expectation_maximization/em_mapper.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace docent::mapping {
namespace {

/// Where a place was on the coarser level: it is looked for near there only.
struct PoseWindow {
  Pose2 at;
  double reach = 0.0;  ///< [m]
  double turn = 0.0;   ///< [rad]
  [[nodiscard]] bool holds(const Pose2& pose) const {
    return distance(pose.position(), at.position()) <= reach && std::abs((pose.theta - at.theta).radians()) <= turn;
  }
};

class ExpectationMaximization {
 public:
  ExpectationMaximization(std::span<const SeenPlace> places, const EmMapperParams& params, const EmLevel& level,
                          const std::vector<PoseWindow>& windows)
      : places_{places}, params_{params}, cells_{level.cells}, independent_{level.independent}, windows_{windows} {}

  /// Posterior of each place's pose given all data and the map; without one the robot is blind. @returns ln p(d | m).
  double expect(const std::optional<EvidenceMap>& map) {
    const double log_likelihood = run_forwards(map);
    run_backwards(map);
    return log_likelihood;
  }
  [[nodiscard]] EvidenceMap maximise() const { return EvidenceMap{places_, posteriors_}; }
  [[nodiscard]] std::span<const PoseBox> posteriors() const { return posteriors_; }
  [[nodiscard]] std::vector<Pose2> modes() const {
    std::vector<Pose2> modes;
    for (const PoseBox& posterior : posteriors_) modes.push_back(posterior.mode());
    return modes;
  }

 private:
  [[nodiscard]] Motion motion_to(std::size_t t) const {
    const SeenPlace& place = places_[t];
    return {place.before_from_here, params_.way_per_metre * place.way + params_.way_per_radian * place.turn + 1e-4,
            params_.turn_per_metre * place.way + params_.turn_per_radian * place.turn + 1e-5};
  }

  /// Times P(o_t | s, m). @returns the logarithm of what all was divided by.
  double weigh(PoseBox& belief, std::size_t t, const std::optional<EvidenceMap>& map) const {
    std::vector<double> logs(belief.size(), 0.0);
    double best = -1e300;
    std::map<double, EvidenceMap::TurnedPlace> turned;
    for (std::size_t i = 0; i < belief.size(); ++i) {
      if (belief.value(i) == 0.0F) continue;
      const Pose2 pose = belief.pose(i);
      if (!windows_.empty() && !windows_[t].holds(pose)) {
        belief.set_value(i, 0.0F);
        continue;
      }
      if (map) {
        auto [entry, is_new] = turned.try_emplace(pose.theta.radians());
        if (is_new) entry->second = EvidenceMap::turned(places_[t], pose.theta, cells_.cell);
        const CellIndex at{static_cast<int>(std::lround(pose.x / cells_.cell)),
                           static_cast<int>(std::lround(pose.y / cells_.cell))};
        logs[i] = map->log_likelihood(entry->second, at, independent_);
      }
      best = std::max(best, logs[i]);
    }
    for (std::size_t i = 0; i < belief.size(); ++i) {
      if (belief.value(i) > 0.0F) belief.set_value(i, belief.value(i) * static_cast<float>(std::exp(logs[i] - best)));
    }
    return best;
  }

  double run_forwards(const std::optional<EvidenceMap>& map) {
    forwards_.clear();
    double log_likelihood = 0.0;
    PoseBox belief{cells_, {}};  // "the initial pose is, somewhat arbitrarily, set to (0, 0, 0)"
    for (std::size_t t = 0; t < places_.size(); ++t) {
      PoseBox next = t == 0 ? belief : belief.moved(motion_to(t));
      const PoseBox predicted = next;
      const double scale = weigh(next, t, map);
      double sum = next.normalise();
      if (sum <= 0.0) {  // the window holds none of it: what odometry says instead
        next = predicted;
        sum = next.normalise();
      }
      next.crop(static_cast<float>(params_.least));
      next.normalise();
      log_likelihood += scale + std::log(sum);
      forwards_.push_back(next);
      belief = std::move(next);
    }
    return log_likelihood;
  }

  void run_backwards(const std::optional<EvidenceMap>& map) {
    posteriors_ = forwards_;
    PoseBox message = forwards_.back();
    for (std::size_t i = 0; i < message.size(); ++i) message.set_value(i, message.value(i) > 0.0F ? 1.0F : 0.0F);
    for (std::size_t t = places_.size() - 1; t > 0; --t) {
      weigh(message, t, map);
      message = message.moved_back(motion_to(t));
      message.normalise();
      PoseBox within = forwards_[t - 1];
      for (std::size_t i = 0; i < within.size(); ++i) {
        if (within.value(i) > 0.0F) within.set_value(i, static_cast<float>(message.value_at(within.pose(i))));
      }
      PoseBox& posterior = posteriors_[t - 1];
      PoseBox product = posterior;
      product.multiply(within);
      if (product.normalise() > 0.0) {
        product.crop(static_cast<float>(params_.least));
        product.normalise();
        posterior = std::move(product);
        message = std::move(within);
      } else {  // both directions exclude each other: begin anew from the forward belief
        message = forwards_[t - 1];
        for (std::size_t i = 0; i < message.size(); ++i) message.set_value(i, message.value(i) > 0.0F ? 1.0F : 0.0F);
      }
    }
  }

  std::span<const SeenPlace> places_;
  const EmMapperParams& params_;
  PoseCells cells_;
  double independent_;
  const std::vector<PoseWindow>& windows_;
  std::vector<PoseBox> forwards_;
  std::vector<PoseBox> posteriors_;
};

double mean_apart(std::span<const Pose2> a, std::span<const Pose2> b) {
  if (a.size() != b.size() || a.empty()) return 1e9;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += distance(a[i].position(), b[i].position());
  return sum / static_cast<double>(a.size());
}

std::vector<PoseWindow> windows_about(std::span<const PoseBox> posteriors, double cells) {
  std::vector<PoseWindow> windows;
  for (const PoseBox& posterior : posteriors) {
    const PoseBox::Spread spread = posterior.spread();
    windows.push_back({posterior.mode(), cells * posterior.cells().cell + 2.0 * spread.metres,
                       cells * posterior.cells().step() + 2.0 * spread.radians});
  }
  return windows;
}

/// A map of the same beliefs on another grid: each belief by its mode.
EvidenceMap map_of_modes(std::span<const SeenPlace> places, std::span<const Pose2> modes, const PoseCells& cells) {
  std::vector<PoseBox> beliefs;
  for (const Pose2& mode : modes) beliefs.emplace_back(cells, mode);
  return EvidenceMap{places, beliefs};
}

}  // namespace

EmMap map_by_em(std::span<const MappingScan> scans, const EmMapperParams& params,
                const std::function<bool(const EmProgress&)>& progress) {
  EmMap result;
  std::vector<PoseWindow> windows;
  bool is_wanted = true;
  for (std::size_t level = 0; level < params.levels.size() && is_wanted; ++level) {
    const PoseCells& cells = params.levels[level].cells;
    const std::vector<SeenPlace> places = places_of(scans, params.places, cells.cell);
    if (places.empty()) return result;
    ExpectationMaximization em{places, params, params.levels[level], windows};
    std::optional<EvidenceMap> map;
    if (level > 0) map = map_of_modes(places, result.map_from_base, cells);
    for (int iteration = 0; iteration < params.levels[level].iterations && is_wanted; ++iteration) {
      result.log_likelihood = em.expect(map);
      map = em.maximise();
      const std::vector<Pose2> modes = em.modes();
      const double moved = mean_apart(modes, result.map_from_base);
      result.map_from_base = modes;
      if (progress) {
        is_wanted = progress({static_cast<int>(level), iteration, result.log_likelihood, moved, *map, places, modes});
      }
      if (moved < params.still * cells.cell) break;
    }
    result.scans.clear();
    for (const SeenPlace& place : places) result.scans.push_back(place.scan);
    windows = windows_about(em.posteriors(), params.window);
  }
  return result;
}

}  // namespace docent::mapping
