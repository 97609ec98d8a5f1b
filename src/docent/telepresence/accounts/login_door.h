#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>

#include "docent/base/time.h"
#include "docent/telepresence/limits/rate_limits.h"

namespace docent::telepresence {

struct LoginDoorParams {
  Rate of_address{0.1, 6.0};  ///< tries
  Rate of_name{0.1, 6.0};     ///< tries for one name by callers who were wrong before and never right
  std::size_t most = 10'000;  ///< callers that are remembered
  Duration forgets_after = std::chrono::hours{24};  ///< that somebody was wrong
};

/// Who may try a password, and who is heard first: a stranger who guesses slows the stranger, not the account. Any
/// thread. Callers are networks (limits/network.h).
class LoginDoor {
 public:
  explicit LoginDoor(const LoginDoorParams& params);

  /// Whoever was once right from there may try whatever others do with that name.
  void know(const std::string& name, const std::string& caller);
  /// False: the caller has to wait.
  [[nodiscard]] bool may_try(const std::string& name, const std::string& caller, Time now);
  /// In which order those who wait are heard, the smallest first: who was right before, then who was wrong least often.
  [[nodiscard]] int rank(const std::string& name, const std::string& caller) const;
  void was_wrong(const std::string& caller, Time now);
  /// Whether somebody was let in from there.
  [[nodiscard]] bool is_from(const std::string& caller) const;

 private:
  struct Wrong {
    int times = 0;
    Time last;
  };
  [[nodiscard]] bool is_known(const std::string& name, const std::string& caller) const;
  void forget(Time now);

  const LoginDoorParams params_;
  mutable std::mutex mutex_;
  RateLimits addresses_, names_;
  std::set<std::string> known_, callers_;
  std::map<std::string, Wrong> wrong_;
};

}  // namespace docent::telepresence
