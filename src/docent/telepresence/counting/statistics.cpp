#include "docent/telepresence/counting/statistics.h"

#include <array>
#include <ctime>

#include "docent/telepresence/accounts/secrets.h"
#include "docent/telepresence/store/migrations.h"

namespace docent::telepresence {
namespace {

constexpr Migration kTables[] = {
    {"statistics",
     "CREATE TABLE day_counts (day TEXT NOT NULL, mode TEXT NOT NULL, what TEXT NOT NULL,"
     " amount DOUBLE PRECISION NOT NULL, PRIMARY KEY (day, mode, what));"
     "CREATE TABLE web_visitors (day TEXT NOT NULL, mode TEXT NOT NULL, hash TEXT NOT NULL,"
     " PRIMARY KEY (day, hash));"
     "CREATE TABLE day_salts (day TEXT PRIMARY KEY, salt TEXT NOT NULL);"
     "CREATE TABLE robot_counter (one BIGINT PRIMARY KEY, gateway TEXT NOT NULL, ends BIGINT NOT NULL)"},
    {"attendance",
     "CREATE TABLE attendance (tour_began BIGINT NOT NULL, stop BIGINT NOT NULL, day TEXT NOT NULL,"
     " mode TEXT NOT NULL, tour TEXT NOT NULL, exhibit TEXT NOT NULL, people BIGINT NOT NULL,"
     " PRIMARY KEY (tour_began, stop))"},
};

}  // namespace

Counted counted_of(PollQuestion question, PollAnswer answer) {
  const auto from = [&](Counted first, PollAnswer least) {
    return static_cast<Counted>(static_cast<int>(first) + static_cast<int>(answer) - static_cast<int>(least));
  };
  switch (question) {
    case PollQuestion::liked:
      return from(Counted::liked_yes, PollAnswer::yes);
    case PollQuestion::satisfied:
      return from(Counted::satisfied_yes, PollAnswer::yes);
    case PollQuestion::price:
      return from(Counted::price_yes, PollAnswer::yes);
    case PollQuestion::intelligence:
      break;
  }
  return from(Counted::human, PollAnswer::human);
}

std::string day_of(Time time) {
  const auto whole = static_cast<std::time_t>(time.nanoseconds / 1'000'000'000);
  std::tm parts{};
  ::gmtime_r(&whole, &parts);
  std::array<char, 16> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d", &parts)};
}

Result<std::unique_ptr<Statistics>> Statistics::open(Database& database) {
  if (auto made = migrate(database, "statistics", kTables); !made) return tl::unexpected<Error>(made.error());
  return std::unique_ptr<Statistics>{new Statistics{database}};
}

Result<void> Statistics::add(Time now, const std::string& mode, const Counts& counts) {
  if (counts.empty()) return {};
  return database_.in_transaction([&]() -> Result<void> {
    for (const auto& [what, amount] : counts) {
      const char* newer = what == Counted::max_speed
                              ? "CASE WHEN excluded.amount > day_counts.amount THEN excluded.amount ELSE "
                                "day_counts.amount END"
                              : "day_counts.amount + excluded.amount";
      auto added = database_.run(std::string{"INSERT INTO day_counts (day, mode, what, amount) VALUES ($1, $2, $3, $4)"
                                             " ON CONFLICT (day, mode, what) DO UPDATE SET amount = "} +
                                     newer,
                                 {day_of(now), mode, to_text(what), amount});
      if (!added) return done(added);
    }
    return {};
  });
}

Result<std::string> Statistics::salt_of(const std::string& day) {
  auto made = database_.run("INSERT INTO day_salts (day, salt) VALUES ($1, $2) ON CONFLICT (day) DO NOTHING",
                            {day, make_token()});
  if (!made) return tl::unexpected<Error>(made.error());
  if (made->changed > 0) {
    auto thrown_away = database_.run("DELETE FROM day_salts WHERE day < $1", {day});
    if (!thrown_away) return tl::unexpected<Error>(thrown_away.error());
  }
  auto salt = database_.run("SELECT salt FROM day_salts WHERE day = $1", {day});
  if (!salt) return tl::unexpected<Error>(salt.error());
  return salt->rows.empty() ? Result<std::string>{fail("the day's salt is gone")} : salt->rows[0].text(0);
}

Result<void> Statistics::add_web_visitors(Time now, const std::string& mode, const std::set<std::string>& addresses) {
  if (addresses.empty()) return {};
  return database_.in_transaction([&]() -> Result<void> {
    const std::string day = day_of(now);
    auto salt = salt_of(day);
    if (!salt) return tl::unexpected<Error>(salt.error());
    for (const std::string& address : addresses) {
      auto added = database_.run(
          "INSERT INTO web_visitors (day, mode, hash) VALUES ($1, $2, $3) ON CONFLICT (day, hash) DO NOTHING",
          {day, mode, hash_token(*salt + address)});
      if (!added) return done(added);
    }
    return {};
  });
}

Result<void> Statistics::add_attendance(Time now, const std::string& mode, const std::vector<Attendance>& stops) {
  return database_.in_transaction([&]() -> Result<void> {
    for (const Attendance& one : stops) {
      auto added = database_.run(
          "INSERT INTO attendance (tour_began, stop, day, mode, tour, exhibit, people)"
          " VALUES ($1, $2, $3, $4, $5, $6, $7) ON CONFLICT (tour_began, stop) DO NOTHING",
          {one.tour_began.nanoseconds, one.stop, day_of(now), mode, one.tour, one.exhibit, one.people});
      if (!added) return done(added);
    }
    return {};
  });
}

Result<std::vector<AttendanceOfDay>> Statistics::attendance(const std::string& from) {
  auto rows = database_.run(
      "SELECT day, mode, tour_began, stop, tour, exhibit, people FROM attendance WHERE day >= $1"
      " ORDER BY tour_began, stop",
      {from});
  if (!rows) return tl::unexpected<Error>(rows.error());
  std::vector<AttendanceOfDay> list;
  for (const Row& row : rows->rows)
    list.push_back({row.text(0),
                    row.text(1),
                    {Time{row.number(2)}, static_cast<int>(row.number(3)), row.text(4), row.text(5),
                     static_cast<int>(row.number(6))}});
  return list;
}

Result<bool> Statistics::may_count_robot(const std::string& gateway, Time now) {
  auto taken = database_.run(
      "INSERT INTO robot_counter (one, gateway, ends) VALUES (1, $1, $2) ON CONFLICT (one) DO UPDATE SET"
      " gateway = excluded.gateway, ends = excluded.ends WHERE robot_counter.gateway = excluded.gateway"
      " OR robot_counter.ends < $3",
      {gateway, (now + std::chrono::seconds{30}).nanoseconds, now.nanoseconds});
  if (!taken) return tl::unexpected<Error>(taken.error());
  return taken->changed > 0;
}

Result<std::vector<DayCount>> Statistics::days(const std::string& from) {
  auto counts =
      database_.run("SELECT day, mode, what, amount FROM day_counts WHERE day >= $1 ORDER BY day, mode", {from});
  if (!counts) return tl::unexpected<Error>(counts.error());
  auto visitors = database_.run(
      "SELECT day, mode, count(*) FROM web_visitors WHERE day >= $1 GROUP BY day, mode ORDER BY day, mode", {from});
  if (!visitors) return tl::unexpected<Error>(visitors.error());
  std::map<std::pair<std::string, std::string>, DayCount> days;
  const auto of = [&](const Row& row) -> DayCount& {
    DayCount& day = days[{row.text(0), row.text(1)}];
    day.day = row.text(0);
    day.mode = row.text(1);
    return day;
  };
  for (const Row& row : counts->rows)
    if (const auto what = parse<Counted>(row.text(2))) of(row).counts[*what] = row.real(3);
  for (const Row& row : visitors->rows) of(row).web_visitors = row.number(2);
  std::vector<DayCount> list;
  for (auto& [key, day] : days) list.push_back(std::move(day));
  return list;
}

}  // namespace docent::telepresence
