#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "docent/telepresence/accounts/login_door.h"
#include "docent/telepresence/accounts/logins.h"
#include "docent/telepresence/api/endpoint.h"
#include "docent/telepresence/api/exchange/exchange.h"
#include "docent/telepresence/api/worker.h"

namespace docent::telepresence {

/// Answers /api/v1: finds the endpoint, asks who calls and whether they may, and lets its handler answer, on three
/// threads: one for the store, one for those with accounts, who wait behind no visitor, and one for passwords, of which
/// each takes long by design.
class Desk final : public ApiDesk {
 public:
  using Clock = std::function<Time()>;

  /// Error: the database cannot be opened. A server that nobody answers at is asked again with each call.
  /// @param clock   since 1970; any thread may call it
  /// @param museum  what operators may change; null: nothing. Only the desk's own thread uses it
  /// @param setup   where a museum is set up; null: nowhere. Likewise
  /// @param when    the database is tried first
  /// @param robot   through which the robot is sent about; null: nobody does. Likewise
  [[nodiscard]] static Result<std::unique_ptr<Desk>> open(const std::string& database, const ApiParams& params,
                                                          const ForumParams& forum, Clock clock,
                                                          const PasswordCost& cost = {},
                                                          std::shared_ptr<const MuseumOffice> museum = nullptr,
                                                          std::shared_ptr<const SetupOffice> setup = nullptr,
                                                          Database::Try when = Database::Try::now,
                                                          std::shared_ptr<const RobotOffice> robot = nullptr);

  void take(ApiRequest request, std::function<void(ApiReply)> answer) override;
  void admit(std::string token, std::function<void(Admitted)> answer) override;
  [[nodiscard]] bool is_staff_from(const std::string& address) const override;
  void when_ended(std::function<void(const std::string& login)> told) override;
  /// Any thread: an operator did something through another door than /api/v1.
  void note(std::string who, std::string what, std::string about);
  /// Any thread, every second: ends what another gateway or program ended.
  void look();
  /// Any thread: forgets what is over.
  void tidy();

 private:
  Desk(ApiServices store, ApiServices staff, ApiServices passwords, const ApiParams& params, const ForumParams& forum,
       Clock clock);
  /// On its way from `take` to whoever answers.
  struct Call {
    const Endpoint& endpoint;
    ApiRequest request;
    std::map<std::string, std::string> path;
    std::function<void(ApiReply)> answer;
  };
  void post(Worker& worker, ApiServices& services, const std::shared_ptr<Call>& call, int rank = 0);
  [[nodiscard]] std::optional<Login> login_of(ApiServices& services, const std::string& token, Time now);
  void note_logins(const ApiCall& call, const std::string& name, bool is_wrong);
  void tell_ended(const std::string& login);
  [[nodiscard]] Result<void> learn_places(ApiServices& services);
  [[nodiscard]] ApiReply reply_to(ApiServices& services, const ApiRequest& request, const Endpoint& endpoint,
                                  std::map<std::string, std::string> path);
  [[nodiscard]] ApiAnswer<nlohmann::json> answer(ApiCall& call, const Endpoint& endpoint);

  ApiParams params_;
  Clock clock_;
  ApiServices store_, staff_, passwords_;  ///< of the worker of that name alone
  CallLimits limits_;
  LoginDoor door_;
  Logins logins_;
  std::mutex ended_mutex_;
  std::function<void(const std::string&)> ended_;
  std::atomic<bool> is_looking_ = false, knows_places_ = false;
  Worker store_worker_, staff_worker_, password_worker_;  ///< last: they use the others
};

}  // namespace docent::telepresence
