#include "docent/telepresence/accounts/login_door.h"

#include <algorithm>
#include <vector>

namespace docent::telepresence {
namespace {

std::string pair_of(const std::string& name, const std::string& caller) { return name + '\n' + caller; }

}  // namespace

LoginDoor::LoginDoor(const LoginDoorParams& params)
    : params_{params}, addresses_{params.of_address, params.most}, names_{params.of_name, params.most} {}

void LoginDoor::know(const std::string& name, const std::string& caller) {
  const std::scoped_lock lock{mutex_};
  if (known_.size() < params_.most) {
    known_.insert(pair_of(name, caller));
    callers_.insert(caller);
  }
  wrong_.erase(caller);
}

bool LoginDoor::is_known(const std::string& name, const std::string& caller) const {
  return known_.contains(pair_of(name, caller));
}

bool LoginDoor::may_try(const std::string& name, const std::string& caller, Time now) {
  const std::scoped_lock lock{mutex_};
  if (!addresses_.take(caller, now)) return false;
  return is_known(name, caller) || !wrong_.contains(caller) || names_.take(name.substr(0, 64), now);
}

int LoginDoor::rank(const std::string& name, const std::string& caller) const {
  const std::scoped_lock lock{mutex_};
  if (is_known(name, caller)) return 0;
  const auto wrong = wrong_.find(caller);
  return wrong == wrong_.end() ? 1 : 1 + wrong->second.times;
}

bool LoginDoor::is_from(const std::string& caller) const {
  const std::scoped_lock lock{mutex_};
  return callers_.contains(caller);
}

void LoginDoor::was_wrong(const std::string& caller, Time now) {
  const std::scoped_lock lock{mutex_};
  if (wrong_.size() >= params_.most && !wrong_.contains(caller)) forget(now);
  Wrong& wrong = wrong_[caller];
  ++wrong.times;
  wrong.last = now;
}

void LoginDoor::forget(Time now) {
  std::erase_if(wrong_, [&](const auto& entry) { return now - entry.second.last > params_.forgets_after; });
  if (wrong_.size() < params_.most) return;
  std::vector<Time> last;
  for (const auto& [caller, wrong] : wrong_) last.push_back(wrong.last);
  const auto middle = last.begin() + static_cast<std::ptrdiff_t>(last.size() / 2);
  std::nth_element(last.begin(), middle, last.end());
  std::erase_if(wrong_, [&](const auto& entry) { return entry.second.last <= *middle; });
}

}  // namespace docent::telepresence
