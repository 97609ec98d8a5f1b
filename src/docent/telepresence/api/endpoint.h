#pragma once

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "docent/telepresence/accounts/accounts.h"
#include "docent/telepresence/api/api_documents.h"
#include "docent/telepresence/api/audit.h"
#include "docent/telepresence/api/document_reader.h"
#include "docent/telepresence/api/exchange/exchange.h"
#include "docent/telepresence/api/schemas.h"
#include "docent/telepresence/counting/statistics.h"
#include "docent/telepresence/forum/forum.h"
#include "docent/telepresence/limits/call_limits.h"
#include "docent/telepresence/museum_office/museum_office.h"
#include "docent/telepresence/robot_office/robot_office.h"
#include "docent/telepresence/setup_office/setup_office.h"

// One table says what /api/v1 answers; from it come the dispatcher, docs/openapi.json, the page's types and the test of
// who may do what.

namespace docent::telepresence {

struct ApiParams {
  double login_hours = 12.0;       ///< that an account's login lasts
  double visitor_days = 30.0;      ///< that a visitor's name is remembered
  double away_days = 7.0;          ///< that somebody whom a moderator sends away stays away
  bool secure_cookies = false;     ///< the cookie goes through https only, also where no proxy says X-Forwarded-Proto
  double reads_per_second = 5.0;   ///< of one address, sustained; with 10 s worth of them at once
  double writes_per_second = 0.5;  ///< likewise, of what changes something; with 20 s worth at once
  double logins_per_minute = 6.0;  ///< tries of one address, and of one name; with as many at once
  int passwords_waiting = 8;       ///< that wait to be hashed; more are told to come back
  int calls_waiting = 64;          ///< likewise of all other calls
  template <class V>
  void visit(V& v) {
    v("login_hours", login_hours);
    v("visitor_days", visitor_days);
    v("away_days", away_days);
    v("secure_cookies", secure_cookies);
    v("reads_per_second", reads_per_second);
    v("writes_per_second", writes_per_second);
    v("logins_per_minute", logins_per_minute);
    v("passwords_waiting", passwords_waiting);
    v("calls_waiting", calls_waiting);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What the handlers work with; each worker has its own.
struct ApiServices {
  std::unique_ptr<Database> database;
  std::unique_ptr<Accounts> accounts;
  std::unique_ptr<Forum> forum;
  std::unique_ptr<Statistics> statistics;
  std::unique_ptr<Audit> audit;
  std::shared_ptr<const MuseumOffice> museum;  ///< null: no museum can be changed here
  std::shared_ptr<const SetupOffice> setup;    ///< null: no museum is set up here
  std::shared_ptr<const RobotOffice> robot;    ///< null: nobody sends the robot about from here
  ApiParams params;
  [[nodiscard]] static Result<ApiServices> open(const std::string& database, const ApiParams& params,
                                                const ForumParams& forum, const PasswordCost& cost,
                                                Database::Try when = Database::Try::now);
};

/// A call, whose caller may make it.
struct ApiCall {
  ApiServices& services;
  const ApiRequest& request;
  std::optional<Login> login;
  Person person;                             ///< a viewer without a login
  std::map<std::string, std::string> path;   ///< what stands for {names} in the path: identifiers
  std::map<std::string, std::string> query;  ///< decoded
  Time now;
  std::string set_cookie;      ///< what the answer shall set
  std::optional<Login> begun;  ///< a login that it began
  std::optional<Login> ended;  ///< one that it ended
};

struct ApiRefusal {
  ApiFault reason = ApiFault::not_found;
  std::string about;
};
template <class T>
using ApiAnswer = tl::expected<T, ApiRefusal>;
[[nodiscard]] inline tl::unexpected<ApiRefusal> refuse(ApiFault reason, std::string about = {}) {
  return tl::unexpected<ApiRefusal>(ApiRefusal{reason, std::move(about)});
}
[[nodiscard]] int status_of(ApiFault reason);

struct Endpoint {
  const char* method;
  const char* path;  ///< behind /api/v1, with {names}
  Rank least;        ///< that may call it
  const char* name;  ///< in the audit log and in OpenAPI
  const char* summary;
  std::vector<const char*> query;  ///< names that it understands
  bool is_dear = false;            ///< hashes a password
  Scarce scarce = Scarce::no;
  bool has_body = false;
  std::function<ApiAnswer<nlohmann::json>(ApiCall&, const nlohmann::json& body)> handle;
  std::function<nlohmann::json(Schemas&)> request, reply;
  [[nodiscard]] bool changes() const { return std::string_view{method} != "GET"; }
};

/// Those that change the museum.
[[nodiscard]] std::vector<Endpoint> museum_endpoints();
/// Reading the audit log.
[[nodiscard]] std::vector<Endpoint> audit_endpoints();
/// Those that set one up.
[[nodiscard]] std::vector<Endpoint> setup_endpoints();
/// Those that send the robot about.
[[nodiscard]] std::vector<Endpoint> robot_endpoints();
/// A row of the table, without what it does.
[[nodiscard]] Endpoint at(const char* method, const char* path, Rank least, const char* name, const char* summary,
                          std::vector<const char*> query = {});

/// The whole table.
[[nodiscard]] std::span<const Endpoint> endpoints();

/// The endpoint of that method and path. Error: not_found, or wrong_method.
/// @param path  receives what stands for {names}
[[nodiscard]] ApiAnswer<const Endpoint*> find_endpoint(std::span<const Endpoint> all, std::string_view method,
                                                       std::string_view target,
                                                       std::map<std::string, std::string>& path);
/// What a stranger may know of why something was not stored: no path, no text of a library.
[[nodiscard]] std::string public_reason(const Error& why);
/// [s] since 1970, as a query has it. nullopt: it is none
[[nodiscard]] std::optional<Time> time_of(const std::string& text);
/// What stands behind the '?', decoded. nullopt: it is no such thing, or too long.
[[nodiscard]] std::optional<std::map<std::string, std::string>> parse_query(std::string_view target);

template <Document Request, Document Reply>
[[nodiscard]] Endpoint endpoint(Endpoint what, std::function<ApiAnswer<Reply>(ApiCall&, const Request&)> handler) {
  what.has_body = !std::is_same_v<Request, documents::Nothing>;
  what.request = [](Schemas& schemas) { return schemas.add<Request>(); };
  what.reply = [](Schemas& schemas) { return schemas.add<Reply>(); };
  what.handle = [handler = std::move(handler)](ApiCall& call, const nlohmann::json& body) -> ApiAnswer<nlohmann::json> {
    const auto request = from_json<Request>(body);
    if (!request) return refuse(ApiFault::not_understood, request.error().message);
    auto reply = handler(call, *request);
    if (!reply) return tl::unexpected<ApiRefusal>(reply.error());
    return to_json(*reply);
  };
  return what;
}

}  // namespace docent::telepresence
