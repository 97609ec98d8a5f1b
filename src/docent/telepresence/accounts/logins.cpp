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
  Login login = known->second.login;
  login.token = token;  // the database does not know it
  return login;
}

void Logins::end(const Login& login) {
  if (!login.person.is_at_least(Rank::moderator)) return;
  const std::scoped_lock lock{mutex_};
  const std::string hash = hash_token(login.token);
  logins_.erase(hash);
  ended_[hash] = login.expires;
}

std::vector<std::string> Logins::learn(const std::map<std::string, Login>& live, Time asked) {
  const std::scoped_lock lock{mutex_};
  std::vector<std::string> ended;
  for (const auto& [hash, known] : logins_)
    if (known.since < asked && !live.contains(hash)) ended.push_back(hash);
  for (const std::string& hash : ended) logins_.erase(hash);
  std::erase_if(ended_, [&](const auto& end) { return end.second <= asked; });
  for (const auto& [hash, login] : live)
    if (login.person.is_at_least(Rank::moderator) && !ended_.contains(hash))
      logins_.try_emplace(hash, Known{login, asked});
  return ended;
}

}  // namespace docent::telepresence
