#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "docent/telepresence/accounts/accounts.h"

namespace docent::telepresence {

/// The logins of those who have accounts, as this gateway knows them: whoever may stop the robot is recognized without
/// a look into the database, also while that does not answer. Any thread.
class Logins {
 public:
  /// Of those with accounts alone; visitors are not kept.
  void keep(const Login& login, Time now);
  /// nullopt: unknown, or over.
  [[nodiscard]] std::optional<Login> find(const std::string& token, Time now) const;
  /// It is over.
  void end(const std::string& token);
  /// What the database says: `live`, as hash_token gives them, were the logins at `asked`. Ends those that are no more.
  /// @returns them, likewise as hashes
  [[nodiscard]] std::vector<std::string> keep_only(const std::set<std::string>& live, Time asked);

 private:
  struct Known {
    Login login;
    Time since;
  };
  mutable std::mutex mutex_;
  std::map<std::string, Known> logins_;  ///< by the hash of their token
};

}  // namespace docent::telepresence
