#include "docent/telepresence/store/read_only_copy.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/statvfs.h>

#include <algorithm>

#include "docent/telepresence/store/salvage/page_images.h"

namespace docent::telepresence {

Result<std::unique_ptr<SQLite::Database>> read_only_copy(const SqliteFiles::Bytes& bytes) {
  constexpr std::size_t kVersions = 18;  // of the header: two bytes that say whether there is a WAL
  const PageImages images = read_pages(bytes.file, bytes.wal);
  if (images.pages.empty() || !images.doubtful.empty() || !has_sqlite_header(images.pages.begin()->second))
    return fail("no whole database");
  const std::size_t size = images.page_size * images.pages.rbegin()->first;
  auto* const place = static_cast<unsigned char*>(sqlite3_malloc64(size));
  if (place == nullptr) return fail("no memory");
  std::fill_n(place, size, 0);
  for (const auto& [number, page] : images.pages)
    std::copy(page.begin(), page.end(), place + images.page_size * (number - 1));
  std::fill_n(place + kVersions, 2, 1);
  try {
    auto copy = std::make_unique<SQLite::Database>(":memory:", SQLite::OPEN_READWRITE);
    const int done = sqlite3_deserialize(copy->getHandle(), "main", place, static_cast<sqlite3_int64>(size),
                                         static_cast<sqlite3_int64>(size),
                                         SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_READONLY);
    if (done != SQLITE_OK) return fail("it does not open");  // the place is given back also then
    copy->exec("SELECT count(*) FROM sqlite_schema");
    return copy;
  } catch (const SQLite::Exception& why) {
    return fail(why.what());
  }
}

bool is_of_full_disk(const SQLite::Exception& why, const std::filesystem::path& file) {
  const int code = why.getExtendedErrorCode();
  if ((code & 0xFF) == SQLITE_FULL || code == SQLITE_IOERR_SHMSIZE) return true;
  // Here SQLite says no more than that it cannot write.
  struct statvfs disk {};
  rlimit most{};
  return code == SQLITE_IOERR_WRITE && ((::statvfs(file.c_str(), &disk) == 0 && disk.f_bavail == 0) ||
                                        (::getrlimit(RLIMIT_FSIZE, &most) == 0 && most.rlim_cur != RLIM_INFINITY));
}

}  // namespace docent::telepresence
