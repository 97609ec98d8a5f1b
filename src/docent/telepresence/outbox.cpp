#include "docent/telepresence/outbox.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <system_error>

#include "docent/messages/conversions.h"

namespace docent::telepresence {

struct Outbox::Database {
  explicit Database(const std::filesystem::path& path)
      : connection{path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, 2000} {
    connection.exec("PRAGMA journal_mode = WAL");
    connection.exec("PRAGMA synchronous = FULL");  // an acknowledgement must outlive a power cut
    connection.exec(
        "CREATE TABLE IF NOT EXISTS outbox (id TEXT PRIMARY KEY, created INTEGER NOT NULL, source TEXT NOT NULL,"
        " visitor TEXT NOT NULL, kind TEXT NOT NULL, target TEXT NOT NULL, viewpoint INTEGER NOT NULL,"
        " language TEXT NOT NULL, delivered INTEGER NOT NULL DEFAULT 0)");
    SQLite::Statement check{connection, "PRAGMA quick_check"};
    if (!check.executeStep() || check.getColumn(0).getString() != "ok") throw SQLite::Exception("damaged", 11);
  }
  SQLite::Database connection;
};

Outbox::Outbox(std::unique_ptr<Database> database) : database_{std::move(database)} {}
Outbox::~Outbox() = default;

Result<std::unique_ptr<Outbox>> Outbox::open(const std::filesystem::path& path) {
  constexpr int kCorrupt = 11;       // SQLITE_CORRUPT
  constexpr int kNotADatabase = 26;  // SQLITE_NOTADB
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      std::unique_ptr<Outbox> outbox{new Outbox{std::make_unique<Database>(path)}};
      outbox->was_damaged_ = attempt > 0;
      auto read = outbox->read_pending();
      if (!read) return tl::unexpected<Error>(read.error());
      return outbox;
    } catch (const SQLite::Exception& exception) {
      const bool is_damaged = exception.getErrorCode() == kCorrupt || exception.getErrorCode() == kNotADatabase;
      if (attempt > 0 || !is_damaged) return fail(path.string() + ": cannot be opened: " + exception.what());
      std::error_code ignored;
      for (const char* end : {"-wal", "-shm"}) std::filesystem::remove(path.string() + end, ignored);
      std::filesystem::rename(path, path.string() + ".damaged", ignored);
    }
  }
  return fail(path.string() + ": cannot be opened");
}

Result<void> Outbox::read_pending() {
  SQLite::Statement query{database_->connection,
                          "SELECT id, created, source, visitor, kind, target, viewpoint, language FROM outbox"
                          " WHERE delivered = 0 ORDER BY created, id"};
  while (query.executeStep()) {
    docent_msgs::Request request;
    request.id = query.getColumn(0).getString();
    request.stamp = to_message(Time{query.getColumn(1).getInt64()});
    request.source = query.getColumn(2).getString();
    request.visitor = query.getColumn(3).getString();
    request.kind = query.getColumn(4).getString();
    request.target = query.getColumn(5).getString();
    request.viewpoint = query.getColumn(6).getInt();
    request.language = query.getColumn(7).getString();
    pending_.push_back(std::move(request));
  }
  return {};
}

Result<void> Outbox::put(const docent_msgs::Request& request) {
  try {
    SQLite::Statement insert{database_->connection,
                             "INSERT OR IGNORE INTO outbox (id, created, source, visitor, kind, target, viewpoint,"
                             " language) VALUES (?, ?, ?, ?, ?, ?, ?, ?)"};
    insert.bind(1, request.id);
    insert.bind(2, from_message(request.stamp).nanoseconds);
    insert.bind(3, request.source);
    insert.bind(4, request.visitor);
    insert.bind(5, request.kind);
    insert.bind(6, request.target);
    insert.bind(7, request.viewpoint);
    insert.bind(8, request.language);
    if (insert.exec() == 1) pending_.push_back(request);
    return {};
  } catch (const SQLite::Exception& exception) {
    return fail(std::string{"the request could not be stored: "} + exception.what());
  }
}

void Outbox::delivered(const std::string& id) {
  const auto removed = std::erase_if(pending_, [&](const auto& request) { return request.id == id; });
  if (removed == 0) return;
  try {
    SQLite::Statement update{database_->connection, "UPDATE outbox SET delivered = 1 WHERE id = ?"};
    update.bind(1, id);
    update.exec();
  } catch (const SQLite::Exception&) {
    // It is then resent after a restart, and the board knows it already: harmless.
  }
}

void Outbox::forget_before(Time time) {
  std::erase_if(pending_, [&](const auto& request) { return from_message(request.stamp) < time; });
  try {
    SQLite::Statement remove{database_->connection, "DELETE FROM outbox WHERE created < ?"};
    remove.bind(1, time.nanoseconds);
    remove.exec();
  } catch (const SQLite::Exception&) {
    // The file only stays larger until the next time.
  }
}

}  // namespace docent::telepresence
