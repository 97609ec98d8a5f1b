#include "docent/localization/learning/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>

namespace docent::localization {

namespace {

// What a labelling may lose against the one before, as a share of the sweeps: that much is chance.
constexpr double kFewerSure = 0.15;
constexpr double kMoreContradicted = 0.02;

using Labellings = std::vector<Labelling>;

std::size_t sure_of(const Labellings& labellings) {
  std::size_t sure = 0;
  for (const Labelling& labelling : labellings) sure += labelling.sure;
  return sure;
}

std::size_t contradicted_of(const Labellings& labellings) {
  std::size_t contradicted = 0;
  for (const Labelling& labelling : labellings) contradicted += labelling.contradicted;
  return contradicted;
}

/// `share` of the way from one model to another; scales by their logarithms.
sensor_models::ProximityModelParams between(const sensor_models::ProximityModelParams& from,
                                            const sensor_models::ProximityModelParams& to, double share) {
  const auto linear = [share](double a, double b) { return a + share * (b - a); };
  const auto scaled = [share](double a, double b) { return a * std::pow(b / a, share); };
  sensor_models::ProximityModelParams result = to;
  result.sigma = scaled(from.sigma, to.sigma);
  result.sigma_per_metre = linear(from.sigma_per_metre, to.sigma_per_metre);
  result.short_per_metre = scaled(from.short_per_metre, to.short_per_metre);
  result.near_factor = scaled(from.near_factor, to.near_factor);
  const double total = from.total_weight();
  result.weight_hit = linear(from.weight_hit / total, to.weight_hit);
  result.weight_near = linear(from.weight_near / total, to.weight_near);
  result.weight_short = linear(from.weight_short / total, to.weight_short);
  result.weight_no_return = linear(from.weight_no_return / total, to.weight_no_return);
  result.weight_random = linear(from.weight_random / total, to.weight_random);
  return result;
}

class Bootstrap {
 public:
  Bootstrap(const std::vector<LearningRecording>& recordings, const OccupancyGrid& map, const LocalizerParams& start,
            const BootstrapParams& params, const std::function<void(const std::string&)>& progress)
      : recordings_{recordings}, map_{map}, params_{params}, progress_{progress}, localizer_params_{start} {
    for (const LearningRecording& recording : recordings_) pieces_.push_back(pieces_of(recording.lasers));
    // Cells blur at least as much as their middle is off.
    if (params_.expected_at == ExpectedAt::cell)
      params_.sensor_fit.least_sigma =
          std::max(params_.sensor_fit.least_sigma, start.states.cell_size / std::sqrt(12.0));
  }

  Result<LearnedModels> learn() {
    Labellings labels = first_labels();
    if (sure_of(labels) == 0) return fail("the robot is nowhere sure of its place");
    const sensor_models::ProximityModelParams start = params_.sonar ? *params_.sonar : localizer_params_.sensor;
    CountedReadings readings = count(labels);
    const CountedReadings first_readings = readings;
    LearnedModels result{start, {}, {}, 0.0, 0.0, 0, localizer_params_.states.wall_depth, {}, {}, {}, readings.fitted};
    for (int n = 0; n < params_.most_iterations; ++n) {
      const auto fit = sensor_models::fit_proximity_model(readings.fitted, result.sensor, params_.sensor_fit);
      if (!fit) return tl::unexpected<Error>(fit.error());
      char line[160];
      std::snprintf(line, sizeof line, "fit to %llu readings: ln P %.4f -> %.4f nat",
                    static_cast<unsigned long long>(fit->readings), fit->before, fit->after);
      progress_(line);
      const bool settled = n > 0 && fit->after - fit->before < params_.settled;
      const auto step = settled ? std::nullopt : go(result.sensor, fit->params, labels);
      if (!step) {
        if (!settled) progress_("no step to the new fit makes better labels: the last model stands");
        break;
      }
      const double share = step.value_or(0.0);  // there is one; not every compiler sees that
      result.sensor = between(result.sensor, fit->params, share);
      result.iterations.push_back({sweeps(), sure_of(labels), share, fit->readings, fit->before,
                                   sensor_models::mean_log_likelihood(readings.fitted, result.sensor),
                                   compare(readings.held_out, start, result.sensor)});
      if (params_.sonar) break;
      readings = count(labels);
    }
    result.on_first_labels = compare(first_readings.held_out, start, result.sensor);
    result.on_last_labels = compare(readings.held_out, start, result.sensor);
    result.readings = readings.fitted;
    for (const sensor_models::ReadingCounts& piece : readings.held_out) result.readings.add(piece);
    learn_motion(labels, result);
    return result;
  }

 private:
  [[nodiscard]] std::size_t sweeps() const {
    std::size_t sum = 0;
    for (const LearningRecording& recording : recordings_) sum += recording.lasers.size();
    return sum;
  }

  /// Labels of all recordings with the localizer as it is.
  Labellings label_all(const std::string& what) {
    Labellings result;
    for (std::size_t i = 0; i < recordings_.size(); ++i) {
      result.push_back(
          label(recordings_[i].lasers, *localizer_, params_.labels, [&](std::size_t done, std::size_t all) {
            progress_(what + ", recording " + std::to_string(i + 1) + ": " + std::to_string(done) + " of " +
                      std::to_string(all) + " sweeps");
          }));
      refine(recordings_[i].lasers, localizer_->caster(), localizer_params_.sensor.max_range, params_.refinement,
             result.back().labels);
    }
    return result;
  }

  /// Labels anew with the model a step from `from` to `to`, shorter ones when they get worse. The step, and `labels`
  /// become the new ones; nullopt when none is good. A sonar makes no labels: the whole step.
  std::optional<double> go(const sensor_models::ProximityModelParams& from,
                           const sensor_models::ProximityModelParams& to, Labellings& labels) {
    if (params_.sonar) return 1.0;
    const auto all = static_cast<double>(sweeps());
    const double least_sure = static_cast<double>(sure_of(labels)) - kFewerSure * all;
    const double most_contradicted = static_cast<double>(contradicted_of(labels)) + kMoreContradicted * all;
    for (const double share : {1.0, 0.5, 0.25}) {
      localizer_params_.sensor = between(from, to, share);
      std::optional<Labellings> first;
      bool good = true;
      for (int proof = 0; good && proof < params_.proofs; ++proof) {
        make_localizer(static_cast<std::uint64_t>(proof));
        Labellings again = label_all("labels of the fit");
        char line[120];
        std::snprintf(line, sizeof line, "%.0f %% of the way to the fit: %zu sweeps sure, %zu contradicted",
                      100.0 * share, sure_of(again), contradicted_of(again));
        progress_(line);
        good = static_cast<double>(sure_of(again)) >= least_sure &&
               static_cast<double>(contradicted_of(again)) <= most_contradicted;
        if (!first) first = std::move(again);
      }
      if (!good) continue;
      labels = std::move(*first);
      return share;
    }
    return std::nullopt;
  }

  /// With the model at the start, and the wall depth that suits it best.
  Labellings first_labels() {
    Labellings best;
    double best_fit = -std::numeric_limits<double>::infinity();
    double best_depth = params_.wall_depths.front();
    for (const double depth : params_.wall_depths) {
      localizer_params_.states.wall_depth = depth;
      make_localizer();
      Labellings labels = label_all("iteration 1");
      double fit = 0.0;
      for (const Labelling& labelling : labels) fit += labelling.fit / static_cast<double>(labels.size());
      if (params_.wall_depths.size() > 1) {
        char line[80];
        std::snprintf(line, sizeof line, "walls %.1f m deep: mean ln P of a beam %.3f", depth, fit);
        progress_(line);
      }
      if (!best.empty() && !(fit > best_fit)) continue;
      best = std::move(labels);
      best_fit = fit;
      best_depth = depth;
    }
    if (localizer_params_.states.wall_depth != best_depth) {
      localizer_params_.states.wall_depth = best_depth;
      make_localizer();
    }
    return best;
  }

  void make_localizer(std::uint64_t proof = 0) {
    localizer_ = std::make_unique<MarkovLocalizer>(map_, localizer_params_, params_.cache, params_.seed + proof);
    if (params_.sonar) {
      const sensor_models::ProximityModel bins{*params_.sonar};
      sonar_table_ = std::make_unique<RangeTable>(
          RangeTable::cones(localizer_->table(), sensor_models::ProximityModel{localizer_params_.sensor},
                            localizer_->space(), bins, params_.sonar_cone * std::numbers::pi / 180.0));
    }
  }

  [[nodiscard]] CountedReadings count(const Labellings& labels) const {
    const double max_range = params_.sonar ? params_.sonar->max_range : localizer_params_.sensor.max_range;
    const RangeTable& table = params_.sonar ? *sonar_table_ : localizer_->table();
    const Expectation expectation{localizer_->space(), table, localizer_->caster(), max_range, params_.expected_at};
    CountedReadings all{sensor_models::ReadingCounts{max_range}, {}, 0};
    for (std::size_t i = 0; i < recordings_.size(); ++i) {
      const auto& lasers = recordings_[i].lasers;
      CountedReadings some = count_readings(params_.sonar ? recordings_[i].sonars : lasers, lasers, labels[i].labels,
                                            pieces_[i], expectation, params_.readings);
      all.fitted.add(some.fitted);
      all.sweeps += some.sweeps;
      std::move(some.held_out.begin(), some.held_out.end(), std::back_inserter(all.held_out));
    }
    return all;
  }

  void learn_motion(const Labellings& labels, LearnedModels& result) const {
    std::vector<motion_models::MotionWindow> fitted;
    std::vector<motion_models::MotionWindow> held_out;
    for (std::size_t i = 0; i < recordings_.size(); ++i) {
      std::vector<motion_models::LabelledOdometry> moments;
      for (std::size_t j = 0; j < labels[i].labels.size(); ++j) {
        const PoseLabel& at = labels[i].labels[j];
        moments.push_back({recordings_[i].lasers[j].odom_from_base, at.map_from_base, at.sure});
      }
      for (const motion_models::PlacedWindow& placed : motion_models::motion_windows(moments)) {
        const bool first = Pieces::is_held_out(pieces_[i].piece[placed.first]);
        const bool last = Pieces::is_held_out(pieces_[i].piece[placed.last]);
        if (first && last) held_out.push_back(placed.window);
        if (!first && !last) fitted.push_back(placed.window);
      }
    }
    motion_models::LabelledMotionNoise start;
    start.motion = localizer_params_.motion;
    auto fit = motion_models::fit_odometry_model(fitted, start, params_.motion_fit);
    if (!fit) {
      result.motion_fault = fit.error().message;
      return;
    }
    motion_models::OdometryFitParams labels_only = params_.motion_fit;
    labels_only.fixed_motion = true;
    const auto plain = motion_models::fit_odometry_model(fitted, start, labels_only);
    result.motion_held_windows = held_out.size();
    result.motion_held_before = motion_models::mean_log_likelihood(held_out, plain ? plain->noise : start);
    result.motion_held_after = motion_models::mean_log_likelihood(held_out, fit->noise);
    result.motion = std::move(*fit);
  }

  const std::vector<LearningRecording>& recordings_;
  const OccupancyGrid& map_;
  BootstrapParams params_;
  const std::function<void(const std::string&)>& progress_;
  LocalizerParams localizer_params_;
  std::vector<Pieces> pieces_;
  std::unique_ptr<MarkovLocalizer> localizer_;
  std::unique_ptr<RangeTable> sonar_table_;
};

}  // namespace

HeldOut compare(const std::vector<sensor_models::ReadingCounts>& pieces,
                const sensor_models::ProximityModelParams& before, const sensor_models::ProximityModelParams& after) {
  HeldOut result;
  result.pieces = pieces.size();
  std::vector<double> gains;
  std::vector<double> sizes;
  for (const sensor_models::ReadingCounts& piece : pieces) {
    const auto readings = static_cast<double>(piece.total());
    const double old_value = sensor_models::mean_log_likelihood(piece, before);
    const double new_value = sensor_models::mean_log_likelihood(piece, after);
    result.readings += piece.total();
    result.before += readings * old_value;
    result.after += readings * new_value;
    gains.push_back(new_value - old_value);
    sizes.push_back(readings);
  }
  if (result.readings == 0) return result;
  const auto all = static_cast<double>(result.readings);
  result.before /= all;
  result.after /= all;
  double scatter = 0.0;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const double off = sizes[i] / all * (gains[i] - (result.after - result.before));
    scatter += off * off;
  }
  const auto n = static_cast<double>(gains.size());
  result.uncertainty = n > 1.0 ? std::sqrt(scatter * n / (n - 1.0)) : std::numeric_limits<double>::infinity();
  return result;
}

Result<LearnedModels> bootstrap(const std::vector<LearningRecording>& recordings, const OccupancyGrid& map,
                                const LocalizerParams& start, const BootstrapParams& params,
                                const std::function<void(const std::string&)>& progress) {
  return Bootstrap{recordings, map, start, params, progress}.learn();
}

}  // namespace docent::localization
