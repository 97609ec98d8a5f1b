#pragma once

#include <string>

#include "docent/base/result.h"

namespace docent::modules {

inline constexpr const char* kProcesses = "processes";

/// Section `processes`: how the operating system treats the modules on which braking waits.
struct ProcessParams {
  /// realtime: avoid, robot and hazards run before all others, where they may (RLIMIT_RTPRIO or CAP_SYS_NICE), else
  /// with a nice value of -10, else as any process; nice; normal
  std::string urgent = "realtime";
  int priority = 10;        ///< 1..99 of the class SCHED_RR: above what else computes, below the kernel's own threads
  double most_ms = 1000.0;  ///< [ms] > 0, of computing on end, then such a module is ended and begins anew: a runaway
                            ///< must not hold the computer
  template <class V>
  void visit(V& v) {
    v("urgent", urgent);
    v("priority", priority);
    v("most_ms", most_ms);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Puts the calling process into its class; threads that it makes later are in it, too.
/// @returns what it may not have, for its health; empty: all that was wanted
[[nodiscard]] std::string enter_process_class(const ProcessParams& params);

}  // namespace docent::modules
