#include "docent/apps/laboratory/learn/learn_report.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

namespace docent::apps::learn_command {

namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  char buffer[400];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(buffer, sizeof buffer, pattern, arguments);
  va_end(arguments);
  return buffer;
}

/// The fields of a parameter struct, in its own order.
struct Fields {
  std::vector<std::pair<std::string, double>> fields;
  void operator()(const char* key, const double& value) { fields.emplace_back(key, value); }
};
template <class Params>
std::vector<std::pair<std::string, double>> fields_of(Params params) {
  Fields fields;
  params.visit(fields);
  return fields.fields;
}

/// Weights that sum to 1, so that two models can be compared.
sensor_models::ProximityModelParams normalised(sensor_models::ProximityModelParams params) {
  const double total = params.total_weight();
  for (double* weight :
       {&params.weight_hit, &params.weight_near, &params.weight_short, &params.weight_no_return, &params.weight_random})
    *weight /= total;
  return params;
}

template <class Params>
std::string parameter_rows(const Params& before, const Params& after) {
  std::string text;
  const auto old_fields = fields_of(before);
  const auto new_fields = fields_of(after);
  for (std::size_t i = 0; i < old_fields.size(); ++i)
    text += format("  %-24s %12.5g %12.5g\n", old_fields[i].first.c_str(), old_fields[i].second, new_fields[i].second);
  return text;
}

template <class Params>
std::string yaml_fields(const Params& params, const char* indent) {
  std::string text;
  for (const auto& [key, value] : fields_of(params)) text += indent + key + format(": %.5g\n", value);
  return text;
}

template <class Params>
std::string inline_fields(const Params& params) {
  std::string text;
  for (const auto& [key, value] : fields_of(params)) text += (text.empty() ? "" : ", ") + key + format(": %.5g", value);
  return "{" + text + "}";
}

std::string held_out_row(const char* what, const localization::HeldOut& held_out) {
  return format("  %-34s %9.4f %9.4f   %+.4f +- %.4f nat a reading (%llu readings, %zu pieces)\n", what,
                held_out.before, held_out.after, held_out.after - held_out.before, held_out.uncertainty,
                static_cast<unsigned long long>(held_out.readings), held_out.pieces);
}

std::string motion_table(const LearningOutcome& outcome) {
  const localization::LearnedModels& learned = outcome.learned;
  if (!learned.motion) return "motion model: not learned, " + learned.motion_fault + "\n";
  const motion_models::OdometryFit& fit = *learned.motion;
  const double degree = std::numbers::pi / 180.0;
  std::string text = format("%-26s %12s %12s\n", "motion model", "before", "learned");
  text += parameter_rows(outcome.motion_before, fit.noise.motion);
  text += format("  from %zu windows of 0.5 to 5 m; the labels themselves err %.1f cm, %.2f degrees\n", fit.windows,
                 100.0 * std::sqrt(fit.noise.label_position), std::sqrt(fit.noise.label_heading) / degree);
  text += format("  of it systematic: %+.2f degrees a metre to the left, %+.2f %% of length\n", fit.drift_turn / degree,
                 100.0 * fit.drift_length);
  text += format("  held out                           %9.4f %9.4f   %+.4f nat a window (%zu windows)\n",
                 learned.motion_held_before, learned.motion_held_after,
                 learned.motion_held_after - learned.motion_held_before, learned.motion_held_windows);
  return text;
}

}  // namespace

std::string learning_table(const LearningOutcome& outcome) {
  const localization::LearnedModels& learned = outcome.learned;
  std::string text = "iteration  sure sweeps  step  readings   ln P before   fitted   held out: start   fitted\n";
  for (std::size_t i = 0; i < learned.iterations.size(); ++i) {
    const localization::BootstrapIteration& at = learned.iterations[i];
    text += format("%9zu  %5zu/%-6zu %4.2f  %8llu   %11.4f %8.4f   %15.4f %8.4f\n", i + 1, at.sure, at.sweeps, at.step,
                   static_cast<unsigned long long>(at.readings), at.before, at.after, at.held_out.before,
                   at.held_out.after);
  }
  text += format("\n%-26s %12s %12s\n", (outcome.sensor + " model").c_str(), "before", "learned");
  text += parameter_rows(normalised(outcome.before), learned.sensor);
  text += held_out_row("held out, labels of the start", learned.on_first_labels);
  text += held_out_row("held out, last labels", learned.on_last_labels);
  return text + "\n" + motion_table(outcome);
}

std::string learned_yaml(const LearningOutcome& outcome) {
  const localization::LearnedModels& learned = outcome.learned;
  std::string text = "# Learned by docent-lab learn-sensor-model";
  text +=
      format(", %s, from %zu recordings in %s:\n", outcome.sensor.c_str(), outcome.logs.size(), outcome.map.c_str());
  for (const std::string& log : outcome.logs) text += "#   " + log + "\n";
  const localization::HeldOut& held_out = learned.on_first_labels;
  text += format("# ln P of a reading held out: %.4f before, %.4f learned.\n", held_out.before, held_out.after);
  text += "localize:\n";
  if (learned.wall_depth > 0.0) text += format("  states:\n    wall_depth: %.5g\n", learned.wall_depth);
  if (outcome.sensor == "sonar") {
    text += "  sonar:\n    model:\n" + yaml_fields(learned.sensor, "      ");
  } else {
    text += "  sensor:\n" + yaml_fields(learned.sensor, "    ");
  }
  if (learned.motion) text += "  motion:\n" + yaml_fields(learned.motion->noise.motion, "    ");
  return text;
}

std::string learned_settings(const LearningOutcome& outcome) {
  const localization::LearnedModels& learned = outcome.learned;
  std::string text = "--set 'sensor=" + inline_fields(learned.sensor) + "'";
  if (learned.motion) text += " --set 'motion=" + inline_fields(learned.motion->noise.motion) + "'";
  return text;
}

std::string learning_json(const LearningOutcome& outcome) {
  const auto to_object = [](const auto& params) {
    nlohmann::json object;
    for (const auto& [key, value] : fields_of(params)) object[key] = value;
    return object;
  };
  const auto to_json = [](const localization::HeldOut& held_out) {
    return nlohmann::json{{"readings", held_out.readings},
                          {"pieces", held_out.pieces},
                          {"before", held_out.before},
                          {"after", held_out.after},
                          {"uncertainty", held_out.uncertainty}};
  };
  const localization::LearnedModels& learned = outcome.learned;
  nlohmann::json report;
  report["sensor"] = outcome.sensor;
  report["map"] = outcome.map;
  report["logs"] = outcome.logs;
  report["wall_depth"] = learned.wall_depth;
  report["before"] = to_object(normalised(outcome.before));
  report["learned"] = to_object(learned.sensor);
  report["held_out_first_labels"] = to_json(learned.on_first_labels);
  report["held_out_last_labels"] = to_json(learned.on_last_labels);
  for (const localization::BootstrapIteration& at : learned.iterations)
    report["iterations"].push_back({{"sweeps", at.sweeps},
                                    {"sure", at.sure},
                                    {"readings", at.readings},
                                    {"before", at.before},
                                    {"after", at.after}});
  if (learned.motion) {
    const motion_models::OdometryFit& fit = *learned.motion;
    report["motion"] = {{"before", to_object(outcome.motion_before)},
                        {"learned", to_object(fit.noise.motion)},
                        {"windows", fit.windows},
                        {"way_m", fit.way},
                        {"label_position_m", std::sqrt(fit.noise.label_position)},
                        {"label_heading_rad", std::sqrt(fit.noise.label_heading)},
                        {"drift_turn_rad_per_m", fit.drift_turn},
                        {"drift_length", fit.drift_length},
                        {"held_out",
                         {{"windows", learned.motion_held_windows},
                          {"before", learned.motion_held_before},
                          {"after", learned.motion_held_after}}}};
  }
  return report.dump(2) + "\n";
}

}  // namespace docent::apps::learn_command
