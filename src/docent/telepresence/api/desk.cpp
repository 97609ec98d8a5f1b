#include "docent/telepresence/api/desk.h"

#include <algorithm>
#include <utility>

namespace docent::telepresence {
namespace {

ApiReply refusal(const ApiRefusal& why) {
  return {status_of(why.reason), json_text(documents::Fault{why.reason, why.about}), ""};
}

constexpr double kReadsAtOnce = 10.0;   // [s] worth of them
constexpr double kWritesAtOnce = 20.0;  // [s] likewise
constexpr double kAuditDays = 365.0;

}  // namespace

Desk::Desk(ApiServices store, ApiServices passwords, const ApiParams& params, Clock clock)
    : params_{params},
      clock_{std::move(clock)},
      store_{std::move(store)},
      passwords_{std::move(passwords)},
      reads_{{params.reads_per_second, std::max(1.0, kReadsAtOnce * params.reads_per_second)}},
      writes_{{params.writes_per_second, std::max(1.0, kWritesAtOnce * params.writes_per_second)}},
      logins_{{params.logins_per_minute / 60.0, params.logins_per_minute}},
      store_worker_{static_cast<std::size_t>(params.calls_waiting)},
      password_worker_{static_cast<std::size_t>(params.passwords_waiting)} {}

Result<std::unique_ptr<Desk>> Desk::open(const std::string& database, const ApiParams& params, const ForumParams& forum,
                                         Clock clock, const PasswordCost& cost,
                                         std::shared_ptr<const MuseumOffice> museum,
                                         std::shared_ptr<const SetupOffice> setup) {
  auto store = ApiServices::open(database, params, forum, cost);
  if (!store) return tl::unexpected<Error>(store.error());
  store->museum = std::move(museum);
  store->setup = std::move(setup);
  auto passwords = ApiServices::open(database, params, forum, cost);
  if (!passwords) return tl::unexpected<Error>(passwords.error());
  return std::unique_ptr<Desk>{new Desk{std::move(*store), std::move(*passwords), params, std::move(clock)}};
}

bool Desk::is_within_rate(const ApiRequest& request, const Endpoint& endpoint) {
  const Time now = clock_();
  const std::scoped_lock lock{limits_mutex_};
  if (!endpoint.changes()) return reads_.take(request.address, now);
  return writes_.take(request.address, now) && (!endpoint.is_dear || logins_.take(request.address, now));
}

void Desk::take(ApiRequest request, std::function<void(ApiReply)> answer) {
  std::map<std::string, std::string> path;
  const auto found = find_endpoint(endpoints(), request.method, request.target, path);
  if (!found) return answer(refusal(found.error()));
  const Endpoint& endpoint = **found;
  if (!is_within_rate(request, endpoint)) return answer(refusal({ApiFault::too_fast, ""}));
  Worker& worker = endpoint.is_dear ? password_worker_ : store_worker_;
  ApiServices& services = endpoint.is_dear ? passwords_ : store_;
  // Shared, for a copy of it remains here when the worker is full.
  const auto tell = std::make_shared<std::function<void(ApiReply)>>(std::move(answer));
  const bool is_taken =
      worker.post([this, &services, &endpoint, request = std::move(request), path = std::move(path), tell]() mutable {
        (*tell)(reply_to(services, request, endpoint, std::move(path)));
      });
  if (!is_taken) (*tell)(refusal({ApiFault::busy, ""}));
}

ApiReply Desk::reply_to(ApiServices& services, const ApiRequest& request, const Endpoint& endpoint,
                        std::map<std::string, std::string> path) {
  ApiCall call{services, request, std::nullopt, {}, std::move(path), {}, clock_(), {}};
  auto document = answer(call, endpoint);
  if (!document) return refusal(document.error());
  return {200, document->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), std::move(call.set_cookie)};
}

ApiAnswer<nlohmann::json> Desk::answer(ApiCall& call, const Endpoint& endpoint) {
  const ApiRequest& request = call.request;
  auto query = parse_query(request.target);
  if (!query) return refuse(ApiFault::not_understood, "the query");
  for (const auto& [name, value] : *query) {
    const bool is_known = std::find(endpoint.query.begin(), endpoint.query.end(), name) != endpoint.query.end();
    if (!is_known || value.size() > 64) return refuse(ApiFault::not_understood, "the query");
  }
  call.query = std::move(*query);
  if (endpoint.changes() && !request.is_of_ours) return refuse(ApiFault::other_site);
  if (!request.token.empty()) {
    auto login = call.services.accounts->find(request.token, call.now);
    if (!login) return refuse(ApiFault::not_stored, login.error().message);
    call.login = std::move(*login);
    if (call.login) call.person = call.login->person;
  }
  if (!call.person.is_at_least(endpoint.least)) return refuse(ApiFault::not_allowed);
  if (endpoint.changes() && call.login && !is_same_secret(request.csrf, call.login->csrf))
    return refuse(ApiFault::wrong_csrf);
  nlohmann::json body = nlohmann::json::object();
  if (endpoint.has_body) {
    if (!request.is_json) return refuse(ApiFault::not_understood, "Content-Type must be application/json");
    auto parsed = parse_json(request.body);
    if (!parsed) return refuse(ApiFault::not_understood, parsed.error().message);
    body = std::move(*parsed);
    if (endpoint.is_dear && body.is_object() && body.contains("name") && body["name"].is_string()) {
      const std::scoped_lock lock{limits_mutex_};
      if (!logins_.take("name " + body["name"].get<std::string>().substr(0, 64), call.now))
        return refuse(ApiFault::too_fast);
    }
  } else if (!request.body.empty()) {
    return refuse(ApiFault::not_understood, "a body where none belongs");
  }
  auto document = endpoint.handle(call, body);
  if (document && endpoint.changes() && endpoint.least >= Rank::moderator) {
    std::string about;
    for (const auto& [name, value] : call.path) about += (about.empty() ? "" : " ") + value;
    auto noted = call.services.audit->add({call.now, call.person.id, endpoint.name, about, request.address});
    if (!noted) return refuse(ApiFault::not_stored, noted.error().message);
  }
  return document;
}

void Desk::admit(std::string token, std::function<void(std::optional<std::string>)> answer) {
  const auto tell = std::make_shared<std::function<void(std::optional<std::string>)>>(std::move(answer));
  const bool is_taken = store_worker_.post([this, token = std::move(token), tell] {
    auto login = store_.accounts->find(token, clock_());
    const bool is_operator = login && *login && (*login)->person.is_at_least(Rank::operator_);
    (*tell)(is_operator ? std::optional{(*login)->person.name} : std::nullopt);
  });
  if (!is_taken) (*tell)(std::nullopt);
}

void Desk::note(std::string who, std::string what, std::string about) {
  // Should it not be stored, what was done is done; a stop must not wait for a disk.
  (void)store_worker_.post([this, who = std::move(who), what = std::move(what), about = std::move(about)] {
    (void)store_.audit->add({clock_(), who, what, about, ""});
  });
}

void Desk::tidy() {
  (void)store_worker_.post([this] {
    const Time now = clock_();
    store_.accounts->forget_before(now);
    store_.audit->forget_before(now - seconds(86400.0 * kAuditDays));
  });
}

}  // namespace docent::telepresence
