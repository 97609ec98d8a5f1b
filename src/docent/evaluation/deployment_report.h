#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace docent::evaluation {

/// Mean, spread and extremes of a few numbers, taken one at a time.
class Spread {
 public:
  void add(double value);
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] double mean() const { return mean_; }  ///< 0 for none
  [[nodiscard]] double deviation() const;              ///< of the sample; 0 for fewer than two
  [[nodiscard]] double min() const { return min_; }
  [[nodiscard]] double max() const { return max_; }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;  ///< sum of squared differences to the mean (Welford)
  double min_ = 0.0;
  double max_ = 0.0;
};

/// What a run cost; known to who ran it, not to a recording.
struct RunCost {
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;              ///< of the processor, all threads: what others do meanwhile is not in it
  std::map<std::string, double> p99_ms;  ///< of the steps, by module
};

/// The deployment report (architecture 9). Everything in it comes from the truth where the truth knows it.
struct DeploymentReport {
  std::string museum, mode, crowd, config_hash, simd;
  std::string crippled;  ///< by what, with ", " between; empty: not at all (architecture 10.17)
  std::uint64_t seed = 0;
  double virtual_seconds = 0.0;
  double travel_seconds = 0.0;    ///< a drive goal was active, blocked time included
  double standing_seconds = 0.0;  ///< of these, in which its wheels hardly turned: it waited for people or a command
  double distance_m = 0.0;
  double travel_distance_m = 0.0;  ///< while a drive goal was active
  double max_speed_mps = 0.0;
  /// From a goal's first driving state until the robot had come to its place.
  struct Trip {
    double seconds = 0.0;
    double distance_m = 0.0;
  };
  std::vector<Trip> trips;

  struct Requests {
    int offered = 0;
    int fulfilled = 0;
    std::map<std::string, int> refused;  ///< by reason
    int failed = 0;
    int cancelled = 0;       ///< taken back by who made them
    int open = 0;            ///< not closed at the end
    int counted = 0;         ///< offered more than ten minutes before the end, and not cancelled
    int counted_served = 0;  ///< of these, fulfilled
    int never_seen = 0;      ///< offered, and never on the request board
    int in_wrong_place = 0;  ///< said to be fulfilled, and truly more than 1 m from the place; counted as failed
  } requests;
  std::optional<double> success_rate;  ///< counted_served / counted; nullopt: no request is to be counted

  struct Tours {
    int given = 0;
    int completed = 0;
    Spread target_s;
    Spread seconds;  ///< of the completed ones
  } tours;
  int exhibits_explained = 0;
  int explained_in_wrong_place = 0;
  struct PlanRevisions {
    int inserted = 0, removed = 0, rescheduled = 0;
  } plan_revisions;
  int attraction_trials = 0;
  int visitors = 0;      ///< who asked in the hall
  int web_visitors = 0;  ///< who asked on the Web

  struct Contacts {
    int people = 0, furniture = 0, walls = 0, hazards = 0;
    [[nodiscard]] int all() const { return people + furniture + walls + hazards; }
  } contacts;
  int bumped_by_people = 0;
  double contact_seconds_wheels_turning = 0.0;
  int area_violations = 0;  ///< episodes
  int passes_within_1m = 0;

  struct Localization {
    Spread error_m;
    double p95_error_m = 0.0;
    Spread heading_error_deg;
    std::optional<double> localized_after_s;  ///< nullopt: never
    int lost_events = 0;
    double lost_s = 0.0;
    double wrong_but_sure_s = 0.0;  ///< of these: it said to be localized, and was not
    Spread blocked_beam_fraction;
  } localization;
  struct People {
    std::uint64_t present = 0;  ///< visible persons within 5 m, summed over the messages
    std::uint64_t found = 0;    ///< of these
    std::uint64_t claimed = 0;  ///< tracks within 5 m
    std::uint64_t right = 0;    ///< of these
  } people;
  struct Blocked {
    int events = 0;
    double seconds = 0.0;
    int horn = 0, local_detours = 0, global_detours = 0;
  } blocked;
  struct Battery {
    int charges = 0, depleted = 0;
  } battery;
  int module_restarts = 0;
  /// Of a kind of message when it is told (MessageAges).
  struct Age {
    std::uint64_t messages = 0;
    double p50_s = 0.0, p99_s = 0.0;
  };
  /// From what the lasers see to the command that knows it (CommandLatency); where time is that of the wall.
  struct Latency {
    std::uint64_t sweeps = 0;
    double p50_s = 0.0, p99_s = 0.0;
    std::uint64_t unanswered = 0;
    Age belief, hazards;
  };
  std::optional<Latency> latency;
};

/// JSON with keys in the order of architecture 9. With `cost`: wall_seconds, cpu_seconds, speedup (times faster than
/// real time, by the processor's seconds), wall_speedup and p99_ms too.
[[nodiscard]] std::string to_json(const DeploymentReport& report, const std::optional<RunCost>& cost);

/// For a terminal.
[[nodiscard]] std::string to_text(const DeploymentReport::Latency& latency);

/// A table for a terminal, every rate with its exposure.
[[nodiscard]] std::string summary_table(const DeploymentReport& report, const std::optional<RunCost>& cost);

}  // namespace docent::evaluation
