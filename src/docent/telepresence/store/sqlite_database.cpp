#include "docent/telepresence/store/sqlite_database.h"

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "docent/base/files.h"
#include "docent/telepresence/store/busy_wait.h"
#include "docent/telepresence/store/open_files.h"
#include "docent/telepresence/store/read_only_copy.h"
#include "docent/telepresence/store/salvage/private_files.h"
#include "docent/telepresence/store/salvage/recovery.h"
#include "docent/telepresence/store/salvage/table_copy.h"
#include "docent/telepresence/store/sqlite_files.h"
#include "docent/telepresence/store/store_lock.h"

namespace docent::telepresence {
namespace {

namespace fs = std::filesystem;
using Part = StoreLock::Part;
using Kind = StoreLock::Kind;

constexpr int kPatience = 2000;               ///< [ms] for another program that reads the file
constexpr std::int64_t kNoticeLasts = 86400;  ///< [s]
constexpr std::int64_t kMendingPeriod = 2;    ///< [s] between two tries
constexpr const char* kDiskFull = "the disk is full";

/// Releases what was waited for.
class Held {
 public:
  Held(const StoreLock& lock, Part part, Kind kind) : lock_{lock}, part_{part} { lock_.wait_for(part, kind); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() { lock_.release(part_); }

 private:
  const StoreLock& lock_;
  Part part_;
};

void bind_value(SQLite::Statement& query, const std::string& name, const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    query.bind(name, *whole);
  } else if (const auto* real = std::get_if<double>(&value)) {
    query.bind(name, *real);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    query.bind(name, *text);
  } else {
    query.bind(name);
  }
}

std::vector<Value> values_of(SQLite::Statement& query) {
  std::vector<Value> values;
  for (int i = 0; i < query.getColumnCount(); ++i) {
    const SQLite::Column column = query.getColumn(i);
    if (column.isInteger()) {
      values.emplace_back(static_cast<std::int64_t>(column.getInt64()));
    } else if (column.isFloat()) {
      values.emplace_back(column.getDouble());
    } else if (column.isNull()) {
      values.emplace_back(std::monostate{});
    } else {
      values.emplace_back(column.getString());
    }
  }
  return values;
}

class SqliteDatabase final : public Database {
 public:
  explicit SqliteDatabase(const std::string& path) : files_{path}, is_in_memory_{path == ":memory:"} {}
  ~SqliteDatabase() override { close(); }

  Result<void> open() {
    if (is_in_memory_) return connect();
    auto lock = StoreLock::open(files_.file());
    if (!lock) return tl::unexpected<Error>(lock.error());
    lock_.emplace(std::move(*lock));
    const Held held{*lock_, Part::files, Kind::alone};
    const bool is_alone = lock_->try_for(Part::use, Kind::alone);
    if (!is_alone && !FileMark::of(files_.file()))
      return fail(files_.file().string() + " is gone: the program that has it open makes it anew in ten seconds");
    auto opened = is_alone ? open_alone() : connect();
    if (opened) lock_->wait_for(Part::use, Kind::shared);
    if (!opened) lock_->release(Part::use);
    return opened;
  }

  [[nodiscard]] Result<QueryResult> run(const std::string& statement, const std::vector<Value>& arguments) override {
    if (auto ready = make_ready(); !ready) return tl::unexpected<Error>(ready.error());
    QueryResult answer;
    auto done = commit([&] {
      SQLite::Statement query{*connection_, statement};
      for (std::size_t i = 0; i < arguments.size(); ++i) bind_value(query, "$" + std::to_string(i + 1), arguments[i]);
      const int before = connection_->getTotalChanges();
      while (query.executeStep()) answer.rows.emplace_back(values_of(query));
      answer.changed = connection_->getTotalChanges() - before;
    });
    if (!done) return tl::unexpected<Error>(done.error());
    return answer;
  }
  [[nodiscard]] Result<void> run_script(const std::string& statements) override {
    if (auto ready = make_ready(); !ready) return ready;
    return commit([&] { connection_->exec(statements); });
  }
  [[nodiscard]] bool is_gone() const override { return is_gone_; }
  [[nodiscard]] std::string notice() const override {
    const std::scoped_lock guard{notice_mutex_};
    return seconds_now() - said_at_ < kNoticeLasts ? said_ : "";
  }
  [[nodiscard]] Result<void> look() override {
    if (is_in_memory_ || is_copy_ || !connection_) return make_ready();
    if (fault_.empty()) fault_ = open_files_->look(files_);
    if (fault_.empty() && !begins_well(connection_->getHandle())) fault_ = "the file does not begin as a database";
    return make_ready();
  }
  [[nodiscard]] Result<void> copy_to(const fs::path& file) override {
    if (auto ready = make_ready(); !ready) return ready;
    try {
      const int made = ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
      if (made < 0) return fail(file.string() + ": cannot be made");
      ::close(made);
      make_private(file);
      SQLite::Database to{file.string(), SQLite::OPEN_READWRITE};
      SQLite::Backup backup{to, *connection_};
      if (backup.executeStep(-1) != SQLITE_DONE) return fail(file.string() + ": others write without end");
      to.exec("PRAGMA journal_mode = DELETE");  // one file, and nothing beside it
    } catch (const SQLite::Exception& why) {
      return failed(why);
    }
    if (const std::string fault = fault_of_database(file); !fault.empty()) {
      fault_ = "damaged";  // it is mended at the next look
      return fail(files_.file().string() + ": damaged: " + fault);
    }
    return sync_to_disk(file);
  }

 protected:
  // At once for writing: else two writers could both have read, and neither could go on.
  [[nodiscard]] const char* begin_statement() const override { return "BEGIN IMMEDIATE"; }

 private:
  /// Nobody else has it open: its files may be looked through, and mended.
  Result<void> open_alone() {
    files_.finish_mending();
    StoreLock::Note note = lock_->note();
    std::string why = files_.fault(note.is_open);
    if (!why.empty()) {
      if (auto mended = mend(files_.read(), why); !mended) return mended;
    }
    auto opened = connect();
    if (is_copy_) return opened;  // nothing can be mended now
    if (opened) why = damage();
    if (!opened && fault_.empty()) return opened;
    if (!opened) why = "damaged";
    if (!why.empty() && (!opened || why != kAccountsMended)) {
      disconnect(false);
      if (auto mended = mend(files_.read(), why); !mended) return mended;
      if (opened = connect(); !opened) return opened;
    }
    note = lock_->note();
    note.is_open = true;
    (void)lock_->write(note);
    take_notice();
    return {};
  }

  static constexpr const char* kAccountsMended = "an account was not as its copy has it, and is so now";

  /// What an open database has wrong, all of it read.
  std::string damage() {
    sqlite3* const database = connection_->getHandle();
    try {
      SQLite::Statement check{*connection_, "PRAGMA integrity_check(3)"};
      if (!check.executeStep() || check.getColumn(0).getString() != "ok") return "damaged";
    } catch (const SQLite::Exception&) {
      return "damaged";
    }
    const auto copy = TableCopy::read(files_.accounts());
    // Whoever was killed between the commit and its copy has damaged nothing.
    const auto next = TableCopy::read(files_.next_accounts());
    const bool is_newer = next && TableCopy::of(database) == next;
    const bool is_repaired = copy && !is_newer && copy->repair(database) > 0;
    const auto now = TableCopy::of(database);
    if (now && now != copy) (void)now->write(files_.accounts());
    ::unlink(files_.next_accounts().c_str());
    if (!is_repaired) return "";
    say(kAccountsMended);
    return kAccountsMended;
  }

  Result<void> connect() {
    try {
      if (!is_in_memory_) {
        const int made = ::open(files_.file().c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        if (made >= 0) ::close(made);
        if (made >= 0) make_private(files_.file());
      }
      connection_ = std::make_unique<SQLite::Database>(files_.file().string(),
                                                       SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kPatience);
      wait_for_others<kPatience>(connection_->getHandle());
      sqlite3_extended_result_codes(connection_->getHandle(), 0);
      connection_->exec("PRAGMA journal_mode = WAL");
      connection_->exec("PRAGMA synchronous = FULL");  // an acknowledgement must outlive a power cut
      connection_->exec("PRAGMA foreign_keys = ON");
      connection_->exec("SELECT count(*) FROM sqlite_schema");
    } catch (const SQLite::Exception& why) {
      auto said = failed(why);
      return connect_to_copy(why) ? Result<void>{} : said;
    }
    fault_.clear();
    is_copy_ = false;
    if (is_in_memory_) return {};
    files_.make_private();
    sqlite3_update_hook(connection_->getHandle(), &SqliteDatabase::see_change, this);
    open_files_ = OpenFiles::of(files_);
    take_notice();
    if (open_files_) return {};
    disconnect(false);
    return fail(files_.file().string() + ": its files are gone");
  }
  /// On a disk that takes nothing: what is there can be read.
  bool connect_to_copy(const SQLite::Exception& why) {
    if (is_in_memory_ || !connection_ || !is_of_full_disk(why, files_.file())) return disconnect(false), false;
    SqliteFiles::Bytes bytes = bytes_of(connection_->getHandle());
    bytes.wal = read_file(files_.wal()).value_or("");  // which nobody locks
    auto copy = read_only_copy(bytes);
    disconnect(false);
    if (!copy) return false;
    connection_ = std::move(*copy);
    is_copy_ = true;
    tried_at_ = seconds_now();
    fault_.clear();
    return true;
  }
  /// Perhaps the disk takes something again.
  void leave_copy() {
    const std::int64_t now = seconds_now();
    if (now >= tried_at_ && now - tried_at_ < kMendingPeriod) return;
    const Held held{*lock_, Part::files, Kind::alone};
    disconnect(false);
    (void)connect();
    if (is_copy_ || !connection_) return;
    StoreLock::Note note = lock_->note();
    note.is_open = true;
    (void)lock_->write(note);
  }
  /// @param checkpoints  what is in the WAL goes into the file, if nobody else has it open
  void disconnect(bool checkpoints) {
    if (connection_ && !checkpoints)
      sqlite3_db_config(connection_->getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    connection_.reset();
    open_files_.reset();
  }
  void close() {
    if (is_in_memory_ || !connection_ || !lock_) return;
    const bool is_well = fault_.empty() && open_files_ && open_files_->look(files_).empty();
    const Held held{*lock_, Part::files, Kind::alone};
    disconnect(is_well);
    lock_->release(Part::use);
    if (!is_well || !lock_->try_for(Part::use, Kind::alone)) return;
    StoreLock::Note note = lock_->note();
    note.is_open = false;
    (void)lock_->write(note);
  }

  [[nodiscard]] bool is_in_transaction() const { return sqlite3_get_autocommit(connection_->getHandle()) == 0; }

  /// Before anything is done: the files are those that were opened, or are mended.
  Result<void> make_ready() {
    if (is_in_memory_ || (connection_ && is_in_transaction())) return {};
    if (is_copy_) leave_copy();
    if (is_copy_ && connection_) return {};
    if (connection_ && fault_.empty()) {
      fault_ = open_files_->look(files_);
      if (fault_.empty()) return {};
    }
    const std::int64_t now = seconds_now();
    if (now - tried_at_ >= 0 && now - tried_at_ < kMendingPeriod && !why_not_mended_.empty())
      return fail(why_not_mended_);
    tried_at_ = now;
    auto mended = mend_open();
    why_not_mended_ = mended ? "" : mended.error().message;
    return mended;
  }

  /// Others may have it open. Whoever comes first mends it; the others find what is new.
  Result<void> mend_open() {
    if (!connection_) return open();
    std::error_code ignored;
    if (const fs::path folder = files_.file().parent_path(); !folder.empty()) fs::create_directories(folder, ignored);
    auto lock = StoreLock::open(files_.file());  // the old one may be of a folder that is gone
    if (!lock) return tl::unexpected<Error>(lock.error());
    const Held held{*lock, Part::files, Kind::alone};
    const Held commits{*lock, Part::commit, Kind::alone};
    const StoreLock::Note note = lock->note();
    const auto is_mended = [&](const FileMark& mark) {
      return std::find(note.mended.begin(), note.mended.end(), mark) != note.mended.end();
    };
    const auto there = FileMark::of(files_.file());
    const bool is_done = there && open_files_ && *there != open_files_->file && is_mended(open_files_->file);
    if (!is_done) {
      if (auto mended = mend(bytes_of(connection_->getHandle()), fault_, &*lock); !mended) return mended;
    }
    disconnect(false);
    lock_.emplace(std::move(*lock));
    auto opened = connect();
    if (opened) lock_->wait_for(Part::use, Kind::shared);
    if (opened) {
      StoreLock::Note open_note = lock_->note();
      open_note.is_open = true;
      (void)lock_->write(open_note);
      (void)keep_accounts();
    }
    // `held` and `commits` are of this lock still.
    lock_->release(Part::commit);
    lock_->release(Part::files);
    return opened;
  }

  Result<void> mend(const SqliteFiles::Bytes& left, const std::string& why, const StoreLock* lock = nullptr) {
    if (lock == nullptr) lock = &*lock_;
    const auto note_it = [&]() -> Result<void> {
      StoreLock::Note note = lock->note();
      if (open_files_) note.mended.push_back(open_files_->file);
      return lock->write(note);
    };
    auto said = files_.mend(left, why, note_it);
    if (!said) return tl::unexpected<Error>(said.error());
    // The number of a file that is gone may be that of a new one.
    StoreLock::Note note = lock->note();
    if (const auto made = FileMark::of(files_.file())) std::erase(note.mended, *made);
    (void)lock->write(note);
    say(*said, lock);
    return {};
  }

  void say(const std::string& what, const StoreLock* lock = nullptr) {
    if (lock == nullptr) lock = &*lock_;
    StoreLock::Note note = lock->note();
    const std::int64_t before = note.said_at;
    note.said_at = seconds_now();
    const bool is_of_today = !note.said.empty() && note.said_at - before < kNoticeLasts;
    note.said = (is_of_today ? note.said + "; " : "") + date_and_time(note.said_at) + ", " + what;
    (void)lock->write(note);
    const std::scoped_lock guard{notice_mutex_};
    said_at_ = note.said_at;
    said_ = note.said;
  }
  void take_notice() {
    const StoreLock::Note note = lock_->note();
    const std::scoped_lock guard{notice_mutex_};
    if (note.said.empty() || note.said_at < said_at_) return;
    said_at_ = note.said_at;
    said_ = note.said;
  }

  static void see_change(void* self, int /*what*/, const char* /*database*/, const char* table, sqlite3_int64 /*id*/) {
    if (std::string_view{table} == TableCopy::kTable) static_cast<SqliteDatabase*>(self)->has_accounts_changed_ = true;
  }
  Result<void> keep_accounts() {
    has_accounts_changed_ = false;
    const auto now = TableCopy::of(connection_->getHandle());
    if (!now) return {};
    auto kept = now->write(files_.accounts());
    if (kept) ::unlink(files_.next_accounts().c_str());
    return kept;
  }

  /// What is committed counts when it is in the files that have the database's name.
  template <typename Work>
  Result<void> commit(const Work& work) {
    try {
      if (is_in_memory_ || is_copy_) {
        work();
        return {};
      }
      const bool was_in_transaction = is_in_transaction();
      const Held held{*lock_, Part::commit, Kind::shared};
      if (!was_in_transaction || has_begun_) fault_ = fault_.empty() ? open_files_->look(files_) : fault_;
      if (!fault_.empty()) {
        has_begun_ = false;
        if (was_in_transaction) connection_->exec("ROLLBACK");
        return fail(files_.file().string() + ": " + fault_);
      }
      if (was_in_transaction && has_accounts_changed_) {
        const auto next = TableCopy::of(connection_->getHandle());
        if (auto kept = next ? next->write(files_.next_accounts()) : Result<void>{}; !kept) return kept;
      }
      work();
      is_gone_ = false;
      has_begun_ = is_in_transaction();
      if (has_begun_) return {};
      fault_ = open_files_->look(files_);
      if (!fault_.empty()) return fail(files_.file().string() + ": " + fault_);
      return has_accounts_changed_ ? keep_accounts() : Result<void>{};
    } catch (const SQLite::Exception& why) {
      return failed(why);
    }
  }

  /// Another program that holds the file for the whole patience would do so again.
  [[nodiscard]] tl::unexpected<Error> failed(const SQLite::Exception& why) {
    const int code = why.getErrorCode() & 0xFF;
    is_gone_ = code == SQLITE_BUSY;
    const bool is_short = why.getExtendedErrorCode() == SQLITE_IOERR_SHORT_READ;
    if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB || is_short) fault_ = "damaged";
    const bool is_full = is_of_full_disk(why, files_.file()) || (is_copy_ && code == SQLITE_READONLY);
    return fail(files_.file().string() + ": " + (is_full ? kDiskFull : why.what()));
  }

  SqliteFiles files_;
  const bool is_in_memory_;
  bool is_copy_ = false;  ///< what is connected is a copy in memory, for the disk is full
  std::optional<StoreLock> lock_;
  std::unique_ptr<SQLite::Database> connection_;
  std::optional<OpenFiles> open_files_;
  std::string fault_;  ///< of the files that are open; empty: none is known
  bool is_gone_ = false;
  bool has_begun_ = false;  ///< a transaction
  bool has_accounts_changed_ = false;
  std::int64_t tried_at_ = 0;
  std::string why_not_mended_;
  mutable std::mutex notice_mutex_;  ///< of the two below
  std::int64_t said_at_ = 0;
  std::string said_;
};

}  // namespace

Result<std::unique_ptr<Database>> open_sqlite(const std::string& path) {
  auto database = std::make_unique<SqliteDatabase>(path);
  if (auto opened = database->open(); !opened)
    return fail(opened.error().message + (opened.error().message.starts_with(path) ? "" : ": " + path));
  return database;
}

}  // namespace docent::telepresence
