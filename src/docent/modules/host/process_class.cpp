#include "docent/modules/host/process_class.h"

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

namespace docent::modules {
namespace {

constexpr int kNice = -10;
constexpr rlim_t kMicroseconds = 1000;  // of a millisecond

/// A thread of the class that computes for so long without waiting for anything ends the process.
void bound_computing(double most_ms) {
  rlimit limit{};
  if (getrlimit(RLIMIT_RTTIME, &limit) != 0) return;
  const auto most = static_cast<rlim_t>(std::ceil(most_ms)) * kMicroseconds;
  limit.rlim_cur = std::min(limit.rlim_max, most);
  limit.rlim_max = limit.rlim_cur;
  static_cast<void>(setrlimit(RLIMIT_RTTIME, &limit));
}

bool is_nice() { return getpriority(PRIO_PROCESS, 0) <= kNice || setpriority(PRIO_PROCESS, 0, kNice) == 0; }

}  // namespace

Result<void> ProcessParams::validate() const {
  if (urgent != "realtime" && urgent != "nice" && urgent != "normal")
    return fail("urgent must be realtime, nice or normal, not '" + urgent + "'");
  if (!(priority >= 1 && priority <= 99)) return fail("priority must be 1..99");
  if (!(most_ms > 0.0 && most_ms <= 60000.0)) return fail("most_ms must be > 0 and at most 60000 ms");
  return {};
}

std::string enter_process_class(const ProcessParams& params) {
  if (params.urgent == "normal") return {};
  std::string why;
  if (params.urgent == "realtime") {
    bound_computing(params.most_ms);  // first: no moment without
    sched_param wanted{};
    wanted.sched_priority = params.priority;
    if (sched_setscheduler(0, SCHED_RR, &wanted) == 0) return {};
    why = std::string{"no real-time class ("} + std::strerror(errno) + ")";
  }
  if (is_nice()) return why.empty() ? why : why + ", only a nice value of -10: commands may come late";
  return (why.empty() ? "" : why + ", ") + "no nice value of -10 (" + std::strerror(errno) +
         "): commands may come late while other programs compute";
}

}  // namespace docent::modules
