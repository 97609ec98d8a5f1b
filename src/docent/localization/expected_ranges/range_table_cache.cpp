#include "docent/localization/expected_ranges/range_table_cache.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <system_error>
#include <vector>

#include "docent/base/random.h"

namespace docent::localization {

namespace {

constexpr const char* kName = "range-table-";
constexpr std::chrono::hours kHalfWritten{1};  // no table takes so long

struct KeptFile {
  std::filesystem::path path;
  std::filesystem::file_time_type used;
  std::uint64_t bytes = 0;
};

/// The tables in a folder, whole ones and parts; other files are nobody's business here.
std::vector<KeptFile> kept_files(const std::filesystem::path& folder) {
  std::vector<KeptFile> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry{folder, error}, end; !error && entry != end; entry.increment(error)) {
    std::error_code gone;  // another process may be quicker
    if (entry->path().filename().string().rfind(kName, 0) != 0 || !entry->is_regular_file(gone)) continue;
    KeptFile file{entry->path(), entry->last_write_time(gone), 0};
    if (!gone) file.bytes = entry->file_size(gone);
    if (!gone) files.push_back(std::move(file));
  }
  return files;
}

}  // namespace

std::filesystem::path RangeTableCache::file_of(const std::string& key) const {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "%s%016llx", kName, static_cast<unsigned long long>(hash_of(key)));
  return folder / name.data();
}

void RangeTableCache::make_room(const std::filesystem::path& in_use) const {
  std::vector<KeptFile> files = kept_files(folder);
  std::sort(files.begin(), files.end(), [](const KeptFile& a, const KeptFile& b) { return a.used < b.used; });
  std::uint64_t all = 0;
  for (const KeptFile& file : files) all += file.bytes;
  const auto now = std::filesystem::file_time_type::clock::now();
  for (const KeptFile& file : files) {
    const bool is_part = file.path.filename().string().find(kPart) != std::string::npos;
    const bool goes = is_part ? now - file.used > kHalfWritten : all > most_bytes && file.path != in_use;
    std::error_code error;
    if (goes && std::filesystem::remove(file.path, error)) all -= file.bytes;
  }
}

}  // namespace docent::localization
