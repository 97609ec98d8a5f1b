#include "docent/telepresence/store/migrations.h"

#include <string>

namespace docent::telepresence {

namespace {

Result<void> bring_forward(Database& database, const std::string& part, std::span<const Migration> migrations) {
  // Whoever comes second waits here: the row of the part is written first, and so locked, in each transaction.
  auto made = database.run_script("CREATE TABLE IF NOT EXISTS parts (name TEXT PRIMARY KEY, version BIGINT NOT NULL)");
  const auto found = database.run("SELECT version FROM parts WHERE name = $1", {part});
  if (!made && !found) return made;  // else another program made it at the same moment
  // What is as it should be is not written: the disk may be full.
  if (found && !found->rows.empty() && found->rows.at(0).number(0) == static_cast<std::int64_t>(migrations.size()))
    return {};
  for (std::size_t step = 0; step < migrations.size(); ++step) {
    auto done = database.in_transaction([&]() -> Result<void> {
      auto begun = database.run(
          "INSERT INTO parts (name, version) VALUES ($1, 0) ON CONFLICT (name) DO UPDATE SET version = parts.version",
          {part});
      if (!begun) return tl::unexpected<Error>(begun.error());
      auto version = database.run("SELECT version FROM parts WHERE name = $1", {part});
      if (!version) return tl::unexpected<Error>(version.error());
      const auto at = static_cast<std::size_t>(version->rows.at(0).number(0));
      if (at > migrations.size())
        return fail("the tables of '" + part + "' have version " + std::to_string(at) + ", of a newer program");
      if (at > step) return {};
      if (auto ran = database.run_script(migrations[step].statements); !ran)
        return fail(std::string{migrations[step].name} + ": " + ran.error().message);
      auto noted =
          database.run("UPDATE parts SET version = $2 WHERE name = $1", {part, static_cast<std::int64_t>(step + 1)});
      if (!noted) return tl::unexpected<Error>(noted.error());
      return {};
    });
    if (!done) return done;
  }
  return {};
}

}  // namespace

Result<void> migrate(Database& database, const std::string& part, std::span<const Migration> migrations) {
  auto done = bring_forward(database, part, migrations);
  if (done) return done;
  const bool waits =
      database.put_off([&database, part, migrations] { return bring_forward(database, part, migrations); });
  return waits ? Result<void>{} : done;
}

}  // namespace docent::telepresence
