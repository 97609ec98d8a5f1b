#include "docent/apps/localize/localize_summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace docent::apps::localize_command {

namespace {

double number(const nlohmann::json& report, const char* key) {
  const auto found = report.find(key);
  return found != report.end() && found->is_number() ? found->get<double>() : 0.0;
}

/// Lengths as people say them.
std::string length(double metres) {
  return metres < 1.0 ? fmt::format("{:.1f} cm", 100.0 * metres) : fmt::format("{:.2f} m", metres);
}

std::string against_reference(const nlohmann::json& report) {
  if (!report.contains("reference_scans")) return "";
  const auto scans = report["reference_scans"].get<std::size_t>();
  if (scans == 0) return "  against the reference: no scan could be compared\n";
  std::string text = fmt::format(
      "  against the reference, {} scans: mean error {}, 19 of 20 within {}, at most {}; heading {:.1f} degrees in the "
      "mean\n  lost in {:.0f} scans ({:.1f} %), sure and wrong in {:.0f}, unsure in {:.0f}\n",
      scans, length(number(report, "mean_error_m")), length(number(report, "p95_error_m")),
      length(number(report, "max_error_m")), number(report, "mean_heading_error_deg"), number(report, "lost_scans"),
      100.0 * number(report, "lost_fraction"), number(report, "sure_and_wrong_scans"), number(report, "unsure_scans"));
  const auto hindsight = report.find("in_hindsight");
  if (hindsight == report.end() || number(*hindsight, "reference_scans") == 0.0) return text;
  return text + fmt::format("  in hindsight, {:.0f} scans: mean error {}, 19 of 20 within {}, lost in {:.0f}\n",
                            number(*hindsight, "reference_scans"), length(number(*hindsight, "mean_error_m")),
                            length(number(*hindsight, "p95_error_m")), number(*hindsight, "lost_scans"));
}

}  // namespace

std::string summary_of_run(const nlohmann::json& report) {
  const auto scans = report.value("scans", std::size_t{0});
  const auto updates = report.value("updates", std::size_t{0});
  std::string text = fmt::format("  {} scans, {} of them an update of the belief with {:.0f} beams ({:.0f} filtered)\n",
                                 scans, updates, number(report, "beams_used"), number(report, "beams_filtered"));
  if (report.contains("seconds_per_scan")) {
    const auto& seconds = report["seconds_per_scan"];
    text += fmt::format("  {:.1f} ms a scan in the median, 99 of 100 within {:.1f} ms, the first {:.0f} ms\n",
                        1e3 * number(seconds, "median"), 1e3 * number(seconds, "p99"), 1e3 * number(seconds, "first"));
  }
  const auto after = report.find("localized_after_scans");
  if (after == report.end() || after->is_null()) {
    text += "  it never said that it knows where it is\n";
  } else {
    text += fmt::format(
        "  it first said that it knows where it is after {} scans, and said so in {:.1f} % of all; in hindsight it "
        "knows its place in another {:.1f} %, and takes back {:.1f} %\n",
        after->get<std::size_t>(), 100.0 * number(report, "localized_fraction"),
        100.0 * number(report, "in_hindsight_fraction"), 100.0 * number(report, "taken_back_fraction"));
    if (report.contains("endpoints_near_walls") && report["endpoints_near_walls"].is_number())
      text += fmt::format("  {:.1f} % of the readings since then end within 0.2 m of a wall of the map\n",
                          100.0 * number(report, "endpoints_near_walls"));
  }
  return text + against_reference(report);
}

std::string summary_of_agreement(const nlohmann::json& agreement) {
  const auto scans = agreement.value("both_know", std::size_t{0});
  if (scans == 0) return "  there is no scan in which both know where they were: nothing to compare\n";
  std::string text = fmt::format(
      "  in hindsight within 0.5 m and 10 degrees in {:.1f} % of {} scans; {} in the median, 19 of 20 within {}, at "
      "most "
      "{}\n",
      100.0 * number(agreement, "within_half_a_metre_and_10_degrees"), scans, length(number(agreement, "median_m")),
      length(number(agreement, "p95_m")), length(number(agreement, "max_m")));
  const auto said = agreement.find("there_and_then");
  if (said == agreement.end()) return text;
  const auto both = said->value("both_know", std::size_t{0});
  if (both == 0) return text + "  there and then there was no scan in which both said that they knew\n";
  return text + fmt::format("  there and then in {:.1f} % of the {} scans in which both said that they knew\n",
                            100.0 * number(*said, "within_half_a_metre_and_10_degrees"), both);
}

}  // namespace docent::apps::localize_command
