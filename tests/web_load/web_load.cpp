// docent_web_load: plays the viewers of a Web server and measures how late its values come. One thread, epoll.
#include <fmt/format.h>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <string>
#include <vector>

#include "viewer.h"

namespace {

using docent::web_load::Pace;
using docent::web_load::Viewer;

double monotonic_s() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The number behind a word in a file of /proc.
long number_in(const std::string& path, const std::string& word) {
  std::ifstream file{path};
  for (std::string read; file >> read;) {
    if (read != word) continue;
    long number = 0;
    file >> number;
    return number;
  }
  return 0;
}
/// [kB] of the buffers of all sockets of this computer.
long socket_kb() {
  std::ifstream file{"/proc/net/sockstat"};
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("TCP:")) return 4 * std::strtol(line.substr(line.find("mem ") + 4).c_str(), nullptr, 10);
  }
  return 0;
}
/// What the process has of its own; pages of its program, which the first viewer touches, are no viewer's.
long resident_kb(int process) { return number_in("/proc/" + std::to_string(process) + "/status", "RssAnon:"); }
/// [s] that the process has computed.
double busy_s(int process) {
  std::ifstream file{"/proc/" + std::to_string(process) + "/stat"};
  std::string word;
  double ticks = 0.0;
  for (int field = 1; field <= 15 && file >> word; ++field) {
    if (field >= 14) ticks += std::strtod(word.c_str(), nullptr);
  }
  return ticks / 100.0;
}

struct Options {
  int port = 0;
  int process = 0;
  std::string path = "/live?thin";
  int viewers = 1000;
  int stalled = 100;
  int slow = 50;
  double seconds = 20.0;
  double settle_s = 3.0;
  int per_second = 2000;
};

class Load {
 public:
  explicit Load(const Options& options) : options_{options}, poll_{::epoll_create1(0)} {}

  int run() {
    const long resident_before = resident_kb(options_.process);
    const long sockets_before = socket_kb();
    connect_all();
    const double begin = monotonic_s() + options_.settle_s;
    serve_until(begin);
    late_ms_.clear();
    values_ = 0;
    const double busy_before = busy_s(options_.process);
    const double from = monotonic_s();
    serve_until(from + options_.seconds);
    report(resident_before, sockets_before, busy_s(options_.process) - busy_before, monotonic_s() - from);
    return 0;
  }

 private:
  void connect_all() {
    const int all = options_.viewers + options_.stalled + options_.slow;
    double next = monotonic_s();
    for (int i = 0; i < all; ++i) {
      // Those who read badly come among the others.
      const int apart = all / std::max(1, options_.stalled + options_.slow);
      Pace pace = Pace::prompt;
      if (bad_ < options_.stalled + options_.slow && i % std::max(1, apart) == 0)
        pace = bad_++ < options_.stalled ? Pace::never : Pace::slow;
      viewers_.emplace_back(options_.port, options_.path, pace);
      epoll_event event{};
      event.events = EPOLLIN | EPOLLOUT | EPOLLET;
      event.data.ptr = &viewers_.back();
      if (!viewers_.back().is_broken()) ::epoll_ctl(poll_, EPOLL_CTL_ADD, viewers_.back().descriptor(), &event);
      next += 1.0 / options_.per_second;
      serve_until(next);
    }
    const double end = monotonic_s() + 30.0;
    while (open_ < all && monotonic_s() < end) serve_until(monotonic_s() + 0.05);
  }

  void serve_until(double end_s) {
    std::vector<epoll_event> events(1024);
    do {
      const double left = std::max(0.0, end_s - monotonic_s());
      const int count = ::epoll_wait(poll_, events.data(), static_cast<int>(events.size()),
                                     static_cast<int>(std::min(50.0, 1000.0 * left)));
      for (int i = 0; i < count; ++i) handle(*static_cast<Viewer*>(events[static_cast<std::size_t>(i)].data.ptr));
      read_slowly();
    } while (monotonic_s() < end_s);
  }

  void handle(Viewer& viewer) {
    viewer.greet();
    // Nobody reads badly before the channel is open.
    if (viewer.is_open() && viewer.pace() != Pace::prompt) return;
    read(viewer, 1U << 20U);
  }

  void read(Viewer& viewer, std::size_t most) {
    const bool was_open = viewer.is_open();
    texts_.clear();
    viewer.read(most, texts_);
    if (!was_open && viewer.is_open()) ++open_;
    if (viewer.is_broken()) ++broken_;
    if (viewer.pace() != Pace::prompt) return;
    const double now = monotonic_s();
    for (const std::string& text : texts_) {
      const std::size_t place = text.find("\"t\":");
      if (place == std::string::npos) continue;
      late_ms_.push_back(static_cast<float>(1e3 * (now - std::strtod(text.c_str() + place + 4, nullptr))));
      ++values_;
      bytes_ += text.size();
    }
  }

  /// Fifty bytes four times a second.
  void read_slowly() {
    const double now = monotonic_s();
    if (now < next_slow_) return;
    next_slow_ = now + 0.25;
    for (Viewer& viewer : viewers_) {
      if (viewer.pace() == Pace::slow && viewer.is_open()) read(viewer, 50);
    }
  }

  void report(long resident_before, long sockets_before, double busy, double lasted) {
    std::sort(late_ms_.begin(), late_ms_.end());
    const auto share = [&](double part) {
      if (late_ms_.empty()) return 0.0F;
      return late_ms_[std::min(late_ms_.size() - 1,
                               static_cast<std::size_t>(part * static_cast<double>(late_ms_.size())))];
    };
    const int all = options_.viewers + options_.stalled + options_.slow;
    const double kb = static_cast<double>(resident_kb(options_.process) - resident_before);
    const double sockets = static_cast<double>(socket_kb() - sockets_before);
    fmt::print(
        "{{\"viewers\": {}, \"open\": {}, \"broken\": {}, \"values\": {}, \"values_per_viewer_s\": {:.3f}, "
        "\"bytes\": {:.0f}, \"median_ms\": {:.1f}, \"p99_ms\": {:.1f}, \"worst_ms\": {:.1f}, \"resident_kb\": {:.2f}, "
        "\"socket_kb\": {:.2f}, \"core\": {:.3f}}}\n",
        options_.viewers, open_, broken_, values_, static_cast<double>(values_) / lasted / options_.viewers,
        values_ > 0 ? static_cast<double>(bytes_) / static_cast<double>(values_) : 0.0, share(0.5), share(0.99),
        share(1.0), kb / all, sockets / all, busy / lasted);
  }

  Options options_;
  int poll_;
  std::deque<Viewer> viewers_;
  std::vector<std::string> texts_;
  std::vector<float> late_ms_;
  long values_ = 0;
  std::size_t bytes_ = 0;
  int open_ = 0;
  int broken_ = 0;
  int bad_ = 0;
  double next_slow_ = 0.0;
};

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Plays the viewers of a Web server and prints how late its values come, as JSON"};
  app.add_option("--port", options.port)->required();
  app.add_option("--process", options.process, "of the server, to see its memory")->required();
  app.add_option("--path", options.path);
  app.add_option("--viewers", options.viewers, "who read at once")->check(CLI::Range(1, 30000));
  app.add_option("--stalled", options.stalled, "who never read")->check(CLI::Range(0, 10000));
  app.add_option("--slow", options.slow, "who read 200 bytes a second")->check(CLI::Range(0, 10000));
  app.add_option("--seconds", options.seconds)->check(CLI::Range(1.0, 3600.0));
  app.add_option("--per-second", options.per_second, "how many come in a second")->check(CLI::Range(10, 100000));
  CLI11_PARSE(app, argc, argv);
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
  return Load{options}.run();
}
