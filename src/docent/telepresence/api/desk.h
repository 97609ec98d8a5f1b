#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "docent/telepresence/api/endpoint.h"
#include "docent/telepresence/api/exchange/exchange.h"
#include "docent/telepresence/api/rate_limits.h"
#include "docent/telepresence/api/worker.h"

namespace docent::telepresence {

/// Answers /api/v1: finds the endpoint, asks who calls and whether they may, and lets its handler answer, on two
/// threads: one for the store, and one for passwords, of which each takes long by design.
class Desk final : public ApiDesk {
 public:
  using Clock = std::function<Time()>;

  /// Error: the database cannot be opened.
  /// @param clock   since 1970; any thread may call it
  /// @param museum  what operators may change; null: nothing. Only the desk's own thread uses it
  /// @param setup   where a museum is set up; null: nowhere. Likewise
  [[nodiscard]] static Result<std::unique_ptr<Desk>> open(const std::string& database, const ApiParams& params,
                                                          const ForumParams& forum, Clock clock,
                                                          const PasswordCost& cost = {},
                                                          std::shared_ptr<const MuseumOffice> museum = nullptr,
                                                          std::shared_ptr<const SetupOffice> setup = nullptr);

  void take(ApiRequest request, std::function<void(ApiReply)> answer) override;
  void admit(std::string token, std::function<void(std::optional<std::string>)> answer) override;
  /// Any thread: an operator did something through another door than /api/v1.
  void note(std::string who, std::string what, std::string about);
  /// Any thread: forgets what is over.
  void tidy();

 private:
  Desk(ApiServices store, ApiServices passwords, const ApiParams& params, Clock clock);
  [[nodiscard]] bool is_within_rate(const ApiRequest& request, const Endpoint& endpoint);
  [[nodiscard]] ApiReply reply_to(ApiServices& services, const ApiRequest& request, const Endpoint& endpoint,
                                  std::map<std::string, std::string> path);
  [[nodiscard]] ApiAnswer<nlohmann::json> answer(ApiCall& call, const Endpoint& endpoint);

  ApiParams params_;
  Clock clock_;
  ApiServices store_, passwords_;  ///< of the worker of that name alone
  std::mutex limits_mutex_;        ///< of the three below
  RateLimits reads_, writes_, logins_;
  Worker store_worker_, password_worker_;  ///< last: they use the others
};

}  // namespace docent::telepresence
