#include "docent/telepresence/api/audit.h"

#include "docent/telepresence/accounts/secrets.h"
#include "docent/telepresence/store/migrations.h"

namespace docent::telepresence {
namespace {

constexpr Migration kTables[] = {
    {"audit log",
     "CREATE TABLE audit (id TEXT PRIMARY KEY, time BIGINT NOT NULL, who TEXT NOT NULL, what TEXT NOT NULL,"
     " about TEXT NOT NULL, address TEXT NOT NULL);"
     "CREATE INDEX audit_by_time ON audit (time)"},
};

}  // namespace

Result<std::unique_ptr<Audit>> Audit::open(Database& database) {
  if (auto made = migrate(database, "audit", kTables); !made) return tl::unexpected<Error>(made.error());
  return std::unique_ptr<Audit>{new Audit{database}};
}

Result<void> Audit::add(const AuditEntry& entry) {
  auto added = database_.run("INSERT INTO audit (id, time, who, what, about, address) VALUES ($1, $2, $3, $4, $5, $6)",
                             {make_token(), entry.time.nanoseconds, entry.who, entry.what, entry.about, entry.address});
  if (!added) return tl::unexpected<Error>(added.error());
  return {};
}

Result<std::vector<AuditEntry>> Audit::newest(int most) {
  auto rows = database_.run("SELECT time, who, what, about, address FROM audit ORDER BY time DESC LIMIT $1",
                            {std::int64_t{most}});
  if (!rows) return tl::unexpected<Error>(rows.error());
  std::vector<AuditEntry> entries;
  for (const Row& row : rows->rows)
    entries.push_back({Time{row.number(0)}, row.text(1), row.text(2), row.text(3), row.text(4)});
  return entries;
}

void Audit::forget_before(Time time) {
  // Should it fail, the table only stays larger until the next time.
  (void)database_.run("DELETE FROM audit WHERE time < $1", {time.nanoseconds});
}

}  // namespace docent::telepresence
