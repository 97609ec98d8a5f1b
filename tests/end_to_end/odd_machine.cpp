#include "odd_machine.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
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

timespec plus(timespec time, std::int64_t more_ns) {
  const std::int64_t all = time.tv_nsec + more_ns % kSecond;
  time.tv_sec += more_ns / kSecond;
  time.tv_nsec = all;
  if (all < 0) time.tv_nsec += kSecond, --time.tv_sec;
  if (all >= kSecond) time.tv_nsec -= kSecond, ++time.tv_sec;
  return time;
}

/// Waits as a kernel does whose clock is set meanwhile: set ahead it wakes early, set back late. @param wait  until a
/// time of the true clock
template <class Wait>
int wait_until(const timespec* until, const Wait& wait) {
  constexpr std::int64_t kSinceStart = 1'000'000'000;  // [s]: what is less is of the clock since the start
  constexpr std::int64_t kSlice = kSecond / 5;
  if (machine() == nullptr || until->tv_sec < kSinceStart) return wait(until);
  while (true) {
    timespec now{};
    ::syscall(SYS_clock_gettime, CLOCK_REALTIME, &now);
    const timespec shown = plus(now, ahead_ns());
    const std::int64_t left = (until->tv_sec - shown.tv_sec) * kSecond + until->tv_nsec - shown.tv_nsec;
    const timespec slice = plus(now, left < kSlice ? left : kSlice);
    const int done = wait(&slice);
    if (done != ETIMEDOUT || left <= kSlice) return done;
  }
}

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
  *time = docent::plus(*time, docent::ahead_ns());
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
int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* until) {
  using Call = int (*)(pthread_cond_t*, pthread_mutex_t*, const timespec*);
  static const auto real = reinterpret_cast<Call>(::dlvsym(RTLD_NEXT, "pthread_cond_timedwait", "GLIBC_2.3.2"));
  return docent::wait_until(until, [&](const timespec* slice) { return real(condition, mutex, slice); });
}
int pthread_mutex_timedlock(pthread_mutex_t* mutex, const timespec* until) noexcept {
  static const auto real = docent::next<int (*)(pthread_mutex_t*, const timespec*)>("pthread_mutex_timedlock");
  return docent::wait_until(until, [&](const timespec* slice) { return real(mutex, slice); });
}
}
