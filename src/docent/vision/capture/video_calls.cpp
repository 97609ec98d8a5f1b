#include "docent/vision/capture/video_calls.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>

namespace docent::vision {
namespace {

class KernelVideoCalls final : public VideoCalls {
 public:
  [[nodiscard]] int open(const std::string& path) override {
    return ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  }
  void close(int descriptor) override { ::close(descriptor); }
  [[nodiscard]] int control(int descriptor, unsigned long request, void* argument) override {
    int done = 0;
    do done = ::ioctl(descriptor, request, argument);
    while (done == -1 && errno == EINTR);
    return done == -1 ? -1 : 0;
  }
  [[nodiscard]] void* map(int descriptor, std::size_t length, std::size_t offset) override {
    void* memory = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, static_cast<off_t>(offset));
    return memory == MAP_FAILED ? nullptr : memory;
  }
  void unmap(void* memory, std::size_t length) override { ::munmap(memory, length); }
  [[nodiscard]] int wait(int descriptor, int milliseconds) override {
    pollfd one{descriptor, POLLIN, 0};
    const int found = ::poll(&one, 1, milliseconds);
    if (found == -1 && errno == EINTR) return 0;
    if (found == 1 && (one.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) {
      errno = ENODEV;
      return -1;
    }
    return found;
  }
  [[nodiscard]] long long clock() const override {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return 1000000000LL * now.tv_sec + now.tv_nsec;
  }
};

}  // namespace

std::unique_ptr<VideoCalls> kernel_video_calls() { return std::make_unique<KernelVideoCalls>(); }

}  // namespace docent::vision
