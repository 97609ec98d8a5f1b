#pragma once

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/store/database.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {

/// What is counted of each day and each kind of hours, as [Rhino1999] table 6 and [Minerva2000] table 4 count.
enum class Counted {
  uptime_s,    ///< [s] that the robot was on
  travel_s,    ///< [s] that it moved
  distance_m,  ///< [m] that it drove
  max_speed,   ///< [m/s] the highest of the day
  tours,       ///< that were completed
  exhibits,    ///< that were explained
  visitors,    ///< people who stood round the robot when it began to explain
  accesses,    ///< requests for files and documents, and openings of the live channel
  web,         ///< requests from the Web, likewise the next four by their source
  kiosk,
  visitor,
  staff,
  vote,
  fulfilled,       ///< requests
  failed,          ///< requests that were taken and not fulfilled
  points,          ///< on the map that the robot reached
  votes,           ///< for tours
  tours_failed,    ///< that showed too little
  tours_broken,    ///< broken off for a charge; each may go on later
  plan_revisions,  ///< stops that were put in, left out, put off, or cut for want of time
  first_stop,      ///< people round the robot at the first stop of a tour
  last_stop,       ///< and at the last one of a tour that was completed: who stayed
  contacts,        ///< that the robot has felt
  liked_yes,       ///< answers to the poll, likewise all that follow
  liked_undecided,
  liked_no,
  satisfied_yes,
  satisfied_undecided,
  satisfied_no,
  price_yes,
  price_undecided,
  price_no,
  human,
  monkey,
  dog,
  fish,
  amoeba,
};
constexpr auto words_of(Counted) {
  return std::array{"uptime_s",
                    "travel_s",
                    "distance_m",
                    "max_speed",
                    "tours",
                    "exhibits",
                    "visitors",
                    "accesses",
                    "web",
                    "kiosk",
                    "visitor",
                    "staff",
                    "vote",
                    "fulfilled",
                    "failed",
                    "points",
                    "votes",
                    "tours_failed",
                    "tours_broken",
                    "plan_revisions",
                    "first_stop",
                    "last_stop",
                    "contacts",
                    "liked_yes",
                    "liked_undecided",
                    "liked_no",
                    "satisfied_yes",
                    "satisfied_undecided",
                    "satisfied_no",
                    "price_yes",
                    "price_undecided",
                    "price_no",
                    "human",
                    "monkey",
                    "dog",
                    "fish",
                    "amoeba"};
}
/// Where an answer to the poll is counted. @pre answers(answer, question)
[[nodiscard]] Counted counted_of(PollQuestion question, PollAnswer answer);
using Counts = std::map<Counted, double>;

/// One day of one kind of hours.
struct DayCount {
  std::string day;   ///< 2026-11-25, UTC
  std::string mode;  ///< open, web, closed
  Counts counts;
  std::int64_t web_visitors = 0;  ///< different addresses from which the page was opened
};

/// How many people stood round the robot when it had explained a stop of a tour.
struct Attendance {
  Time tour_began;
  int stop = 1;  ///< of those that this tour has shown, from 1
  std::string tour;
  std::string exhibit;
  int people = 0;
};
/// One of a day.
struct AttendanceOfDay {
  std::string day;  ///< on which the stop was shown, UTC
  std::string mode;
  Attendance stop;
};

/// Counts that last, by days. Several gateways may share the database: each adds what came through it, and one at a
/// time what is of the robot. One thread.
class Statistics {
 public:
  /// Makes its tables where there are none. The database outlives it.
  [[nodiscard]] static Result<std::unique_ptr<Statistics>> open(Database& database);
  Statistics(const Statistics&) = delete;
  Statistics& operator=(const Statistics&) = delete;

  /// Adds all of it, or nothing.
  [[nodiscard]] Result<void> add(Time now, const std::string& mode, const Counts& counts);
  /// From these addresses the page was opened. Of each a hash is kept, with a salt that is thrown away after the day:
  /// nobody can be followed from one day to the next, and so who comes on two days counts twice.
  [[nodiscard]] Result<void> add_web_visitors(Time now, const std::string& mode,
                                              const std::set<std::string>& addresses);
  [[nodiscard]] Result<void> add_attendance(Time now, const std::string& mode, const std::vector<Attendance>& stops);
  /// By tour and stop, the oldest first. @param from  the first day; empty: all
  [[nodiscard]] Result<std::vector<AttendanceOfDay>> attendance(const std::string& from);
  /// Whether this gateway is the one that counts the robot; it is for the next 30 s.
  /// @param gateway  a name of its own
  [[nodiscard]] Result<bool> may_count_robot(const std::string& gateway, Time now);
  /// By day and mode. @param from  the first day; empty: all
  [[nodiscard]] Result<std::vector<DayCount>> days(const std::string& from);

 private:
  explicit Statistics(Database& database) : database_{database} {}
  [[nodiscard]] Result<std::string> salt_of(const std::string& day);

  Database& database_;
};

/// 2026-11-25, UTC.
[[nodiscard]] std::string day_of(Time time);

}  // namespace docent::telepresence
