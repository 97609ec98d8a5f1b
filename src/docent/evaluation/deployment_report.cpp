#include "docent/evaluation/deployment_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace docent::evaluation {
namespace {

using Json = nlohmann::ordered_json;

/// Four decimals: enough to compare runs, and readable.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json ratio(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? Json{} : Json(rounded(static_cast<double>(part) / static_cast<double>(whole)));
}
Json or_null(bool known, double value) { return known ? Json(rounded(value)) : Json{}; }

/// @param names  with ", " between them
Json names_in(std::string_view names) {
  Json list = Json::array();
  while (!names.empty()) {
    const auto end = std::min(names.find(", "), names.size());
    list.push_back(std::string{names.substr(0, end)});
    names.remove_prefix(std::min(end + 2, names.size()));
  }
  return list;
}

double mean_speed(const DeploymentReport& report) {
  return report.travel_seconds > 0.0 ? report.travel_distance_m / report.travel_seconds : 0.0;
}

/// Than real time, when the run took so many seconds; 0 when that is not known.
double times_faster(const DeploymentReport& report, double seconds) {
  return seconds > 0.0 ? rounded(report.virtual_seconds / seconds) : 0.0;
}

int refused(const DeploymentReport& report) {
  int sum = 0;
  for (const auto& [reason, count] : report.requests.refused) sum += count;
  return sum;
}

Json requests_of(const DeploymentReport::Requests& requests) {
  return {{"offered", requests.offered},
          {"fulfilled", requests.fulfilled},
          {"refused", requests.refused.empty() ? Json::object() : Json(requests.refused)},
          {"failed", requests.failed},
          {"cancelled", requests.cancelled},
          {"open", requests.open},
          {"counted", requests.counted},
          {"counted_served", requests.counted_served},
          {"never_seen", requests.never_seen},
          {"in_wrong_place", requests.in_wrong_place}};
}

Json tours_of(const DeploymentReport::Tours& tours) {
  const bool has_tours = tours.seconds.count() > 0;
  return {{"given", tours.given},
          {"completed", tours.completed},
          {"target_s", or_null(tours.target_s.count() > 0, tours.target_s.mean())},
          {"mean_s", or_null(has_tours, tours.seconds.mean())},
          {"sd_s", or_null(has_tours, tours.seconds.deviation())},
          {"min_s", or_null(has_tours, tours.seconds.min())},
          {"max_s", or_null(has_tours, tours.seconds.max())}};
}

Json localization_of(const DeploymentReport::Localization& l) {
  const bool has_poses = l.error_m.count() > 0;
  return {{"mean_error_m", or_null(has_poses, l.error_m.mean())},
          {"p95_error_m", or_null(has_poses, l.p95_error_m)},
          {"max_error_m", or_null(has_poses, l.error_m.max())},
          {"mean_heading_error_deg", or_null(has_poses, l.heading_error_deg.mean())},
          {"localized_after_s", or_null(l.localized_after_s.has_value(), l.localized_after_s.value_or(0.0))},
          {"lost_events", l.lost_events},
          {"lost_s", rounded(l.lost_s)},
          {"wrong_but_sure_s", rounded(l.wrong_but_sure_s)},
          {"blocked_beam_fraction", rounded(l.blocked_beam_fraction.mean())}};
}

Json age_of(const DeploymentReport::Age& age) {
  return {{"p50_ms", rounded(1e3 * age.p50_s)}, {"p99_ms", rounded(1e3 * age.p99_s)}, {"messages", age.messages}};
}

void add_latency(const DeploymentReport::Latency& latency, Json& json) {
  json["scan_to_command"] = {{"p50_ms", rounded(1e3 * latency.p50_s)},
                             {"p99_ms", rounded(1e3 * latency.p99_s)},
                             {"sweeps", latency.sweeps},
                             {"unanswered", latency.unanswered}};
  json["belief_age"] = age_of(latency.belief);
  json["hazards_age"] = age_of(latency.hazards);
}

Json trips_of(const DeploymentReport& report) {
  Json trips = Json::array();
  for (const auto& trip : report.trips) {
    trips.push_back({{"seconds", rounded(trip.seconds)}, {"distance_m", rounded(trip.distance_m)}});
  }
  return trips;
}

}  // namespace

void Spread::add(double value) {
  min_ = count_ == 0 ? value : std::min(min_, value);
  max_ = count_ == 0 ? value : std::max(max_, value);
  ++count_;
  const double before = value - mean_;
  mean_ += before / static_cast<double>(count_);
  squares_ += before * (value - mean_);
}

double Spread::deviation() const { return count_ < 2 ? 0.0 : std::sqrt(squares_ / static_cast<double>(count_ - 1)); }

std::string to_json(const DeploymentReport& r, const std::optional<RunCost>& cost) {
  Json json;
  json["museum"] = r.museum;
  json["mode"] = r.mode;
  json["seed"] = r.seed;
  json["crowd"] = r.crowd;
  json["config_hash"] = r.config_hash;
  json["simd"] = r.simd;
  json["crippled"] = names_in(r.crippled);
  json["virtual_seconds"] = rounded(r.virtual_seconds);
  if (cost) {
    json["wall_seconds"] = rounded(cost->wall_seconds);
    json["cpu_seconds"] = rounded(cost->cpu_seconds);
    json["speedup"] = times_faster(r, cost->cpu_seconds);
    json["wall_speedup"] = times_faster(r, cost->wall_seconds);
  }
  json["travel_seconds"] = rounded(r.travel_seconds);
  json["standing_seconds"] = rounded(r.standing_seconds);
  json["distance_m"] = rounded(r.distance_m);
  json["mean_speed_mps"] = rounded(mean_speed(r));
  json["max_speed_mps"] = rounded(r.max_speed_mps);
  json["requests"] = requests_of(r.requests);
  json["success_rate"] = or_null(r.success_rate.has_value(), r.success_rate.value_or(0.0));
  json["tours"] = tours_of(r.tours);
  json["exhibits_explained"] = r.exhibits_explained;
  json["explained_in_wrong_place"] = r.explained_in_wrong_place;
  json["plan_revisions"] = {{"inserted", r.plan_revisions.inserted},
                            {"removed", r.plan_revisions.removed},
                            {"rescheduled", r.plan_revisions.rescheduled}};
  json["attraction_trials"] = r.attraction_trials;
  json["visitors"] = r.visitors;
  json["web_visitors"] = r.web_visitors;
  json["contacts"] = {{"people", r.contacts.people},
                      {"furniture", r.contacts.furniture},
                      {"walls", r.contacts.walls},
                      {"hazards", r.contacts.hazards}};
  json["bumped_by_people"] = r.bumped_by_people;
  json["contact_seconds_wheels_turning"] = rounded(r.contact_seconds_wheels_turning);
  json["area_violations"] = r.area_violations;
  json["passes_within_1m"] = r.passes_within_1m;
  json["localization"] = localization_of(r.localization);
  json["people"] = {{"recall", ratio(r.people.found, r.people.present)},
                    {"precision", ratio(r.people.right, r.people.claimed)}};
  json["blocked"] = {{"events", r.blocked.events},
                     {"seconds", rounded(r.blocked.seconds)},
                     {"horn", r.blocked.horn},
                     {"local_detours", r.blocked.local_detours},
                     {"global_detours", r.blocked.global_detours}};
  json["battery"] = {{"charges", r.battery.charges}, {"depleted", r.battery.depleted}};
  json["module_restarts"] = r.module_restarts;
  if (r.latency) add_latency(*r.latency, json);
  json["trips"] = trips_of(r);
  if (cost) {
    Json p99 = Json::object();
    for (const auto& [module, ms] : cost->p99_ms) p99[module] = rounded(ms);
    json["p99_ms"] = std::move(p99);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_text(const DeploymentReport::Latency& latency) {
  return fmt::format("50 % after {:.1f} ms, 99 % after {:.1f} ms, of {} sweeps; {} unanswered", 1e3 * latency.p50_s,
                     1e3 * latency.p99_s, latency.sweeps, latency.unanswered);
}

std::string summary_table(const DeploymentReport& r, const std::optional<RunCost>& cost) {
  std::string text;
  const auto row = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("  {:<16}{}\n", name, value);
  };
  const double km = r.distance_m / 1000.0;
  text += fmt::format("{}, {} mode, {} crowd, seed {}{}\n", r.museum, r.mode, r.crowd, r.seed,
                      r.crippled.empty() ? "" : ", crippled: " + r.crippled);
  std::string time = fmt::format("{:.0f} s", r.virtual_seconds);
  if (cost && cost->wall_seconds > 0.0)
    time += fmt::format(" in {:.1f} s of the processor ({:.1f} times real time), {:.1f} s by the wall",
                        cost->cpu_seconds, times_faster(r, cost->cpu_seconds), cost->wall_seconds);
  row("time", time);
  row("driven", fmt::format("{:.0f} m; {:.2f} m/s over {:.0f} s with a goal, at most {:.2f} m/s", r.distance_m,
                            mean_speed(r), r.travel_seconds, r.max_speed_mps));
  row("requests",
      fmt::format("{} offered: {} fulfilled, {} failed, {} refused, {} cancelled, {} open", r.requests.offered,
                  r.requests.fulfilled, r.requests.failed, refused(r), r.requests.cancelled, r.requests.open));
  row("success", r.success_rate ? fmt::format("{:.1f} % of {} (those of the last ten minutes are not counted)",
                                              100.0 * *r.success_rate, r.requests.counted)
                                : "nothing to count: no request was made ten minutes before the end");
  row("tours", fmt::format("{} given, {} completed; {} exhibits explained", r.tours.given, r.tours.completed,
                           r.exhibits_explained));
  row("contacts", fmt::format("{} people, {} furniture, {} walls, {} hazards in {:.2f} km and {} passes within 1 m; "
                              "bumped by people {}",
                              r.contacts.people, r.contacts.furniture, r.contacts.walls, r.contacts.hazards, km,
                              r.passes_within_1m, r.bumped_by_people));
  row("area", fmt::format("{} violations", r.area_violations));
  const DeploymentReport::Localization& l = r.localization;
  row("localized", l.localized_after_s
                       ? fmt::format("after {:.1f} s; mean error {:.3f} m, 95 % {:.3f} m, {:.2f} deg",
                                     *l.localized_after_s, l.error_m.mean(), l.p95_error_m, l.heading_error_deg.mean())
                       : "never");
  row("lost", fmt::format("{} times, {:.1f} s; sure and wrong {:.1f} s; {:.0f} % of the beams end on people",
                          l.lost_events, l.lost_s, l.wrong_but_sure_s, 100.0 * l.blocked_beam_fraction.mean()));
  const auto percent = [](std::uint64_t part, std::uint64_t whole) {
    return whole == 0
               ? std::string{"-"}
               : fmt::format("{:.0f} % of {}", 100.0 * static_cast<double>(part) / static_cast<double>(whole), whole);
  };
  row("people", fmt::format("recall {}, precision {}", percent(r.people.found, r.people.present),
                            percent(r.people.right, r.people.claimed)));
  row("blocked", fmt::format("{} times, {:.0f} s; horn {} times", r.blocked.events, r.blocked.seconds, r.blocked.horn));
  if (r.latency) row("scan to drive", to_text(*r.latency));
  if (r.module_restarts > 0) row("restarts", std::to_string(r.module_restarts));
  return text;
}

}  // namespace docent::evaluation
