// LD_PRELOAD=libdocent_slow_sync.so: a disk on which each commit takes $DOCENT_SYNC_MS.
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace {

void wait_for_the_disk() {
  const char* text = std::getenv("DOCENT_SYNC_MS");
  const long ms = text == nullptr ? 0 : std::strtol(text, nullptr, 10);
  timespec left{ms / 1000, (ms % 1000) * 1'000'000};
  while (ms > 0 && ::nanosleep(&left, &left) != 0 && errno == EINTR) {
  }
}

}  // namespace

extern "C" int fsync(int file) {
  wait_for_the_disk();
  return static_cast<int>(::syscall(SYS_fsync, file));
}

extern "C" int fdatasync(int file) {
  wait_for_the_disk();
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}
