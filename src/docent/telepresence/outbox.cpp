#include "docent/telepresence/outbox.h"

#include "docent/messages/conversions.h"
#include "docent/telepresence/store/migrations.h"

namespace docent::telepresence {
namespace {

constexpr Migration kTables[] = {
    {"outbox",
     // Older files have it already.
     "CREATE TABLE IF NOT EXISTS outbox (id TEXT PRIMARY KEY, created BIGINT NOT NULL, source TEXT NOT NULL,"
     " visitor TEXT NOT NULL, kind TEXT NOT NULL, target TEXT NOT NULL, viewpoint BIGINT NOT NULL,"
     " language TEXT NOT NULL, delivered BIGINT NOT NULL DEFAULT 0)"},
};

}  // namespace

Result<std::unique_ptr<Outbox>> Outbox::open(Database& database) {
  if (auto made = migrate(database, "outbox", kTables); !made) return tl::unexpected<Error>(made.error());
  return std::unique_ptr<Outbox>{new Outbox{database}};
}

Result<std::vector<docent_msgs::Request>> Outbox::pending() {
  auto answer = database_.run(
      "SELECT id, created, source, visitor, kind, target, viewpoint, language FROM outbox"
      " WHERE delivered = 0 ORDER BY created, id");
  if (!answer) return tl::unexpected<Error>(answer.error());
  std::vector<docent_msgs::Request> pending;
  for (const Row& row : answer->rows) {
    pending.push_back({row.text(0), to_message(Time{row.number(1)}), row.text(2), row.text(3), row.text(4), row.text(5),
                       static_cast<std::int32_t>(row.number(6)), row.text(7)});
  }
  return pending;
}

Result<bool> Outbox::put(const docent_msgs::Request& request) {
  auto stored = database_.run(
      "INSERT INTO outbox (id, created, source, visitor, kind, target, viewpoint, language)"
      " VALUES ($1, $2, $3, $4, $5, $6, $7, $8) ON CONFLICT (id) DO NOTHING",
      {request.id, from_message(request.stamp).nanoseconds, request.source, request.visitor, request.kind,
       request.target, std::int64_t{request.viewpoint}, request.language});
  if (!stored) return fail("the request could not be stored: " + stored.error().message);
  return stored->changed == 1;
}

Result<void> Outbox::delivered(const std::string& id) {
  return done(database_.run("UPDATE outbox SET delivered = 1 WHERE id = $1", {id}));
}

Result<void> Outbox::forget_before(Time time) {
  return done(database_.run("DELETE FROM outbox WHERE created < $1", {time.nanoseconds}));
}

}  // namespace docent::telepresence
