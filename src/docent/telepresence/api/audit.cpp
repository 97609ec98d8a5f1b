#include "docent/telepresence/api/audit.h"

#include <atomic>
#include <charconv>
#include <cstdio>
#include <utility>

#include "docent/telepresence/accounts/secrets.h"
#include "docent/telepresence/store/migrations.h"

namespace docent::telepresence {
namespace {

constexpr Migration kTables[] = {
    {"audit log",
     "CREATE TABLE audit (id TEXT PRIMARY KEY, time BIGINT NOT NULL, who TEXT NOT NULL, what TEXT NOT NULL,"
     " about TEXT NOT NULL, address TEXT NOT NULL);"
     "CREATE INDEX audit_by_time ON audit (time)"},
    {"what is counted together, and searches",
     "ALTER TABLE audit ADD COLUMN times BIGINT NOT NULL DEFAULT 1;"
     "CREATE INDEX audit_by_who ON audit (who, time);"
     "CREATE INDEX audit_by_address ON audit (address, time)"},
};

constexpr std::size_t kPlaceLetters = 32;  ///< of an id, which order what happened at the same time
constexpr std::int64_t kHour = 3'600'000'000'000;

/// TIME-ID
std::optional<std::pair<std::int64_t, std::string>> parse_place(const std::string& text) {
  const auto dash = text.find('-');
  std::int64_t time = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (error != std::errc{} || dash == std::string::npos || end != text.data() + dash) return std::nullopt;
  return std::pair{time, text.substr(dash + 1)};
}

}  // namespace

Result<std::unique_ptr<Audit>> Audit::open(Database& database) {
  if (auto made = migrate(database, "audit", kTables); !made) return tl::unexpected<Error>(made.error());
  return std::unique_ptr<Audit>{new Audit{database}};
}

Result<void> Audit::add(const AuditEntry& entry) {
  static std::atomic<std::uint64_t> added{0};  // what came at the same time stands in the order of its coming
  char id[2 * kPlaceLetters];
  std::snprintf(id, sizeof id, "%016llx%s", static_cast<unsigned long long>(++added),
                make_token().substr(0, kPlaceLetters - 16).c_str());
  return done(
      database_.run("INSERT INTO audit (id, time, who, what, about, address) VALUES ($1, $2, $3, $4, $5, $6)",
                    {std::string{id}, entry.time.nanoseconds, entry.who, entry.what, entry.about, entry.address}));
}

Result<void> Audit::count(const AuditEntry& entry) {
  const std::string hour = std::to_string(entry.time.nanoseconds / kHour);
  const std::string id = hash_token(hour + "\n" + entry.what + "\n" + entry.who + "\n" + entry.address);
  return done(
      database_.run("INSERT INTO audit (id, time, who, what, about, address, times) VALUES ($1, $2, $3, $4, $5, $6, 1)"
                    " ON CONFLICT (id) DO UPDATE SET time = excluded.time, times = audit.times + 1",
                    {id, entry.time.nanoseconds, entry.who, entry.what, entry.about, entry.address}));
}

Result<std::vector<AuditEntry>> Audit::find(const AuditSearch& search) {
  const std::string place = "substr(id, 1, " + std::to_string(kPlaceLetters) + ")";
  std::string where;
  std::vector<Value> arguments;
  const auto argument = [&](Value value) {
    arguments.push_back(std::move(value));
    return "$" + std::to_string(arguments.size());
  };
  const auto want = [&](const std::string& condition) { where += (where.empty() ? " WHERE " : " AND ") + condition; };
  if (!search.account.empty())
    want("who IN (" + argument(search.account) + ", " + argument("account:" + search.account) + ")");
  if (!search.address.empty())
    want("substr(address, 1, " + std::to_string(search.address.size()) + ") = " + argument(search.address));
  if (search.from) want("time >= " + argument(search.from->nanoseconds));
  if (search.until) want("time < " + argument(search.until->nanoseconds));
  if (!search.before.empty()) {
    const auto place_of = parse_place(search.before);
    if (!place_of) return fail("that is no place in the log");
    const std::string then = argument(place_of->first);
    want("(time < " + then + " OR (time = " + then + " AND " + place + " < " + argument(place_of->second) + "))");
  }
  const std::string most = argument(std::int64_t{search.most});
  auto rows = database_.run("SELECT time, who, what, about, address, times, " + place + " FROM audit" + where +
                                " ORDER BY time DESC, " + place + " DESC LIMIT " + most,
                            arguments);
  if (!rows) return tl::unexpected<Error>(rows.error());
  std::vector<AuditEntry> entries;
  for (const Row& row : rows->rows)
    entries.push_back({Time{row.number(0)}, row.text(1), row.text(2), row.text(3), row.text(4), row.number(5),
                       std::to_string(row.number(0)) + "-" + row.text(6)});
  return entries;
}

bool Audit::is_place(const std::string& text) { return parse_place(text).has_value(); }

void Audit::forget(Time now) {
  // Should it fail, the table only stays larger until the next time.
  (void)database_.run("DELETE FROM audit WHERE time < $1", {(now - kLasts).nanoseconds});
}

}  // namespace docent::telepresence
