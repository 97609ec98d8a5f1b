#include "docent/task_control/travel_times/travel_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <utility>

// What the sums of a lesson are:
//   pair       count of examples; sum and squares of their seconds; reference: length of the way [m]
//   metres     count of all ways; sum and squares of their metres; reference: sum of metres times seconds
//   seconds    count of all ways; sum and squares of their seconds
//   deviation  count of all ways; squares: of (seconds over what was foreseen) - 1
//   hour       count of ways; sum of their slowness; `from` is the hour, two digits. Slowness: seconds over the mean of
//              the pair, over the mean of that over all ways, for which `from` is empty
//   crowd      count and sum of slowness over the hour's factor, both fading; reference: when [s]
//   unasked, went_on, heard_more: count of visits; sum of the seconds beyond the spoken words

namespace docent::task_control {
namespace {

constexpr std::array<const char*, 10> kKinds{"pair",  "metres",  "seconds", "deviation",  "hour",
                                             "crowd", "unasked", "went_on", "heard_more", "demand"};
/// [m] The two lengths at which the parameters are taken as seen before any way was: a short way and a long one.
constexpr std::array<double, 2> kPriorWays{2.0, 20.0};
constexpr double kSameWay = 0.1;        ///< of the length, and
constexpr double kSameWayMetres = 0.5;  ///< [m]: by so much ways may differ that are still the same
constexpr double kSlowest = 20.0;       ///< [s/m] no museum is crossed more slowly
constexpr double kFastest = 0.5;        ///< [s/m] nor faster
constexpr double kFactorLeast = 0.5;    ///< of hour and crowd
constexpr double kFactorMost = 3.0;

std::string hour_name(int hour) { return {static_cast<char>('0' + hour / 10), static_cast<char>('0' + hour % 10)}; }

LessonKind kind_of(VisitCourse course) {
  return course == VisitCourse::unasked   ? LessonKind::unasked
         : course == VisitCourse::went_on ? LessonKind::went_on
                                          : LessonKind::heard_more;
}

double factor_of(double count, double sum, double prior) {
  return std::clamp((prior + sum) / (prior + count), kFactorLeast, kFactorMost);
}

}  // namespace

Result<void> TravelTimeParams::validate() const {
  const std::array<std::pair<const char*, double>, 8> positive{{{"speed", speed},
                                                                {"spread", spread},
                                                                {"prior_ways", prior_ways},
                                                                {"prior_examples", prior_examples},
                                                                {"prior_hours", prior_hours},
                                                                {"crowd_s", crowd_s},
                                                                {"prior_crowd", prior_crowd},
                                                                {"prior_visits", prior_visits}}};
  for (const auto& [name, value] : positive) {
    if (!(value > 0.0)) return fail("mission.travel_times." + std::string{name} + " must be > 0");
  }
  const std::array<std::pair<const char*, double>, 4> durations{
      {{"start_s", start_s}, {"speech_s", speech_s}, {"question_s", question_s}, {"answer_s", answer_s}}};
  for (const auto& [name, value] : durations) {
    if (!(value >= 0.0)) return fail("mission.travel_times." + std::string{name} + " must be >= 0");
  }
  if (!(most_ratio > 1.0)) return fail("mission.travel_times.most_ratio must be > 1");
  if (!(more_share >= 0.0 && more_share <= 1.0)) return fail("mission.travel_times.more_share must be in 0..1");
  return {};
}

std::string to_text(LessonKind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }

std::optional<LessonKind> lesson_kind_of(const std::string& text) {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (text == kKinds.at(i)) return static_cast<LessonKind>(i);
  }
  return std::nullopt;
}

void TravelTimes::restore(std::span<const LessonRow> rows) {
  for (const LessonRow& row : rows) {
    const Lesson& lesson = row.lesson;
    const bool is_sound = std::isfinite(lesson.count) && lesson.count >= 0.0 && std::isfinite(lesson.sum) &&
                          std::isfinite(lesson.squares) && std::isfinite(lesson.reference);
    if (is_sound) lessons_[row.key] = lesson;  // what a damaged file says is not worth a robot that stands
  }
}

const Lesson& TravelTimes::find(LessonKind kind, const std::string& from, const std::string& to) const {
  static const Lesson kNothing;
  const auto place = lessons_.find({kind, from, to});
  return place == lessons_.end() ? kNothing : place->second;
}

Lesson& TravelTimes::change(LessonKind kind, const std::string& from, const std::string& to) {
  const LessonKey key{kind, from, to};
  unstored_.insert(key);
  return lessons_[key];
}

double TravelTimes::by_length(double way_m) const {
  const Lesson& metres = find(LessonKind::metres);
  const Lesson& seconds = find(LessonKind::seconds);
  double n = metres.count;
  double d = metres.sum;
  double dd = metres.squares;
  double dt = metres.reference;
  double t = seconds.sum;
  for (const double prior_m : kPriorWays) {
    const double weight = params_.prior_ways / static_cast<double>(kPriorWays.size());
    const double prior_s = params_.start_s + prior_m / params_.speed;
    n += weight;
    d += weight * prior_m;
    dd += weight * prior_m * prior_m;
    dt += weight * prior_m * prior_s;
    t += weight * prior_s;
  }
  // The line of least squares; the two lengths of the prior keep it from being undetermined.
  const double slope = std::clamp((n * dt - d * t) / (n * dd - d * d), kFastest, kSlowest);
  return std::max(0.0, (t - slope * d) / n) + slope * way_m;
}

double TravelTimes::usual_spread() const {
  const Lesson& seen = find(LessonKind::deviation);
  return std::sqrt((params_.prior_ways * params_.spread * params_.spread + seen.squares) /
                   (params_.prior_ways + seen.count));
}

Foreseen TravelTimes::pair(const std::string& from, const std::string& to, double way_m) const {
  const double by_length_s = by_length(way_m);
  const double prior_spread_s = usual_spread() * by_length_s;
  const Lesson& seen = find(LessonKind::pair, from, to);
  const bool is_same = std::abs(seen.reference - way_m) <= kSameWay * way_m + kSameWayMetres;
  if (from.empty() || to.empty() || !is_same) return {by_length_s, prior_spread_s};
  const double k = params_.prior_examples;
  const double mean_s = (k * by_length_s + seen.sum) / (k + seen.count);
  // The sum of squares about the mean, the examples' and the prior's.
  const double about_mean = seen.squares - 2.0 * mean_s * seen.sum + seen.count * mean_s * mean_s;
  const double off = by_length_s - mean_s;
  const double variance =
      (k * (prior_spread_s * prior_spread_s + off * off) + std::max(0.0, about_mean)) / (k + seen.count);
  return {mean_s, std::sqrt(variance)};
}

double TravelTimes::hour_factor() const {
  const Lesson& seen = find(LessonKind::hour, hour_name(hour_));
  return factor_of(seen.count, seen.sum, params_.prior_hours);
}

double TravelTimes::crowd_factor(Time now) const {
  const Lesson& seen = find(LessonKind::crowd);
  const double age_s = std::max(0.0, to_seconds(now - Time{}) - seen.reference);
  const double left = std::exp(-age_s / params_.crowd_s);
  return factor_of(left * seen.count, left * seen.sum, params_.prior_crowd);
}

Foreseen TravelTimes::way(const std::string& from, const std::string& to, double way_m, Time now) const {
  if (!std::isfinite(way_m)) return {way_m, 0.0};
  Foreseen foreseen = pair(from, to, way_m);
  const double factor = hour_factor() * crowd_factor(now);
  return {factor * foreseen.mean_s, factor * foreseen.spread_s};
}

void TravelTimes::learn_way(const std::string& from, const std::string& to, double way_m, double seconds, Time now) {
  if (!params_.learns || !std::isfinite(way_m) || !(seconds >= 0.0)) return;
  const double usual_s = pair(from, to, way_m).mean_s;
  const double hour = hour_factor();
  const double foreseen_s = usual_s * hour * crowd_factor(now);
  seconds = std::min(seconds, params_.most_ratio * foreseen_s);

  Lesson& deviation = change(LessonKind::deviation);
  deviation.count += 1.0;
  deviation.squares += std::pow(seconds / foreseen_s - 1.0, 2);

  Lesson& of_all = change(LessonKind::hour);
  const double slowness = seconds / usual_s / factor_of(of_all.count, of_all.sum, params_.prior_hours);
  of_all.count += 1.0;
  of_all.sum += seconds / usual_s;

  Lesson& of_hour = change(LessonKind::hour, hour_name(hour_));
  of_hour.count += 1.0;
  of_hour.sum += slowness;

  Lesson& crowd = change(LessonKind::crowd);
  const double now_s = to_seconds(now - Time{});
  const double left = std::exp(-std::max(0.0, now_s - crowd.reference) / params_.crowd_s);
  crowd.count = left * crowd.count + 1.0;
  crowd.sum = left * crowd.sum + slowness / hour;
  crowd.reference = now_s;

  Lesson& metres = change(LessonKind::metres);
  metres.count += 1.0;
  metres.sum += way_m;
  metres.squares += way_m * way_m;
  metres.reference += way_m * seconds;
  Lesson& of_ways = change(LessonKind::seconds);
  of_ways.count += 1.0;
  of_ways.sum += seconds;
  of_ways.squares += seconds * seconds;

  if (from.empty() || to.empty()) return;
  Lesson& of_pair = change(LessonKind::pair, from, to);
  if (std::abs(of_pair.reference - way_m) > kSameWay * way_m + kSameWayMetres) of_pair = {};
  of_pair.count += 1.0;
  of_pair.sum += seconds;
  of_pair.squares += seconds * seconds;
  of_pair.reference = way_m;
}

void TravelTimes::learn_visit(VisitCourse course, double beyond_s) {
  if (!params_.learns) return;
  // A speech that was cut short or hung tells nothing of the next one.
  constexpr double kShortest = -10.0;  // [s]
  constexpr double kLongest = 20.0;    // [s]
  Lesson& seen = change(kind_of(course));
  seen.count += 1.0;
  seen.sum += std::clamp(beyond_s, kShortest, kLongest);
}

double TravelTimes::beyond_speech(VisitCourse course) const {
  const double prior_s = course == VisitCourse::unasked   ? params_.speech_s
                         : course == VisitCourse::went_on ? params_.question_s
                                                          : params_.answer_s;
  const Lesson& seen = find(kind_of(course));
  return (params_.prior_visits * prior_s + seen.sum) / (params_.prior_visits + seen.count);
}

double TravelTimes::share_of_more() const {
  const double more = find(LessonKind::heard_more).count;
  const double asked = more + find(LessonKind::went_on).count;
  return (params_.prior_visits * params_.more_share + more) / (params_.prior_visits + asked);
}

std::vector<LessonRow> TravelTimes::rows() const {
  std::vector<LessonRow> rows;
  for (const auto& [key, lesson] : lessons_) rows.push_back({key, lesson});
  return rows;
}

std::vector<LessonRow> TravelTimes::unstored() const {
  std::vector<LessonRow> rows;
  for (const LessonKey& key : unstored_) rows.push_back({key, lessons_.at(key)});
  return rows;
}

std::vector<PairRow> travel_table(std::span<const LessonRow> rows) {
  std::vector<PairRow> table;
  for (const auto& [key, lesson] : rows) {
    if (key.kind != LessonKind::pair || !(lesson.count >= 1.0)) continue;
    const double mean_s = lesson.sum / lesson.count;
    const double about_mean = std::max(0.0, lesson.squares - lesson.count * mean_s * mean_s);
    const double spread_s = lesson.count > 1.0 ? std::sqrt(about_mean / (lesson.count - 1.0)) : 0.0;
    table.push_back(
        {key.from, key.to, static_cast<int>(std::lround(lesson.count)), mean_s, spread_s, lesson.reference});
  }
  std::sort(table.begin(), table.end(),
            [](const PairRow& a, const PairRow& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
  return table;
}

std::string to_csv(std::span<const PairRow> table) {
  std::string text = "from,to,examples,mean_s,spread_s,way_m\n";
  for (const PairRow& row : table) {
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, ",%d,%.2f,%.2f,%.2f\n", row.examples, row.mean_s, row.spread_s, row.way_m);
    text += row.from + "," + row.to + numbers;
  }
  return text;
}

}  // namespace docent::task_control
