#include "docent/telepresence/accounts/accounts.h"

#include <algorithm>

#include "docent/telepresence/store/migrations.h"

namespace docent::telepresence {
namespace {

constexpr Migration kTables[] = {
    {"accounts",
     // A store that has lost all else has them from their copy.
     "CREATE TABLE IF NOT EXISTS accounts (name TEXT PRIMARY KEY, hash TEXT NOT NULL, rank TEXT NOT NULL, created "
     "BIGINT NOT NULL);"
     "CREATE TABLE sessions (token TEXT PRIMARY KEY, csrf TEXT NOT NULL, person TEXT NOT NULL, name TEXT NOT NULL,"
     " rank TEXT NOT NULL, address TEXT NOT NULL, expires BIGINT NOT NULL);"
     "CREATE INDEX sessions_of_person ON sessions (person);"
     "CREATE TABLE sent_away (person TEXT NOT NULL, address TEXT NOT NULL, ends BIGINT NOT NULL,"
     " PRIMARY KEY (person, address))"},
    {"places",
     "CREATE TABLE login_places (name TEXT NOT NULL, network TEXT NOT NULL, last BIGINT NOT NULL,"
     " PRIMARY KEY (name, network))"},
};

constexpr Duration kPlacesLast = std::chrono::hours{24 * 90};

std::string id_of(const std::string& account) { return "account:" + account; }

Result<void> check_password(const std::string& password) {
  if (password.size() < Accounts::kShortestPassword) return fail("a password must have at least 10 characters");
  if (password.size() > Accounts::kLongestPassword) return fail("a password must have at most 200 bytes");
  return {};
}

bool is_account_name(const std::string& name) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_-.";
  return !name.empty() && name.size() <= 40 && name.find_first_not_of(kLetters) == std::string::npos;
}

/// Of csrf, person, name, rank, address, expires. nullopt: its rank is of a newer program.
std::optional<Login> login_of(const Row& row, const std::string& token) {
  const auto rank = parse<Rank>(row.text(3));
  if (!rank) return std::nullopt;
  return Login{{row.text(1), row.text(2), *rank}, token, row.text(0), row.text(4), Time{row.number(5)}};
}

}  // namespace

Result<std::unique_ptr<Accounts>> Accounts::open(Database& database, const PasswordCost& cost) {
  if (auto made = migrate(database, "accounts", kTables); !made) return tl::unexpected<Error>(made.error());
  std::unique_ptr<Accounts> accounts{new Accounts{database, cost}};
  auto hash = hash_password(make_token(), cost);
  if (!hash) return tl::unexpected<Error>(hash.error());
  accounts->no_account_ = std::move(*hash);
  return accounts;
}

Result<void> Accounts::add(const std::string& name, const std::string& password, Rank rank, Time now) {
  if (!is_account_name(name)) return fail("a name has 1 to 40 of a-z, 0-9, '_', '-' and '.'");
  if (rank < Rank::moderator) return fail("only moderators and operators have accounts");
  if (auto fits = check_password(password); !fits) return fits;
  auto hash = hash_password(password, cost_);
  if (!hash) return tl::unexpected<Error>(hash.error());
  auto added = database_.run(
      "INSERT INTO accounts (name, hash, rank, created) VALUES ($1, $2, $3, $4) ON CONFLICT (name) DO NOTHING",
      {name, *hash, to_text(rank), now.nanoseconds});
  if (added && added->changed == 0) return fail("there is an account '" + name + "' already");
  return done(added);
}

Result<void> Accounts::set_password(const std::string& name, const std::string& password) {
  if (auto fits = check_password(password); !fits) return fits;
  auto hash = hash_password(password, cost_);
  if (!hash) return tl::unexpected<Error>(hash.error());
  return database_.in_transaction([&]() -> Result<void> {
    auto changed = database_.run("UPDATE accounts SET hash = $2 WHERE name = $1", {name, *hash});
    if (changed && changed->changed == 0) return fail("there is no account '" + name + "'");
    if (!changed) return done(changed);
    return done(database_.run("DELETE FROM sessions WHERE person = $1", {id_of(name)}));
  });
}

Result<void> Accounts::remove(const std::string& name) {
  return database_.in_transaction([&]() -> Result<void> {
    auto removed = database_.run("DELETE FROM accounts WHERE name = $1", {name});
    if (removed && removed->changed == 0) return fail("there is no account '" + name + "'");
    if (!removed) return done(removed);
    return done(database_.run("DELETE FROM sessions WHERE person = $1", {id_of(name)}));
  });
}

Result<std::vector<Account>> Accounts::list() {
  auto rows = database_.run("SELECT name, rank, created FROM accounts ORDER BY name");
  if (!rows) return tl::unexpected<Error>(rows.error());
  std::vector<Account> accounts;
  for (const Row& row : rows->rows)
    accounts.push_back({row.text(0), parse<Rank>(row.text(1)).value_or(Rank::viewer), Time{row.number(2)}});
  return accounts;
}

Result<bool> Accounts::has(const std::string& name) {
  auto rows = database_.run("SELECT 1 FROM accounts WHERE name = $1", {name});
  if (!rows) return tl::unexpected<Error>(rows.error());
  return !rows->rows.empty();
}

Result<std::optional<Person>> Accounts::check(const std::string& name, const std::string& password) {
  auto rows = database_.run("SELECT hash, rank FROM accounts WHERE name = $1", {name});
  if (!rows) return tl::unexpected<Error>(rows.error());
  const bool is_there = !rows->rows.empty();
  const bool fits = is_password(password, is_there ? rows->rows.front().text(0) : no_account_);
  if (!is_there || !fits) return std::nullopt;
  const auto rank = parse<Rank>(rows->rows.front().text(1));
  if (!rank) return std::nullopt;  // of a newer program
  return Person{id_of(name), name, *rank};
}

Result<Login> Accounts::begin(const Person& person, const std::string& address, double lifetime, Time now) {
  Login login{person, make_token(), make_token(), address, now + seconds(lifetime)};
  auto stored = database_.run(
      "INSERT INTO sessions (token, csrf, person, name, rank, address, expires) VALUES ($1, $2, $3, $4, $5, $6, $7)",
      {hash_token(login.token), login.csrf, person.id, person.name, to_text(person.rank), address,
       login.expires.nanoseconds});
  if (!stored) return tl::unexpected<Error>(stored.error());
  return login;
}

Result<std::optional<Login>> Accounts::find(const std::string& token, Time now) {
  auto rows = database_.run(
      "SELECT csrf, person, name, rank, address, expires FROM sessions WHERE token = $1 AND expires > $2 AND NOT EXISTS"
      " (SELECT 1 FROM sent_away WHERE sent_away.person = sessions.person AND ends > $2)",
      {hash_token(token), now.nanoseconds});
  if (!rows) return tl::unexpected<Error>(rows.error());
  if (rows->rows.empty()) return std::nullopt;
  return login_of(rows->rows.front(), token);
}

Result<std::map<std::string, Login>> Accounts::logins_of_accounts(Time now) {
  auto rows = database_.run(
      "SELECT csrf, person, name, rank, address, expires, token FROM sessions WHERE expires > $1"
      " AND person LIKE 'account:%'",
      {now.nanoseconds});
  if (!rows) return tl::unexpected<Error>(rows.error());
  std::map<std::string, Login> logins;
  for (const Row& row : rows->rows)
    if (auto login = login_of(row, "")) logins.emplace(row.text(6), std::move(*login));
  return logins;
}

Result<void> Accounts::remember(const Place& place, Time now) {
  return done(
      database_.run("INSERT INTO login_places (name, network, last) VALUES ($1, $2, $3)"
                    " ON CONFLICT (name, network) DO UPDATE SET last = excluded.last",
                    {place.name, place.network, now.nanoseconds}));
}

Result<std::vector<Accounts::Place>> Accounts::places() {
  auto rows = database_.run("SELECT name, network FROM login_places");
  if (!rows) return tl::unexpected<Error>(rows.error());
  std::vector<Place> places;
  for (const Row& row : rows->rows) places.push_back({row.text(0), row.text(1)});
  return places;
}

Result<void> Accounts::end(const std::string& token) {
  return done(database_.run("DELETE FROM sessions WHERE token = $1", {hash_token(token)}));
}

Result<void> Accounts::send_away(const std::string& person, Time until, Time now) {
  return database_.in_transaction([&]() -> Result<void> {
    auto noted = database_.run(
        "INSERT INTO sent_away (person, address, ends) SELECT DISTINCT person, address, $2 FROM sessions"
        " WHERE person = $1 AND expires > $3 ON CONFLICT (person, address) DO UPDATE SET ends = excluded.ends",
        {person, until.nanoseconds, now.nanoseconds});
    // Also where no session of theirs is left.
    if (noted) {
      noted = database_.run(
          "INSERT INTO sent_away (person, address, ends) VALUES ($1, '', $2)"
          " ON CONFLICT (person, address) DO UPDATE SET ends = excluded.ends",
          {person, until.nanoseconds});
    }
    if (noted) noted = database_.run("DELETE FROM sessions WHERE person = $1", {person});
    return done(noted);
  });
}

Result<bool> Accounts::is_sent_away(const std::string& address, Time now) {
  auto rows =
      database_.run("SELECT 1 FROM sent_away WHERE address = $1 AND ends > $2 LIMIT 1", {address, now.nanoseconds});
  if (!rows) return tl::unexpected<Error>(rows.error());
  return !rows->rows.empty();
}

void Accounts::forget_before(Time now) {
  // Should it fail, the tables only stay larger until the next time.
  (void)database_.run("DELETE FROM sessions WHERE expires < $1", {now.nanoseconds});
  (void)database_.run("DELETE FROM sent_away WHERE ends < $1", {now.nanoseconds});
  (void)database_.run("DELETE FROM login_places WHERE last < $1", {(now - kPlacesLast).nanoseconds});
}

}  // namespace docent::telepresence
