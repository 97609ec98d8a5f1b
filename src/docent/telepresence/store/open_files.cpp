#include "docent/telepresence/store/open_files.h"

#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "docent/telepresence/store/salvage/page_images.h"

namespace docent::telepresence {
namespace {

namespace fs = std::filesystem;

std::string bytes_through(sqlite3* database, int which) {
  sqlite3_file* file = nullptr;
  if (sqlite3_file_control(database, "main", which, static_cast<void*>(&file)) != SQLITE_OK || file == nullptr ||
      file->pMethods == nullptr)
    return {};
  sqlite3_int64 size = 0;
  if (file->pMethods->xFileSize(file, &size) != SQLITE_OK || size <= 0) return {};
  std::string bytes(static_cast<std::size_t>(size), '\0');
  constexpr std::size_t kPart = std::size_t{1} << 20U;
  for (std::size_t at = 0; at < bytes.size(); at += kPart)
    (void)file->pMethods->xRead(file, bytes.data() + at, static_cast<int>(std::min(kPart, bytes.size() - at)),
                                static_cast<sqlite3_int64>(at));
  return bytes;
}

}  // namespace

std::optional<OpenFiles> OpenFiles::of(const SqliteFiles& files) {
  const auto file = FileMark::of(files.file());
  const auto wal = FileMark::of(files.wal());
  const auto index = FileMark::of(files.index());
  if (!file || !wal || !index) return std::nullopt;
  return OpenFiles{*file, *wal, *index};
}

std::string OpenFiles::look(const SqliteFiles& files) {
  const auto now = of(files);
  if (!now) return FileMark::of(files.file()) ? "the WAL is gone" : "the file is gone";
  if (now->file != file) return "another file is in its place";
  if (now->wal != wal || now->index != index) return "the WAL is gone";
  std::error_code code;
  const auto size = fs::file_size(files.file(), code);
  const auto of_wal = fs::file_size(files.wal(), code);
  if (code || size < file_size) return size == 0 ? "the file is empty" : "the file is cut off";
  if (of_wal < wal_size) return SqliteFiles::kWalCut;
  file_size = size;
  wal_size = of_wal;
  return "";
}

SqliteFiles::Bytes bytes_of(sqlite3* database) {
  return {bytes_through(database, SQLITE_FCNTL_FILE_POINTER), bytes_through(database, SQLITE_FCNTL_JOURNAL_POINTER)};
}

bool begins_well(sqlite3* database) {
  sqlite3_file* file = nullptr;
  char begin[16] = {};
  return sqlite3_file_control(database, "main", SQLITE_FCNTL_FILE_POINTER, static_cast<void*>(&file)) == SQLITE_OK &&
         file != nullptr && file->pMethods != nullptr &&
         file->pMethods->xRead(file, begin, sizeof begin, 0) == SQLITE_OK && has_sqlite_header({begin, sizeof begin});
}

}  // namespace docent::telepresence
