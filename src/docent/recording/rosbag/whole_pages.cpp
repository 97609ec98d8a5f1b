#include "docent/recording/rosbag/whole_pages.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace docent::recording {
namespace {

// Of SQLite's header (sqlite.org/fileformat): numbers are big endian.
constexpr std::size_t kHeader = 100;
constexpr std::size_t kPageSizeAt = 16;
constexpr std::size_t kWriteVersionAt = 18, kReadVersionAt = 19;
constexpr std::size_t kPagesAt = 28;
constexpr std::uint8_t kWithoutLog = 1;  // version: no write-ahead log beside the file

std::size_t number_at(const std::uint8_t* bytes, std::size_t size) {
  std::size_t number = 0;
  for (std::size_t i = 0; i < size; ++i) number = number << 8U | bytes[i];
  return number;
}

}  // namespace

Result<std::unique_ptr<WholePages>> WholePages::of(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return fail(path.string() + ": cannot be read: " + std::strerror(errno));
  std::unique_ptr<WholePages> pages{new WholePages};
  struct stat status {};
  const bool is_file = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  const auto size = is_file ? static_cast<std::size_t>(status.st_size) : 0;
  void* mapped = size < kHeader ? MAP_FAILED : ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE, file, 0);
  ::close(file);
  if (mapped == MAP_FAILED) return fail(path.string() + ": ends before its first page does");
  pages->mapped_ = mapped;
  pages->size_ = size;
  auto* bytes = static_cast<std::uint8_t*>(mapped);
  std::size_t page_size = number_at(bytes + kPageSizeAt, 2);
  if (page_size == 1) page_size = 65536;
  if (page_size < 512 || size < page_size) return fail(path.string() + ": ends before its first page does");
  pages->pages_ = size / page_size;
  pages->should_be_ = number_at(bytes + kPagesAt, 4);
  pages->bytes_ = {bytes, pages->pages_ * page_size};
  bytes[kWriteVersionAt] = bytes[kReadVersionAt] = kWithoutLog;
  return pages;
}

WholePages::~WholePages() {
  if (mapped_ != nullptr) ::munmap(mapped_, size_);
}

std::string WholePages::what_is_wrong() const {
  if (pages_ >= should_be_) return "is damaged";
  return "ends early (" + std::to_string(pages_) + " of " + std::to_string(should_be_) + " pages are there)";
}

}  // namespace docent::recording
