#include "odd_machine.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <ctime>

// Preloaded into all programs of a robot: calls of the C library that write to a disk or read the wall's clock.

namespace docent {
namespace {

OddMachine* mapped() {
  const char* path = std::getenv(OddMachine::kVariable);
  const int file = path == nullptr ? -1 : static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, O_RDWR | O_CLOEXEC));
  if (file < 0) return nullptr;
  void* const place = ::mmap(nullptr, sizeof(OddMachine), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::syscall(SYS_close, file);
  return place == MAP_FAILED ? nullptr : static_cast<OddMachine*>(place);
}

OddMachine* machine() {
  static OddMachine* const place = mapped();
  return place;
}

bool takes(int file) {
  OddMachine* const it = machine();
  struct stat what {};
  if (it == nullptr || it->is_full == 0 || ::fstat(file, &what) != 0 || !S_ISREG(what.st_mode)) return true;
  ++it->refused;
  errno = ENOSPC;
  return false;
}

template <class Call>
Call next(const char* name) {
  return reinterpret_cast<Call>(::dlsym(RTLD_NEXT, name));
}

std::int64_t ahead_ns() {
  const OddMachine* const it = machine();
  return it == nullptr ? 0 : it->ahead_ns.load();
}

constexpr std::int64_t kSecond = 1'000'000'000;

}  // namespace
}  // namespace docent

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
  return docent::takes(file) ? ::syscall(SYS_write, file, bytes, count) : -1;
}
ssize_t writev(int file, const iovec* parts, int count) {
  return docent::takes(file) ? ::syscall(SYS_writev, file, parts, count) : -1;
}
ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  return docent::takes(file) ? ::syscall(SYS_pwrite64, file, bytes, count, at) : -1;
}
ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t at) {
  return docent::takes(file) ? ::syscall(SYS_pwrite64, file, bytes, count, at) : -1;
}
int fallocate(int file, int mode, off_t at, off_t count) {
  return docent::takes(file) ? static_cast<int>(::syscall(SYS_fallocate, file, mode, at, count)) : -1;
}
int posix_fallocate(int file, off_t at, off_t count) {
  if (!docent::takes(file)) return ENOSPC;
  return ::syscall(SYS_fallocate, file, 0, at, count) == 0 ? 0 : errno;
}
int posix_fallocate64(int file, off64_t at, off64_t count) { return posix_fallocate(file, at, count); }

int clock_gettime(clockid_t which, timespec* time) noexcept {
  static const auto real = docent::next<int (*)(clockid_t, timespec*)>("clock_gettime");
  const int done = real(which, time);
  if (done != 0 || (which != CLOCK_REALTIME && which != CLOCK_REALTIME_COARSE)) return done;
  const std::int64_t ahead = docent::ahead_ns();
  const std::int64_t all = time->tv_nsec + ahead % docent::kSecond;
  time->tv_sec += ahead / docent::kSecond;
  time->tv_nsec = all;
  if (all < 0) time->tv_nsec += docent::kSecond, --time->tv_sec;
  if (all >= docent::kSecond) time->tv_nsec -= docent::kSecond, ++time->tv_sec;
  return done;
}
int gettimeofday(timeval* time, void* /*zone*/) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  time->tv_sec = now.tv_sec;
  time->tv_usec = now.tv_nsec / 1000;
  return 0;
}
time_t time(time_t* place) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (place != nullptr) *place = now.tv_sec;
  return now.tv_sec;
}
}
