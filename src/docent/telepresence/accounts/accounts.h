#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/accounts/person.h"
#include "docent/telepresence/accounts/secrets.h"
#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

/// Somebody who has come, with what they show at each call.
struct Login {
  Person person;
  std::string token;    ///< in a cookie; known only to them, and never stored
  std::string csrf;     ///< that a page of ours sends along when it changes something; other sites cannot read it
  std::string address;  ///< from where it began
  Time expires;
};

struct Account {
  std::string name;
  Rank rank = Rank::viewer;
  Time created;
};

/// Who may do what: accounts with passwords, sessions, and who was sent away. Several gateways may share the database.
/// What changes is committed when a call returns. One thread.
class Accounts {
 public:
  static constexpr std::size_t kShortestPassword = 10;  ///< bytes
  static constexpr std::size_t kLongestPassword = 200;  ///< bytes

  /// Makes its tables where there are none. The database outlives it.
  [[nodiscard]] static Result<std::unique_ptr<Accounts>> open(Database& database, const PasswordCost& cost = {});
  Accounts(const Accounts&) = delete;
  Accounts& operator=(const Accounts&) = delete;

  /// Error: the name is taken or no identifier, the password too short, the rank has no account.
  [[nodiscard]] Result<void> add(const std::string& name, const std::string& password, Rank rank, Time now);
  /// Ends the account's sessions too. Error: there is no such account.
  [[nodiscard]] Result<void> set_password(const std::string& name, const std::string& password);
  [[nodiscard]] Result<void> remove(const std::string& name);
  [[nodiscard]] Result<std::vector<Account>> list();  ///< by name

  [[nodiscard]] Result<bool> has(const std::string& name);  ///< an account of that name

  /// Whose password it is; nullopt: nobody's. Takes as long where there is no such account.
  [[nodiscard]] Result<std::optional<Person>> check(const std::string& name, const std::string& password);

  /// @param lifetime  [s]
  [[nodiscard]] Result<Login> begin(const Person& person, const std::string& address, double lifetime, Time now);
  /// nullopt: there is none, it has ended, or its person was sent away.
  [[nodiscard]] Result<std::optional<Login>> find(const std::string& token, Time now);
  [[nodiscard]] Result<void> end(const std::string& token);

  /// The logins of those with accounts that have not ended, by what hash_token gives of their tokens, which nobody
  /// knows.
  [[nodiscard]] Result<std::map<std::string, Login>> logins_of_accounts(Time now);

  /// From where an account's password was right, for `LoginDoor`; `network` of limits/network.h.
  struct Place {
    std::string name, network;
  };
  [[nodiscard]] Result<void> remember(const Place& place, Time now);
  [[nodiscard]] Result<std::vector<Place>> places();

  /// Ends their sessions. Nobody begins a visitor's session from their addresses until then either.
  [[nodiscard]] Result<void> send_away(const std::string& person, Time until, Time now);
  [[nodiscard]] Result<bool> is_sent_away(const std::string& address, Time now);
  void forget_before(Time now);  ///< what ended before

 private:
  Accounts(Database& database, const PasswordCost& cost) : database_{database}, cost_{cost} {}

  Database& database_;
  PasswordCost cost_;
  std::string no_account_;  ///< a hash that is tried where there is no account
};

}  // namespace docent::telepresence
