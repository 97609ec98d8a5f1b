#include "docent/telepresence/store/sqlite_files.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "docent/base/files.h"
#include "docent/telepresence/store/salvage/page_images.h"
#include "docent/telepresence/store/salvage/private_files.h"
#include "docent/telepresence/store/salvage/recovery.h"

namespace docent::telepresence {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

}  // namespace

fs::path SqliteFiles::newest_backup() const {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& day : fs::directory_iterator(backups(), ignored)) {
    const fs::path file = day.path() / file_.filename();
    if (day.path().filename().string().front() != '.' && is_there(file)) found.push_back(file);
  }
  return found.empty() ? fs::path{} : *std::max_element(found.begin(), found.end());
}

SqliteFiles::Bytes SqliteFiles::read() const { return {read_file(file_).value_or(""), read_file(wal()).value_or("")}; }

std::string SqliteFiles::fault(bool was_left_open) const {
  const bool was_there = was_left_open || is_there(accounts()) || is_there(wal());
  if (!is_there(file_)) return was_there ? "the file is gone" : "";
  const Bytes now = read();
  const WalReport log = look_at_wal(now.wal);
  if (now.file.empty()) return was_there ? "the file is empty" : "";
  if (!has_sqlite_header(now.file)) return "the file does not begin as a database";
  if (log.is_damaged) return "the WAL is damaged";
  // How many frames are in no file but the WAL, as whoever wrote them last has kept it in the index.
  const std::size_t only_there = frames_only_in_wal(read_file(index()).value_or(""));
  // Whoever closes it well removes both.
  if (!is_there(wal()) && is_there(index())) return kWalGone;
  if (only_there > log.frames) return kWalCut;
  return "";
}

Result<std::string> SqliteFiles::mend(const Bytes& left, const std::string& why,
                                      const std::function<Result<void>()>& note) const {
  std::error_code code;
  if (const fs::path folder = file_.parent_path(); !folder.empty()) fs::create_directories(folder, code);
  auto recovered = recover({left.file, left.wal, accounts(), newest_backup(), why == kWalCut}, mended());
  if (!recovered) return fail(file_.filename().string() + " cannot be mended: " + recovered.error().message);
  if (auto noted = note(); !noted) return fail("cannot be mended: " + noted.error().message);
  const bool has_old = is_there(file_) || is_there(wal());
  const fs::path aside = dated_name(file_, "damaged");
  if (auto put = put_mended(aside); !put) return tl::unexpected<Error>(put.error());
  return file_.filename().string() + ": " + why + "; " + recovered->text() +
         (has_old ? "; what was there is " + aside.filename().string() : "");
}

Result<void> SqliteFiles::put_mended(const fs::path& aside) const {
  // A program that is killed in between finds the mended one, and goes on.
  for (const char* end : {"", "-wal", "-shm"}) {
    const fs::path old = file_.string() + end;
    if (!is_there(old)) continue;
    if (auto moved = rename_for_good(old, aside.string() + end); !moved) return moved;
  }
  return rename_for_good(mended(), file_);
}

void SqliteFiles::finish_mending() const {
  if (is_there(mended())) (void)put_mended(dated_name(file_, "damaged"));
}

void SqliteFiles::make_private() const {
  for (const fs::path& each : {file_, wal(), index()}) telepresence::make_private(each);
}

}  // namespace docent::telepresence
