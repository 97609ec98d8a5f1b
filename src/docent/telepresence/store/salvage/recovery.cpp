#include "docent/telepresence/store/salvage/recovery.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "docent/telepresence/store/salvage/page_images.h"
#include "docent/telepresence/store/salvage/private_files.h"
#include "docent/telepresence/store/salvage/salvage.h"
#include "docent/telepresence/store/salvage/statement.h"
#include "docent/telepresence/store/salvage/table_copy.h"

namespace docent::telepresence {
namespace {

namespace fs = std::filesystem;

using Connection = std::unique_ptr<sqlite3, int (*)(sqlite3*)>;

/// Of these nothing is taken from a backup.
constexpr const char* kPassing[] = {"outbox", "sessions"};

Connection open(const fs::path& file, int flags) {
  sqlite3* opened = nullptr;
  const int status = sqlite3_open_v2(file.c_str(), &opened, flags, nullptr);
  Connection connection{opened, &sqlite3_close};
  if (status != SQLITE_OK) connection.reset();
  return connection;
}

bool execute(sqlite3* database, const std::string& text) {
  return sqlite3_exec(database, text.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
}

std::vector<SchemaEntry> schema_of(const fs::path& backup) {
  std::vector<SchemaEntry> schema;
  const Connection from = backup.empty() ? Connection{nullptr, &sqlite3_close} : open(backup, SQLITE_OPEN_READONLY);
  if (!from) return schema;
  Statement rows{from.get(), "SELECT type, name, tbl_name, sql FROM sqlite_schema"};
  while (rows.step()) schema.push_back({rows.text(0), rows.text(1), rows.text(2), rows.text(3), 0});
  return schema;
}

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

/// One recovery, from its beginning to its end.
class Recovery {
 public:
  Recovery(const Remains& remains, sqlite3* to) : remains_{remains}, to_{to} {}

  Result<Recovered> run() {
    const PageImages images = read_pages(remains_.file, remains_.wal, remains_.is_cut);
    schema_ = salvage_schema(images);
    for (SchemaEntry& entry : schema_of(remains_.backup)) add_missing(std::move(entry));
    if (!execute(to_, "PRAGMA page_size = 4096; PRAGMA synchronous = OFF; BEGIN")) return failed();
    for (const SchemaEntry& entry : schema_)
      if (entry.type == "table" && !entry.name.starts_with("sqlite_")) make_table(entry);
    for (auto& [name, table] : salvage_rows(images, schema_, shapes_)) {
      done_.lost_pages += table.lost_pages;
      if (table.lost_pages > 0) damaged_.insert(name);
      if (auto filled = fill(name, table); !filled) return tl::unexpected<Error>(filled.error());
    }
    add_accounts();
    // An index that cannot be made would be one whose table has what it must not have; the rows are worth more.
    for (const SchemaEntry& entry : schema_)
      if (entry.type == "index" && !entry.sql.empty()) (void)execute(to_, entry.sql);
    if (!execute(to_, "COMMIT")) return failed();
    add_from_backup();
    return done_;
  }

 private:
  tl::unexpected<Error> failed() const {
    return fail(sqlite3_errcode(to_) == SQLITE_FULL ? std::string{"the disk is full"} : sqlite3_errmsg(to_));
  }

  void add_missing(SchemaEntry entry) {
    const auto same = std::find_if(schema_.begin(), schema_.end(),
                                   [&](const SchemaEntry& known) { return known.name == entry.name; });
    if (same == schema_.end()) {
      schema_.push_back(std::move(entry));
    } else {
      backup_sql_[entry.name] = entry.sql;
    }
  }

  void make_table(const SchemaEntry& entry) {
    bool is_made = execute(to_, entry.sql);
    if (const auto other = backup_sql_.find(entry.name); !is_made && other != backup_sql_.end())
      is_made = execute(to_, other->second);
    if (!is_made) return;
    TableShape shape;
    Statement columns{to_, "PRAGMA table_info(" + quoted(entry.name) + ")"};
    while (columns.step())
      shape.columns.push_back({columns.text(1), columns.text(2), columns.value(3) == Value{std::int64_t{0}}});
    if (!shape.columns.empty()) shapes_[entry.name] = std::move(shape);
  }

  Result<void> fill(const std::string& name, const SalvagedTable& table) {
    const auto& columns = shapes_.at(name).columns;
    std::map<std::pair<std::size_t, bool>, std::unique_ptr<Statement>>
        statements;  // rows of older versions are shorter
    const auto put = [&](const SalvagedRow& row, bool has_id) {
      auto& insert = statements[{row.values.size(), has_id}];
      if (!insert) {
        std::string names = has_id ? "rowid" : "", marks = has_id ? "?" : "";
        for (std::size_t i = 0; i < row.values.size(); ++i) {
          names += (names.empty() ? "" : ", ") + quoted(columns[i].name);
          marks += marks.empty() ? "?" : ", ?";
        }
        insert = std::make_unique<Statement>(
            to_, "INSERT OR IGNORE INTO " + quoted(name) + " (" + names + ") VALUES (" + marks + ")");
      }
      std::vector<Value> arguments;
      if (has_id) arguments.emplace_back(row.id);
      arguments.insert(arguments.end(), row.values.begin(), row.values.end());
      const bool is_put = insert->is_good() && insert->run(arguments);
      if (is_put) done_.rows += static_cast<std::size_t>(sqlite3_changes(to_));
      return is_put;
    };
    // The newest first: of two with the same key it stays.
    for (auto row = table.rows.rbegin(); row != table.rows.rend(); ++row)
      if (!put(row->second, true)) return failed();
    for (const SalvagedRow& row : table.others)
      if (!put(row, false)) return failed();
    return {};
  }

  void add_accounts() {
    const auto copy = TableCopy::read(remains_.copy);
    if (!copy) return;
    if (!shapes_.contains(TableCopy::kTable)) {
      // As the program makes it; what a later version has more it adds itself.
      std::string columns;
      for (const std::string& column : copy->columns)
        columns += (columns.empty() ? "" : ", ") + quoted(column) + (column == "created" ? " BIGINT" : " TEXT") +
                   (columns.empty() ? " PRIMARY KEY" : " NOT NULL");
      (void)execute(to_, std::string{"CREATE TABLE "} + TableCopy::kTable + " (" + columns + ")");
    }
    done_.from_copy = copy->restore(to_);
  }

  void add_from_backup() {
    if (remains_.backup.empty() || damaged_.empty()) return;
    Statement attach{to_, "ATTACH ? AS backup"};
    if (!attach.is_good() || !attach.run({remains_.backup.string()})) return;
    for (const std::string& name : damaged_) {
      const bool is_passing = std::find(std::begin(kPassing), std::end(kPassing), name) != std::end(kPassing);
      const bool has_copy = name == TableCopy::kTable && TableCopy::read(remains_.copy);
      if (is_passing || has_copy) continue;
      std::set<std::string> theirs;
      Statement columns{to_, "PRAGMA backup.table_info(" + quoted(name) + ")"};
      while (columns.step()) theirs.insert(columns.text(1));
      std::string names;
      for (const auto& column : shapes_.at(name).columns)
        if (theirs.contains(column.name)) names += (names.empty() ? "" : ", ") + quoted(column.name);
      const int before = sqlite3_total_changes(to_);
      if (!names.empty())
        (void)execute(to_, "INSERT OR IGNORE INTO main." + quoted(name) + " (" + names + ") SELECT " + names +
                               " FROM backup." + quoted(name));
      done_.from_backup += static_cast<std::size_t>(sqlite3_total_changes(to_) - before);
    }
    (void)execute(to_, "DETACH backup");
  }

  const Remains& remains_;
  sqlite3* to_;
  std::vector<SchemaEntry> schema_;
  std::map<std::string, std::string> backup_sql_;
  std::map<std::string, TableShape> shapes_;
  std::set<std::string> damaged_;
  Recovered done_;
};

std::string integrity_of(sqlite3* database) {
  Statement check{database, "PRAGMA integrity_check(5)"};
  std::string faults;
  while (check.step())
    if (const std::string line = check.text(0); line != "ok") faults += (faults.empty() ? "" : "; ") + line;
  if (!check.is_good()) return faults.empty() ? std::string{sqlite3_errmsg(database)} : faults;
  return faults;
}

}  // namespace

std::string Recovered::text() const {
  std::string said = std::to_string(rows) + " rows recovered";
  if (lost_pages > 0) said += ", " + std::to_string(lost_pages) + " pages lost";
  if (from_backup > 0) said += ", " + std::to_string(from_backup) + " rows from the newest backup";
  if (from_copy > 0) said += ", " + std::to_string(from_copy) + " accounts from their copy";
  return said;
}

Result<Recovered> recover(const Remains& remains, const fs::path& to) {
  const fs::path part = to.string() + ".part";
  for (const char* end : {"", "-journal", "-wal", "-shm"}) ::unlink((part.string() + end).c_str());
  const int made = ::open(part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (made < 0) return fail(to.string() + ": cannot be made");
  ::close(made);
  make_private(part);
  Result<Recovered> done = fail(to.string() + ": cannot be made");
  if (const Connection connection = open(part, SQLITE_OPEN_READWRITE)) {
    done = Recovery{remains, connection.get()}.run();
    if (const std::string fault = done ? integrity_of(connection.get()) : ""; !fault.empty()) done = fail(fault);
  }
  if (done) {
    auto kept = sync_to_disk(part);
    if (kept) kept = rename_for_good(part, to);
    if (!kept) done = tl::unexpected<Error>(kept.error());
  }
  if (!done) {
    for (const char* end : {"", "-journal"}) ::unlink((part.string() + end).c_str());
  }
  return done;
}

std::string fault_of_database(const fs::path& file) {
  const Connection connection = open(file, SQLITE_OPEN_READONLY);
  if (!connection) return "cannot be opened";
  sqlite3_busy_timeout(connection.get(), 2000);
  sqlite3_db_config(connection.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  return integrity_of(connection.get());
}

}  // namespace docent::telepresence
