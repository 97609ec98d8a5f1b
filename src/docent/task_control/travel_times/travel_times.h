#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"

namespace docent::task_control {

/// Section `mission.travel_times` of robot.yaml.
struct TravelTimeParams {
  bool learns = true;         ///< false: the numbers below hold for ever
  double speed = 0.35;        ///< [m/s] > 0 on the way, people included: until ways were seen
  double start_s = 3.0;       ///< [s] >= 0 to set out and to turn to the exhibit: likewise
  double spread = 0.35;       ///< > 0 deviation of a way's time over its mean: likewise
  double prior_ways = 10.0;   ///< [ways] > 0: weight of the three above against ways that were seen
  double prior_examples = 3;  ///< [ways] > 0: weight of what the length says against ways of the same pair of places
  double prior_hours = 20;    ///< [ways] > 0: weight of the assumption that this hour is as fast as all others
  double crowd_s = 1200;      ///< [s] > 0: how long a way tells of the crowd; busy and quiet change within the hour
  double prior_crowd = 3;     ///< [ways] > 0: weight of the assumption that the crowd is as usual
  double most_ratio = 3.0;  ///< > 1: a way that took longer than so many times its mean counts as that: it was blocked
  double speech_s = 1.0;    ///< [s] >= 0 that a visit takes beyond its spoken words, when nothing is asked
  double question_s = 5.0;  ///< [s] >= 0 likewise, with the question and nobody who wants more
  double answer_s = 3.5;    ///< [s] >= 0 likewise, with the question and somebody who wants more
  double more_share = 0.2;  ///< 0..1 of the questions are answered with "more"
  double prior_visits = 5.0;  ///< [visits] > 0: weight of the four above against visits that were seen
  template <class V>
  void visit(V& v) {
    v("learns", learns);
    v("speed", speed);
    v("start_s", start_s);
    v("spread", spread);
    v("prior_ways", prior_ways);
    v("prior_examples", prior_examples);
    v("prior_hours", prior_hours);
    v("crowd_s", crowd_s);
    v("prior_crowd", prior_crowd);
    v("most_ratio", most_ratio);
    v("speech_s", speech_s);
    v("question_s", question_s);
    v("answer_s", answer_s);
    v("more_share", more_share);
    v("prior_visits", prior_visits);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// A duration that is not known for sure.
struct Foreseen {
  double mean_s = 0.0;    ///< [s]; +infinity where there is no way
  double spread_s = 0.0;  ///< [s] standard deviation
};

/// How a visit at an exhibit goes after the arrival.
enum class VisitCourse { unasked, went_on, heard_more };

/// What a row of experience is about. `pair`: a way from one place to another; `demand`: an
/// hour of the day, which is the mission's matter; the others are of the whole museum.
enum class LessonKind { pair, metres, seconds, deviation, hour, crowd, unasked, went_on, heard_more, demand };
struct LessonKey {
  LessonKind kind{};
  std::string from{};
  std::string to{};
  friend auto operator<=>(const LessonKey&, const LessonKey&) = default;
};
[[nodiscard]] std::string to_text(LessonKind kind);
[[nodiscard]] std::optional<LessonKind> lesson_kind_of(const std::string& text);

/// Sums over what was seen; their meaning depends on the kind, see travel_times.cpp.
struct Lesson {
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  double reference = 0.0;
  friend bool operator==(const Lesson&, const Lesson&) = default;
};
struct LessonRow {
  LessonKey key;
  Lesson lesson;
};

/// A line of the table of travel times ([Minerva2000] Table 3).
struct PairRow {
  std::string from;
  std::string to;
  int examples = 0;
  double mean_s = 0.0;    ///< [s] empirical
  double spread_s = 0.0;  ///< [s] empirical; 0 for one example
  double way_m = 0.0;     ///< [m]
};

/// How long the ways between places and the visits at exhibits take, learned from what they took ([Minerva2000] 5.3:
/// the empirical mean for each pair of places).
///
/// A way is foreseen in three factors: the mean of its pair, drawn towards what its length says while there are few
/// examples; how slow this hour of the day is; and how slow the last ways were, which is mostly the crowd. What length
/// says is a line, seconds over metres, fitted to all ways. A single way that was blocked counts as `most_ratio` times
/// its mean at most. A pair whose way has another length than before (a new map, an exhibit that was moved) is learned
/// anew. Deterministic. Learning and foreseeing are O(log pairs).
class TravelTimes {
 public:
  explicit TravelTimes(const TravelTimeParams& params) : params_{params} {}

  /// Experience from before, as `rows` gave it.
  void restore(std::span<const LessonRow> rows);
  /// The hour of the day, 0..23, for what is learned and foreseen from now on.
  void set_hour(int hour) { hour_ = hour; }

  /// A way that took `seconds`. Places are named; an empty name is anywhere. @param way_m  [m] >= 0
  void learn_way(const std::string& from, const std::string& to, double way_m, double seconds, Time now);
  /// A visit that took `beyond_s` longer than its spoken words [s].
  void learn_visit(VisitCourse course, double beyond_s);

  [[nodiscard]] Foreseen way(const std::string& from, const std::string& to, double way_m, Time now) const;
  /// [s] that a visit takes beyond its spoken words.
  [[nodiscard]] double beyond_speech(VisitCourse course) const;
  /// Chance that whoever is asked wants to hear more, 0..1.
  [[nodiscard]] double share_of_more() const;

  /// All that was learned, for a file.
  [[nodiscard]] std::vector<LessonRow> rows() const;
  /// What was learned since the last `mark_stored`.
  [[nodiscard]] std::vector<LessonRow> unstored() const;
  void mark_stored() { unstored_.clear(); }

 private:
  [[nodiscard]] const Lesson& find(LessonKind kind, const std::string& from = {}, const std::string& to = {}) const;
  Lesson& change(LessonKind kind, const std::string& from = {}, const std::string& to = {});
  [[nodiscard]] double by_length(double way_m) const;
  [[nodiscard]] double usual_spread() const;
  [[nodiscard]] Foreseen pair(const std::string& from, const std::string& to, double way_m) const;
  [[nodiscard]] double hour_factor() const;
  [[nodiscard]] double crowd_factor(Time now) const;

  TravelTimeParams params_;
  int hour_ = 12;
  std::map<LessonKey, Lesson> lessons_;
  std::set<LessonKey> unstored_;
};

/// The pairs among the rows, by name.
[[nodiscard]] std::vector<PairRow> travel_table(std::span<const LessonRow> rows);
/// The same as CSV: from, to, examples, mean_s, spread_s, way_m.
[[nodiscard]] std::string to_csv(std::span<const PairRow> table);

}  // namespace docent::task_control
