#include "docent/telepresence/api/endpoint.h"

#include <charconv>

#include "docent/telepresence/client_message.h"

namespace docent::telepresence {
namespace {

constexpr std::string_view kRoot = "/api/v1";
constexpr std::size_t kLongestWithQuery = 500;

std::vector<std::string_view> parts_of(std::string_view path) {
  std::vector<std::string_view> parts;
  while (path.starts_with('/')) {
    path.remove_prefix(1);
    const auto end = std::min(path.find('/'), path.size());
    parts.push_back(path.substr(0, end));
    path.remove_prefix(end);
  }
  return parts;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::optional<std::string> decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i] == '+' ? ' ' : text[i];
      continue;
    }
    if (i + 2 >= text.size() || hex_value(text[i + 1]) < 0 || hex_value(text[i + 2]) < 0) return std::nullopt;
    result += static_cast<char>(16 * hex_value(text[i + 1]) + hex_value(text[i + 2]));
    i += 2;
  }
  return result;
}

bool fits(std::string_view pattern, std::string_view path, std::map<std::string, std::string>& names) {
  const auto wanted = parts_of(pattern);
  const auto given = parts_of(path);
  if (wanted.size() != given.size()) return false;
  names.clear();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i].starts_with('{')) {
      if (wanted[i] != given[i]) return false;
    } else if (!is_identifier(given[i])) {
      return false;
    } else {
      names[std::string{wanted[i].substr(1, wanted[i].size() - 2)}] = given[i];
    }
  }
  return true;
}

}  // namespace

Result<void> ApiParams::validate() const {
  if (!(login_hours > 0.0)) return fail("web.api.login_hours must be > 0");
  if (!(visitor_days > 0.0)) return fail("web.api.visitor_days must be > 0");
  if (!(away_days > 0.0)) return fail("web.api.away_days must be > 0");
  if (!(reads_per_second > 0.0)) return fail("web.api.reads_per_second must be > 0");
  if (!(writes_per_second > 0.0)) return fail("web.api.writes_per_second must be > 0");
  if (!(logins_per_minute >= 1.0)) return fail("web.api.logins_per_minute must be at least 1");
  if (passwords_waiting < 1) return fail("web.api.passwords_waiting must be at least 1");
  if (calls_waiting < 1) return fail("web.api.calls_waiting must be at least 1");
  return {};
}

constexpr Duration kPatience = std::chrono::seconds{2};  // a database that hangs for so long is gone

Result<ApiServices> ApiServices::open(const std::string& where, const ApiParams& params, const ForumParams& forum,
                                      const PasswordCost& cost, Database::Try when) {
  ApiServices services;
  const auto take = [](auto& place, auto opened) -> Result<void> {
    if (!opened) return tl::unexpected<Error>(opened.error());
    place = std::move(*opened);
    return {};
  };
  auto ready = take(services.database, Database::open(where, when));
  if (ready) ready = take(services.accounts, Accounts::open(*services.database, cost));
  if (ready) ready = take(services.forum, Forum::open(*services.database, forum));
  if (ready) ready = take(services.statistics, Statistics::open(*services.database));
  if (ready) ready = take(services.audit, Audit::open(*services.database));
  if (!ready) return tl::unexpected<Error>(ready.error());
  services.database->set_patience(kPatience);
  services.params = params;
  return services;
}

int status_of(ApiFault reason) {
  switch (reason) {
    case ApiFault::not_found:
      return 404;
    case ApiFault::wrong_method:
      return 405;
    case ApiFault::not_understood:
    case ApiFault::name_taken:
    case ApiFault::nothing_said:
      return 400;
    case ApiFault::too_large:
      return 413;
    case ApiFault::too_fast:
    case ApiFault::too_often:
      return 429;
    case ApiFault::wrong_password:
      return 401;
    case ApiFault::not_allowed:
    case ApiFault::other_site:
    case ApiFault::wrong_csrf:
    case ApiFault::sent_away:
      return 403;
    case ApiFault::must_stand:
    case ApiFault::outdated:
      return 409;
    case ApiFault::not_stored:
    case ApiFault::busy:
      break;
  }
  return 503;
}

std::string public_reason(const Error& why) {
  return why.message.find("the disk is full") != std::string::npos ? "the disk is full" : "the database";
}

std::optional<Time> time_of(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0.0 && value < 1e10)) return std::nullopt;
  return time_from_seconds(value);
}

ApiAnswer<const Endpoint*> find_endpoint(std::span<const Endpoint> all, std::string_view method,
                                         std::string_view target, std::map<std::string, std::string>& path) {
  const std::string_view whole = target.substr(0, target.find('?'));
  if (!whole.starts_with(kRoot)) return refuse(ApiFault::not_found);
  bool is_there = false;
  for (const Endpoint& candidate : all) {
    if (!fits(candidate.path, whole.substr(kRoot.size()), path)) continue;
    if (method == candidate.method) return &candidate;
    is_there = true;
  }
  return refuse(is_there ? ApiFault::wrong_method : ApiFault::not_found);
}

std::optional<std::map<std::string, std::string>> parse_query(std::string_view target) {
  std::map<std::string, std::string> query;
  if (target.size() > kLongestWithQuery) return std::nullopt;
  const auto begin = target.find('?');
  if (begin == std::string_view::npos) return query;
  target.remove_prefix(begin + 1);
  while (!target.empty()) {
    const auto end = std::min(target.find('&'), target.size());
    const std::string_view pair = target.substr(0, end);
    target.remove_prefix(std::min(end + 1, target.size()));
    const auto equals = std::min(pair.find('='), pair.size());
    auto name = decoded(pair.substr(0, equals));
    auto value = decoded(pair.substr(std::min(equals + 1, pair.size())));
    if (!name || !value || query.contains(*name)) return std::nullopt;
    query.emplace(std::move(*name), std::move(*value));
  }
  return query;
}

}  // namespace docent::telepresence
