#include "docent/telepresence/accounts/logins.h"

#include "docent/telepresence/accounts/secrets.h"

namespace docent::telepresence {

void Logins::keep(const Login& login, Time now) {
  if (!login.person.is_at_least(Rank::moderator)) return;
  const std::scoped_lock lock{mutex_};
  logins_.try_emplace(hash_token(login.token), Known{login, now});
}

std::optional<Login> Logins::find(const std::string& token, Time now) const {
  if (token.empty()) return std::nullopt;
  const std::scoped_lock lock{mutex_};
  const auto known = logins_.find(hash_token(token));
  if (known == logins_.end() || known->second.login.expires <= now) return std::nullopt;
  return known->second.login;
}

void Logins::end(const std::string& token) {
  const std::scoped_lock lock{mutex_};
  logins_.erase(hash_token(token));
}

std::vector<std::string> Logins::keep_only(const std::set<std::string>& live, Time asked) {
  const std::scoped_lock lock{mutex_};
  std::vector<std::string> ended;
  for (const auto& [hash, known] : logins_)
    if (known.since < asked && !live.contains(hash)) ended.push_back(hash);
  for (const std::string& hash : ended) logins_.erase(hash);
  return ended;
}

}  // namespace docent::telepresence
