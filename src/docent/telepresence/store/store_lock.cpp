#include "docent/telepresence/store/store_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <utility>

#include "docent/telepresence/store/salvage/private_files.h"

namespace docent::telepresence {
namespace {

constexpr std::size_t kMostMended = 20;

/// Of open files, not of processes: two connections of one process exclude each other too.
bool set_lock(int file, StoreLock::Part part, short type, bool waits) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(part);
  lock.l_len = 1;
  int done = 0;
  do {
    done = ::fcntl(file, waits ? F_OFD_SETLKW : F_OFD_SETLK, &lock);
  } while (done != 0 && errno == EINTR);
  return done == 0;
}

short type_of(StoreLock::Kind kind) { return kind == StoreLock::Kind::shared ? F_RDLCK : F_WRLCK; }

}  // namespace

std::optional<FileMark> FileMark::of(const std::filesystem::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return std::nullopt;
  return FileMark{found.st_dev, found.st_ino};
}

Result<StoreLock> StoreLock::open(const std::filesystem::path& database) {
  const std::string name = database.string() + ".lock";
  const int file = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return fail(name + ": cannot be opened: " + std::strerror(errno));
  make_private(name);
  return StoreLock{file};
}

StoreLock::StoreLock(StoreLock&& other) noexcept : file_{std::exchange(other.file_, -1)} {}

StoreLock& StoreLock::operator=(StoreLock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

StoreLock::~StoreLock() {
  if (file_ >= 0) ::close(file_);
}

void StoreLock::wait_for(Part part, Kind kind) const { (void)set_lock(file_, part, type_of(kind), true); }
bool StoreLock::try_for(Part part, Kind kind) const { return set_lock(file_, part, type_of(kind), false); }
void StoreLock::release(Part part) const { (void)set_lock(file_, part, F_UNLCK, false); }

StoreLock::Note StoreLock::note() const {
  Note note;
  std::array<char, 8192> bytes{};
  const ::ssize_t count = ::pread(file_, bytes.data(), bytes.size(), 0);
  std::istringstream lines{std::string{bytes.data(), static_cast<std::size_t>(std::max<::ssize_t>(count, 0))}};
  for (std::string word; lines >> word;) {
    if (word == "open") note.is_open = true;
    if (FileMark mark; word == "mended" && lines >> mark.device >> mark.number) note.mended.push_back(mark);
    if (word == "said" && lines >> note.said_at) std::getline(lines >> std::ws, note.said);
  }
  return note;
}

Result<void> StoreLock::write(const Note& note) const {
  std::ostringstream text;
  text << (note.is_open ? "open\n" : "closed\n");
  const std::size_t first = note.mended.size() - std::min(note.mended.size(), kMostMended);
  for (std::size_t i = first; i < note.mended.size(); ++i)
    text << "mended " << note.mended[i].device << ' ' << note.mended[i].number << '\n';
  if (!note.said.empty()) text << "said " << note.said_at << ' ' << note.said.substr(0, 2000) << '\n';
  const std::string bytes = text.str();
  const ::ssize_t written = ::pwrite(file_, bytes.data(), bytes.size(), 0);
  if (written != static_cast<::ssize_t>(bytes.size()) || ::ftruncate(file_, written) != 0)
    return fail(errno == ENOSPC ? "the disk is full" : std::strerror(errno));
  return {};
}

}  // namespace docent::telepresence
