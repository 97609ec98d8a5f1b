#include "docent/localization/learning/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

namespace docent {

namespace {

constexpr double kFewerSure = 0.8;  // of the sure labels must remain, or the last model was better

using Labellings = std::vector<Labelling>;

std::size_t sure_of(const Labellings& labellings) {
  std::size_t sure = 0;
  for (const Labelling& labelling : labellings) sure += labelling.sure;
  return sure;
}

class Bootstrap {
 public:
  Bootstrap(const std::vector<LearningRecording>& recordings, const OccupancyGrid& map,
            const MarkovLocalizerParams& start, const BootstrapParams& params,
            const std::function<void(const std::string&)>& progress)
      : recordings_{recordings}, map_{map}, params_{params}, progress_{progress}, localizer_params_{start} {
    for (const LearningRecording& recording : recordings_) pieces_.push_back(pieces_of(recording.lasers));
  }

  Result<LearnedModels> learn() {
    Labellings labels = first_labels();
    if (sure_of(labels) == 0) return fail("the robot is nowhere sure of its place");
    const ProximityModelParams start = params_.sonar ? *params_.sonar : localizer_params_.sensor;
    CountedReadings readings = count(labels);
    const CountedReadings first_readings = readings;
    LearnedModels result{start, {}, {}, 0.0, 0.0, 0, localizer_params_.states.wall_depth, {}, {}, readings.fitted};
    for (int n = 0; n < params_.most_iterations; ++n) {
      if (n > 0) {
        Labellings again = label_with(result.sensor, "iteration " + std::to_string(n + 1));
        if (static_cast<double>(sure_of(again)) < kFewerSure * static_cast<double>(sure_of(labels))) break;
        labels = std::move(again);
        readings = count(labels);
      }
      const auto fit = fit_proximity_model(readings.fitted, result.sensor, params_.sensor_fit);
      if (!fit) return tl::unexpected<Error>(fit.error());
      result.sensor = fit->params;
      result.iterations.push_back({sweeps(), sure_of(labels), fit->readings, fit->before, fit->after,
                                   compare(readings.held_out, start, fit->params)});
      say(result.iterations);
      if (params_.sonar) break;
      if (n > 0 && std::abs(fit->after - result.iterations[result.iterations.size() - 2].after) < params_.settled)
        break;
    }
    result.on_first_labels = compare(first_readings.held_out, start, result.sensor);
    result.readings = readings.fitted;
    for (const ReadingCounts& piece : readings.held_out) result.readings.add(piece);
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
    }
    return result;
  }

  Labellings label_with(const ProximityModelParams& sensor, const std::string& what) {
    if (!params_.sonar) localizer_params_.sensor = sensor;
    make_localizer();
    return label_all(what);
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

  void make_localizer() {
    localizer_ = std::make_unique<MarkovLocalizer>(map_, localizer_params_, params_.cache, params_.seed);
    if (params_.sonar) {
      const ProximityModel bins{*params_.sonar};
      sonar_table_ = std::make_unique<RangeTable>(RangeTable::build(localizer_->space(), localizer_->caster(), bins));
    }
  }

  [[nodiscard]] CountedReadings count(const Labellings& labels) const {
    const double max_range = params_.sonar ? params_.sonar->max_range : localizer_params_.sensor.max_range;
    const RangeTable& table = params_.sonar ? *sonar_table_ : localizer_->table();
    const Expectation expectation{localizer_->space(), table, localizer_->caster(), max_range, params_.expected_at};
    CountedReadings all{ReadingCounts{max_range}, {}, 0};
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
    std::vector<MotionWindow> fitted;
    std::vector<MotionWindow> held_out;
    for (std::size_t i = 0; i < recordings_.size(); ++i) {
      std::vector<LabelledOdometry> moments;
      for (std::size_t j = 0; j < labels[i].labels.size(); ++j) {
        const PoseLabel& at = labels[i].labels[j];
        moments.push_back({recordings_[i].lasers[j].odom_from_base, at.map_from_base, at.sure});
      }
      for (PlacedWindow& placed : motion_windows(moments)) {
        const bool first = Pieces::is_held_out(pieces_[i].piece[placed.first]);
        const bool last = Pieces::is_held_out(pieces_[i].piece[placed.last]);
        if (first && last) held_out.push_back(std::move(placed.window));
        if (!first && !last) fitted.push_back(std::move(placed.window));
      }
    }
    LabelledMotionNoise start;
    start.motion = localizer_params_.motion;
    auto fit = fit_odometry_model(fitted, start, params_.motion_fit);
    if (!fit) {
      result.motion_fault = fit.error().message;
      return;
    }
    OdometryFitParams labels_only = params_.motion_fit;
    labels_only.fixed_motion = true;
    const auto plain = fit_odometry_model(fitted, start, labels_only);
    result.motion_held_windows = held_out.size();
    result.motion_held_before = mean_log_likelihood(held_out, plain ? plain->noise : start);
    result.motion_held_after = mean_log_likelihood(held_out, fit->noise);
    result.motion = std::move(*fit);
  }

  void say(const std::vector<BootstrapIteration>& iterations) const {
    const BootstrapIteration& last = iterations.back();
    char line[200];
    std::snprintf(line, sizeof line, "iteration %zu: %zu of %zu sweeps sure, %llu readings, ln P %.4f -> %.4f nat",
                  iterations.size(), last.sure, last.sweeps, static_cast<unsigned long long>(last.readings),
                  last.before, last.after);
    progress_(line);
  }

  const std::vector<LearningRecording>& recordings_;
  const OccupancyGrid& map_;
  BootstrapParams params_;
  const std::function<void(const std::string&)>& progress_;
  MarkovLocalizerParams localizer_params_;
  std::vector<Pieces> pieces_;
  std::unique_ptr<MarkovLocalizer> localizer_;
  std::unique_ptr<RangeTable> sonar_table_;
};

}  // namespace

HeldOut compare(const std::vector<ReadingCounts>& pieces, const ProximityModelParams& before,
                const ProximityModelParams& after) {
  HeldOut result;
  result.pieces = pieces.size();
  std::vector<double> gains;
  std::vector<double> sizes;
  for (const ReadingCounts& piece : pieces) {
    const auto readings = static_cast<double>(piece.total());
    const double old_value = mean_log_likelihood(piece, before);
    const double new_value = mean_log_likelihood(piece, after);
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
                                const MarkovLocalizerParams& start, const BootstrapParams& params,
                                const std::function<void(const std::string&)>& progress) {
  return Bootstrap{recordings, map, start, params, progress}.learn();
}

}  // namespace docent
