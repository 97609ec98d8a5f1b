#include "docent/telepresence/api/desk.h"

#include <algorithm>
#include <array>
#include <utility>

#include "docent/telepresence/accounts/secrets.h"
#include "docent/telepresence/limits/network.h"

namespace docent::telepresence {
namespace {

ApiReply refusal(const ApiRefusal& why) {
  return {status_of(why.reason), json_text(documents::Fault{why.reason, why.about}), ""};
}

/// Whose password a body tries; empty: nobody's.
std::string name_in(const std::string& body) {
  const auto parsed = nlohmann::json::parse(body, nullptr, false);
  const bool has_name = parsed.is_object() && parsed.contains("name") && parsed["name"].is_string();
  return has_name ? parsed["name"].get<std::string>().substr(0, 64) : std::string{};
}

constexpr double kReadsAtOnce = 10.0;   // [s] worth of them
constexpr double kWritesAtOnce = 20.0;  // [s] likewise

CallRates rates_of(const ApiParams& params, const ForumParams& forum) {
  const auto calls = [](double per_second, double at_once) {
    return Rate{per_second, std::max(1.0, at_once * per_second)};
  };
  const auto in_a_while = [&](double count) { return Rate{count / forum.while_s, count}; };
  return {calls(params.reads_per_second, kReadsAtOnce), calls(params.writes_per_second, kWritesAtOnce),
          in_a_while(forum.posts_of_address), in_a_while(forum.reports_of_address)};
}

CountedCall counted(const ApiRequest& request, const Endpoint& endpoint, bool is_staff) {
  return {is_staff ? "login " + request.token : network_of(request.address), is_staff, request.is_far,
          endpoint.changes(), endpoint.scarce};
}

}  // namespace

Desk::Desk(ApiServices store, ApiServices staff, ApiServices passwords, const ApiParams& params,
           const ForumParams& forum, Clock clock)
    : params_{params},
      clock_{std::move(clock)},
      store_{std::move(store)},
      staff_{std::move(staff)},
      passwords_{std::move(passwords)},
      limits_{rates_of(params, forum)},
      door_{{.of_address = {params.logins_per_minute / 60.0, params.logins_per_minute},
             .of_name = {params.logins_per_minute / 60.0, params.logins_per_minute}}},
      store_worker_{static_cast<std::size_t>(params.calls_waiting)},
      staff_worker_{static_cast<std::size_t>(params.calls_waiting)},
      password_worker_{static_cast<std::size_t>(params.passwords_waiting)} {}

Result<std::unique_ptr<Desk>> Desk::open(const std::string& database, const ApiParams& params, const ForumParams& forum,
                                         Clock clock, const PasswordCost& cost,
                                         std::shared_ptr<const MuseumOffice> museum,
                                         std::shared_ptr<const SetupOffice> setup, Database::Try when,
                                         std::shared_ptr<const RobotOffice> robot) {
  std::array<ApiServices, 3> services;
  for (ApiServices& each : services) {
    auto opened = ApiServices::open(database, params, forum, cost, when);
    if (!opened) return tl::unexpected<Error>(opened.error());
    each = std::move(*opened);
    if (each.database->is_gone()) when = Database::Try::later;  // nobody waits for it three times
  }
  auto& [store, staff, passwords] = services;
  staff.museum = std::move(museum);
  staff.setup = std::move(setup);
  staff.robot = std::move(robot);
  std::unique_ptr<Desk> desk{
      new Desk{std::move(store), std::move(staff), std::move(passwords), params, forum, std::move(clock)}};
  if (auto learnt = desk->learn_places(desk->store_); !learnt && !desk->store_.database->is_gone())
    return tl::unexpected<Error>(learnt.error());
  return desk;
}

/// From where whoever has an account was let in before, and who is in.
Result<void> Desk::learn_places(ApiServices& services) {
  const auto live = services.accounts->logins_of_accounts(clock_());
  if (!live) return tl::unexpected<Error>(live.error());
  (void)logins_.learn(*live, clock_());
  auto places = services.accounts->places();
  if (!places) return tl::unexpected<Error>(places.error());
  for (const auto& [name, network] : *places) door_.know(name, network);
  knows_places_ = true;
  return {};
}

bool Desk::is_staff_from(const std::string& address) const { return door_.is_from(network_of(address)); }

void Desk::take(ApiRequest request, std::function<void(ApiReply)> answer) {
  std::map<std::string, std::string> path;
  const auto found = find_endpoint(endpoints(), request.method, request.target, path);
  if (!found) return answer(refusal(found.error()));
  const Endpoint& endpoint = **found;
  if (request.is_far && (endpoint.is_dear || endpoint.least > Rank::visitor))
    return answer(refusal({ApiFault::not_allowed, "nearer to the robot"}));
  const bool is_staff = !request.is_far && logins_.find(request.token, clock_()).has_value();
  const CallLimits::Pace pace = limits_.take(counted(request, endpoint, is_staff), clock_());
  if (pace == CallLimits::Pace::too_fast) return answer(refusal({ApiFault::too_fast, ""}));
  if (pace == CallLimits::Pace::too_often) return answer(refusal({ApiFault::too_often, ""}));
  int rank = 0;
  if (endpoint.is_dear) {
    const std::string name = name_in(request.body);
    const std::string caller = network_of(request.address);
    if (!door_.may_try(name, caller, clock_())) return answer(refusal({ApiFault::too_fast, ""}));
    rank = door_.rank(name, caller);
  }
  // Shared, for a copy of it remains here when a worker is full.
  const auto call = std::make_shared<Call>(Call{endpoint, std::move(request), std::move(path), std::move(answer)});
  if (endpoint.is_dear) return post(password_worker_, passwords_, call, rank);
  if (is_staff) return post(staff_worker_, staff_, call);
  if (endpoint.least < Rank::moderator) return post(store_worker_, store_, call);
  // Whoever may change the museum is looked up among the visitors, and then waits behind none of them.
  const bool is_taken = store_worker_.post([this, call] {
    const auto login = login_of(store_, call->request.token, clock_());
    if (!login || !login->person.is_at_least(Rank::moderator))
      return call->answer(refusal({ApiFault::not_allowed, ""}));
    post(staff_worker_, staff_, call);
  });
  if (!is_taken) call->answer(refusal({ApiFault::busy, ""}));
}

void Desk::post(Worker& worker, ApiServices& services, const std::shared_ptr<Call>& call, int rank) {
  const auto refuse_it = [call] { call->answer(refusal({ApiFault::busy, ""})); };
  const bool is_taken =
      worker.post([this, &services,
                   call] { call->answer(reply_to(services, call->request, call->endpoint, std::move(call->path))); },
                  rank, refuse_it);
  if (!is_taken) refuse_it();
}

ApiReply Desk::reply_to(ApiServices& services, const ApiRequest& request, const Endpoint& endpoint,
                        std::map<std::string, std::string> path) {
  ApiCall call{services, request, std::nullopt, {}, std::move(path), {}, clock_(), {}, {}, {}};
  auto document = answer(call, endpoint);
  const bool is_wrong = !document && document.error().reason == ApiFault::wrong_password;
  note_logins(call, endpoint.is_dear ? name_in(request.body) : "", is_wrong);
  if (!document) {
    ApiRefusal why = document.error();
    // Where it is stored and why not is nobody's business but an operator's.
    if (why.reason == ApiFault::not_stored && !call.person.is_at_least(Rank::operator_)) why.about.clear();
    return refusal(why);
  }
  return {200, document->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), std::move(call.set_cookie)};
}

void Desk::note_logins(const ApiCall& call, const std::string& name, bool is_wrong) {
  const std::string caller = network_of(call.request.address);
  if (is_wrong) door_.was_wrong(caller, call.now);
  if (call.ended) {
    logins_.end(*call.ended);
    tell_ended(hash_token(call.ended->token));
  }
  if (!call.begun) return;
  logins_.keep(*call.begun, call.now);
  if (!name.empty()) door_.know(name, caller);
}

void Desk::when_ended(std::function<void(const std::string& login)> told) {
  const std::scoped_lock lock{ended_mutex_};
  ended_ = std::move(told);
}

void Desk::tell_ended(const std::string& login) {
  const std::scoped_lock lock{ended_mutex_};
  if (ended_) ended_(login);
}

/// As the database has it; while that does not answer, as it was.
std::optional<Login> Desk::login_of(ApiServices& services, const std::string& token, Time now) {
  auto login = services.accounts->find(token, now);
  if (!login) return logins_.find(token, now);
  if (*login) logins_.keep(**login, now);
  return std::move(*login);
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
  if (!request.is_of_ours) return refuse(ApiFault::other_site);
  if (!request.token.empty()) {
    call.login = login_of(call.services, request.token, call.now);
    // A login with an account is for nearer: on the far line it is none, and its token is not told.
    if (request.is_far && call.login && call.login->person.is_at_least(Rank::moderator)) call.login.reset();
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
  } else if (!request.body.empty()) {
    return refuse(ApiFault::not_understood, "a body where none belongs");
  }
  auto document = endpoint.handle(call, body);
  if (document && endpoint.changes() && endpoint.least >= Rank::moderator) {
    std::string about;
    for (const auto& [name, value] : call.path) about += (about.empty() ? "" : " ") + value;
    auto noted = call.services.audit->add({call.now, call.person.id, endpoint.name, about, request.address});
    if (!noted) return refuse(ApiFault::not_stored, public_reason(noted.error()));
  }
  return document;
}

void Desk::admit(std::string token, std::function<void(Admitted)> answer) {
  const auto admission = [token](const std::optional<Login>& login) {
    const bool is_operator = login && login->person.is_at_least(Rank::operator_);
    return is_operator ? std::optional{Admission{login->person.name, hash_token(token)}} : std::nullopt;
  };
  // Whoever is known waits for no database, and whoever has nothing to show neither.
  if (token.empty()) return answer(std::optional<Admission>{});
  if (const auto known = logins_.find(token, clock_())) return answer(admission(known));
  const auto tell = std::make_shared<std::function<void(Admitted)>>(std::move(answer));
  const bool is_taken = store_worker_.post([this, token, admission, tell] {
    const auto login = login_of(store_, token, clock_());
    const bool is_unknown = !login && store_.database->is_gone();
    (*tell)(is_unknown ? Admitted{fail("the database does not answer")} : Admitted{admission(login)});
  });
  if (!is_taken) (*tell)(fail("too many wait"));
}

void Desk::note(std::string who, std::string what, std::string about) {
  // Should it not be stored, what was done is done; a stop must not wait for a disk.
  (void)staff_worker_.post([this, who = std::move(who), what = std::move(what), about = std::move(about)] {
    (void)staff_.audit->add({clock_(), who, what, about, ""});
  });
}

void Desk::look() {
  if (is_looking_.exchange(true)) return;
  const bool is_taken = staff_worker_.post([this] {
    const Time now = clock_();
    is_looking_ = false;
    if (!knows_places_) (void)learn_places(staff_);  // else a second later
    const auto live = staff_.accounts->logins_of_accounts(now);
    if (!live) return;  // while nobody answers, whoever is in stays in
    for (const std::string& login : logins_.learn(*live, now)) tell_ended(login);
  });
  if (!is_taken) is_looking_ = false;
}

void Desk::tidy() {
  (void)store_worker_.post([this] {
    const Time now = clock_();
    store_.accounts->forget_before(now);
    store_.audit->forget(now);
  });
}

}  // namespace docent::telepresence
