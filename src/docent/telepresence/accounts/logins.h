#pragma once

#include <map>
#include <mutex>
#include <optional>
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
  /// It is over, whatever the database says later.
  void end(const Login& login);
  /// What the database says: `live`, by what hash_token gives of their tokens, were the logins at `asked`, wherever
  /// they began. Ends those that are no more. @returns them, likewise as hashes
  [[nodiscard]] std::vector<std::string> learn(const std::map<std::string, Login>& live, Time asked);

 private:
  struct Known {
    Login login;
    Time since;
  };
  mutable std::mutex mutex_;
  std::map<std::string, Known> logins_;  ///< by the hash of their token
  std::map<std::string, Time> ended_;    ///< here, until they would have expired
};

}  // namespace docent::telepresence
