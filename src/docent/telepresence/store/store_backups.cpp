#include "docent/telepresence/store/store_backups.h"

#include <algorithm>
#include <ctime>
#include <system_error>

#include "docent/telepresence/store/database.h"
#include "docent/telepresence/store/salvage/private_files.h"
#include "docent/telepresence/store/salvage/recovery.h"
#include "docent/telepresence/store/sqlite_files.h"
#include "docent/telepresence/store/store_lock.h"

namespace docent::telepresence {
namespace {

namespace fs = std::filesystem;

constexpr fs::perms kForAll =
    fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read | fs::perms::others_read;

std::string day_of(std::int64_t seconds) {
  const std::time_t time = seconds;
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  char text[16];
  return {text, std::strftime(text, sizeof text, "%Y%m%d", &parts)};
}

bool is_day(const std::string& name) {
  return name.size() >= 8 && std::all_of(name.begin(), name.begin() + 8, [](char c) { return c >= '0' && c <= '9'; });
}

/// Files and folders, not links: what a museum's folder links to is not its own.
Result<void> copy_folder(const fs::path& from, const fs::path& to, bool is_private) {
  std::error_code code;
  fs::create_directories(to, code);
  if (is_private) make_private(to);
  for (fs::recursive_directory_iterator at{from, code}, end; !code && at != end; at.increment(code)) {
    const fs::path target = to / fs::relative(at->path(), from);
    if (at->is_symlink()) continue;
    if (at->is_directory()) {
      fs::create_directories(target, code);
      if (is_private) make_private(target);
    } else if (at->is_regular_file()) {
      fs::copy_file(at->path(), target, code);
      if (is_private) {
        make_private(target);
      } else {
        fs::permissions(target, kForAll, code);
      }
      if (auto kept = code ? Result<void>{} : sync_to_disk(target); !kept) return kept;
    }
  }
  if (code == std::errc::no_space_on_device) return fail("the disk is full");
  if (code) return fail(from.string() + ": cannot be copied: " + code.message());
  return {};
}

}  // namespace

std::vector<fs::path> StoreBackups::list() const {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder(), ignored))
    if (is_day(entry.path().filename().string())) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

bool StoreBackups::is_due(std::int64_t now_s) const {
  std::error_code ignored;
  return !fs::exists(folder() / day_of(now_s), ignored);
}

Result<void> StoreBackups::make_in(const fs::path& folder) const {
  std::error_code code;
  if (fs::exists(folder, code)) return fail(folder.string() + " is there already");
  const fs::path part = folder.parent_path() / ("." + folder.filename().string() + ".part");
  fs::remove_all(part, code);
  fs::create_directories(part, code);
  if (code) return fail(part.string() + ": cannot be made: " + code.message());
  make_private(part);
  Result<void> done;
  if (!Database::is_shared(database_)) {
    auto database = Database::open(database_);
    done = database ? (*database)->copy_to(part / fs::path{database_}.filename())
                    : Result<void>{tl::unexpected<Error>(database.error())};
  }
  if (done && !museum_.empty()) done = copy_folder(museum_, part / "museum", true);
  if (done) done = sync_to_disk(part);
  if (done) done = rename_for_good(part, folder);
  if (!done) fs::remove_all(part, code);
  return done;
}

Result<fs::path> StoreBackups::make(std::int64_t now_s) const {
  std::error_code ignored;
  fs::create_directories(folder(), ignored);
  make_private(folder());
  fs::path made = folder() / day_of(now_s);
  for (int i = 2; fs::exists(made, ignored); ++i) made = folder() / (day_of(now_s) + "-" + std::to_string(i));
  if (auto done = make_in(made); !done) return tl::unexpected<Error>(done.error());
  auto all = list();
  for (std::size_t i = 0; i + kKept < all.size(); ++i) fs::remove_all(all[i], ignored);
  return made;
}

Result<fs::path> StoreBackups::restore_database(const fs::path& backup, const fs::path& database) {
  std::error_code code;
  if (!fs::exists(backup, code)) return fail(backup.string() + " is not there");
  if (const std::string fault = fault_of_database(backup); !fault.empty())
    return fail(backup.string() + ": damaged: " + fault);
  fs::create_directories(database.parent_path(), code);
  auto lock = StoreLock::open(database);
  if (!lock) return tl::unexpected<Error>(lock.error());
  lock->wait_for(StoreLock::Part::files, StoreLock::Kind::alone);
  if (!lock->try_for(StoreLock::Part::use, StoreLock::Kind::alone))
    return fail(database.string() + " is open: end the robot that runs on it first");
  const fs::path part = database.string() + ".part";
  fs::copy_file(backup, part, fs::copy_options::overwrite_existing, code);
  if (code) {
    std::error_code ignored;
    fs::remove(part, ignored);
    return fail(part.string() + ": cannot be written: " + code.message());
  }
  make_private(part);
  if (auto kept = sync_to_disk(part); !kept) return tl::unexpected<Error>(kept.error());
  const SqliteFiles files{database};
  fs::path aside;
  if (fs::exists(database, code)) aside = dated_name(database, "replaced");
  // The accounts are those of the backup too; those that were there stay with their database.
  for (const char* end : {"-wal", "-shm", ".accounts", ".accounts.next", ""}) {
    const fs::path old = database.string() + end;
    if (!fs::exists(old, code)) continue;
    const fs::path kept = (aside.empty() ? dated_name(database, "replaced") : aside).string() + end;
    if (auto moved = rename_for_good(old, kept); !moved) return tl::unexpected<Error>(moved.error());
  }
  if (auto put = rename_for_good(part, database); !put) return tl::unexpected<Error>(put.error());
  if (auto noted = lock->write({}); !noted) return tl::unexpected<Error>(noted.error());
  return aside;
}

Result<fs::path> StoreBackups::restore_museum(const fs::path& backup, const fs::path& museum) {
  std::error_code code;
  if (!fs::exists(backup, code)) return fail(backup.string() + " is not there");
  const fs::path part = museum.string() + ".part";
  fs::remove_all(part, code);
  if (auto copied = copy_folder(backup, part, false); !copied) {
    fs::remove_all(part, code);
    return tl::unexpected<Error>(copied.error());
  }
  fs::path aside;
  if (fs::exists(museum, code)) {
    aside = dated_name(museum, "replaced");
    if (auto moved = rename_for_good(museum, aside); !moved) return tl::unexpected<Error>(moved.error());
  }
  if (auto put = rename_for_good(part, museum); !put) return tl::unexpected<Error>(put.error());
  return aside;
}

}  // namespace docent::telepresence
