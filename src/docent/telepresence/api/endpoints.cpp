#include <algorithm>
#include <cmath>

#include "docent/telepresence/accounts/look_alikes.h"
#include "docent/telepresence/api/endpoint.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/limits/network.h"

namespace docent::telepresence {
namespace {

using documents::Nothing;

/// What the store could not do.
tl::unexpected<ApiRefusal> unstored(const Error& why) { return refuse(ApiFault::not_stored, public_reason(why)); }

Result<void> note(ApiCall& call, const std::string& who, const char* what, std::string about = {}) {
  return call.services.audit->add({call.now, who, what, std::move(about), call.request.address});
}

/// One line an hour: who guesses names and passwords buries nothing.
Result<void> note_wrong_password(ApiCall& call, const std::string& name) {
  const auto is_one = call.services.accounts->has(name);
  if (!is_one) return tl::unexpected<Error>(is_one.error());
  return call.services.audit->count(
      {call.now, *is_one ? name : Audit::kNobody, "wrong_password", "", network_of(call.request.address)});
}

std::string cookie_of(const std::string& token, double seconds_it_lasts, bool is_secure) {
  return std::string{kLoginCookie} + "=" + token +
         "; Path=/; HttpOnly; SameSite=Strict; Max-Age=" + std::to_string(std::llround(seconds_it_lasts)) +
         (is_secure ? "; Secure" : "");
}

documents::Me me_of(const std::optional<Login>& login) {
  if (!login) return {"", Rank::viewer, "", 0.0};
  return {login->person.name, login->person.rank, login->csrf, to_seconds(login->expires)};
}

ApiAnswer<documents::Me> begin_login(ApiCall& call, const Person& person, double lifetime) {
  if (call.login) {
    if (auto ended = call.services.accounts->end(call.login->token); !ended) return unstored(ended.error());
    call.ended = call.login;
  }
  auto login = call.services.accounts->begin(person, call.request.address, lifetime, call.now);
  if (!login) return unstored(login.error());
  call.set_cookie = cookie_of(login->token, lifetime, call.services.params.secure_cookies);
  call.begun = *login;
  return me_of(*login);
}

ApiAnswer<documents::Me> log_in(ApiCall& call, const documents::NewLogin& wish) {
  auto person = call.services.accounts->check(wish.name, wish.password);
  if (!person) return unstored(person.error());
  if (!*person) {
    if (auto noted = note_wrong_password(call, clean_name(wish.name)); !noted) return unstored(noted.error());
    return refuse(ApiFault::wrong_password);
  }
  // One commit: whoever logs in waits once for a disk that others keep busy.
  ApiAnswer<documents::Me> me = refuse(ApiFault::not_stored);
  const auto stored = call.services.database->in_transaction([&]() -> Result<void> {
    if (auto noted = note(call, (*person)->id, "login"); !noted) return noted;
    const Accounts::Place place{wish.name, network_of(call.request.address)};
    if (auto known = call.services.accounts->remember(place, call.now); !known) return known;
    me = begin_login(call, **person, 3600.0 * call.services.params.login_hours);
    return me ? Result<void>{} : fail(me.error().about);
  });
  if (!stored) {
    call.begun.reset();
    call.ended.reset();
    call.set_cookie.clear();
    return unstored(stored.error());
  }
  return me;
}

/// Of somebody with an account, or what looks like it.
ApiAnswer<bool> is_taken(ApiCall& call, const std::string& name) {
  const auto accounts = call.services.accounts->list();
  if (!accounts) return unstored(accounts.error());
  return std::any_of(accounts->begin(), accounts->end(),
                     [&](const auto& account) { return looks_like(name, account.name); });
}

ApiAnswer<documents::Me> name_oneself(ApiCall& call, const documents::NewVisitor& wish) {
  const auto away = call.services.accounts->is_sent_away(call.request.address, call.now);
  if (!away) return unstored(away.error());
  if (*away) return refuse(ApiFault::sent_away);
  const std::string name = clean_name(wish.name);
  if (name.empty()) return refuse(ApiFault::nothing_said);
  const auto taken = is_taken(call, name);
  if (!taken) return tl::unexpected<ApiRefusal>(taken.error());
  if (*taken) return refuse(ApiFault::name_taken);
  // Who has a name already keeps what they have written, and another name is not trusted for it.
  const bool is_visitor = call.login && call.login->person.rank == Rank::visitor;
  if (is_visitor && call.login->person.name != name) {
    if (auto done = call.services.forum->distrust(call.login->person.id); !done) return unstored(done.error());
  }
  const std::string id = is_visitor ? call.login->person.id : "v-" + make_token().substr(0, 32);
  return begin_login(call, {id, name, Rank::visitor}, 86400.0 * call.services.params.visitor_days);
}

ApiAnswer<Nothing> log_out(ApiCall& call, const Nothing& /*wish*/) {
  call.set_cookie = cookie_of("", 0.0, call.services.params.secure_cookies);
  if (!call.login) return Nothing{};
  call.ended = call.login;  // here at once, whatever the database says
  if (auto ended = call.services.accounts->end(call.login->token); !ended) return unstored(ended.error());
  return Nothing{};
}

documents::ForumPost post_for(const Post& post, const Person& reader) {
  return {post.id,
          post.thread,
          post.name,
          post.title,
          post.text,
          to_seconds(post.written),
          post.state,
          reader.is_at_least(Rank::moderator) ? post.reports : 0,
          !reader.id.empty() && post.person == reader.id,
          post.rank};
}

ApiAnswer<documents::ForumThreads> list_threads(ApiCall& call, const Nothing& /*wish*/) {
  std::optional<Time> before;
  if (const auto given = call.query.find("before"); given != call.query.end()) {
    before = time_of(given->second);
    if (!before) return refuse(ApiFault::not_understood, "before must be a time");
  }
  auto threads = call.services.forum->threads(before);
  if (!threads) return unstored(threads.error());
  documents::ForumThreads page;
  for (const Thread& thread : *threads)
    page.threads.push_back({thread.first.id, thread.first.title, thread.first.name, to_seconds(thread.first.written),
                            to_seconds(thread.latest), thread.posts, thread.first.rank});
  page.is_last = threads->empty();
  return page;
}

documents::ForumPosts page_of(const std::vector<Post>& posts, const Person& reader) {
  documents::ForumPosts page;
  for (const Post& post : posts) page.posts.push_back(post_for(post, reader));
  page.is_last = posts.empty();
  return page;
}

ApiAnswer<documents::ForumPosts> list_posts(ApiCall& call, const Nothing& /*wish*/) {
  const auto after = call.query.find("after");
  auto posts =
      call.services.forum->posts(call.path.at("thread"), after == call.query.end() ? "" : after->second, call.person);
  if (!posts) return unstored(posts.error());
  return page_of(*posts, call.person);
}

ApiAnswer<documents::PostWritten> write(ApiCall& call, const documents::NewPost& wish) {
  if (!is_uuid7(wish.id)) return refuse(ApiFault::not_understood, "id must be a UUID of version 7");
  const auto thread = call.path.find("thread");
  Post post;
  post.id = wish.id;
  post.thread = thread == call.path.end() ? wish.id : thread->second;
  post.title = wish.title;
  post.text = wish.text;
  if (call.person.rank == Rank::visitor) {  // an account may be newer than the visitor's name
    const auto taken = is_taken(call, call.person.name);
    if (!taken) return tl::unexpected<ApiRefusal>(taken.error());
    if (*taken) return refuse(ApiFault::name_taken);
  }
  const auto written = call.services.forum->write(std::move(post), call.person, call.now);
  if (!written) return unstored(written.error());
  switch (*written) {
    case Forum::Written::held:
      return documents::PostWritten{PostState::held};
    case Forum::Written::shown:
      return documents::PostWritten{PostState::shown};
    case Forum::Written::too_often:
      return refuse(ApiFault::too_often);
    case Forum::Written::no_thread:
      return refuse(ApiFault::not_found, "no such thread");
    case Forum::Written::empty:
      break;
  }
  return refuse(ApiFault::nothing_said);
}

ApiAnswer<Nothing> report(ApiCall& call, const Nothing& /*wish*/) {
  // From where somebody far away comes is only said: all of them count once, and hide nothing by themselves.
  const std::string network = call.request.is_far ? "far" : network_of(call.request.address);
  const auto reported = call.services.forum->report(call.path.at("post"), call.person, network);
  if (!reported) return unstored(reported.error());
  if (!*reported) return refuse(ApiFault::not_found, "no such post");
  return Nothing{};
}

ApiAnswer<documents::ForumPosts> moderation_queue(ApiCall& call, const Nothing& /*wish*/) {
  auto posts = call.services.forum->queue();
  if (!posts) return unstored(posts.error());
  return page_of(*posts, call.person);
}

ApiAnswer<Nothing> judge(ApiCall& call, const documents::Verdict& verdict) {
  const auto judged = call.services.forum->judge(call.path.at("post"), verdict.state);
  if (!judged) return unstored(judged.error());
  if (!*judged) return refuse(ApiFault::not_found, "no such post");
  return Nothing{};
}

ApiAnswer<Nothing> send_away(ApiCall& call, const Nothing& /*wish*/) {
  const auto post = call.services.forum->find(call.path.at("post"));
  if (!post) return unstored(post.error());
  if (!*post) return refuse(ApiFault::not_found, "no such post");
  const std::string& author = (*post)->person;
  if (author.starts_with("account:")) return refuse(ApiFault::not_allowed, "its author has an account");
  const Time until = call.now + seconds(86400.0 * call.services.params.away_days);
  auto done = call.services.accounts->send_away(author, until, call.now);
  if (done) done = call.services.forum->hide_all_of(author);
  if (!done) return unstored(done.error());
  return Nothing{};
}

ApiAnswer<documents::StatisticsDays> statistics(ApiCall& call, const Nothing& /*wish*/) {
  const auto from = call.query.find("from");
  const std::string first = from == call.query.end() ? "" : from->second;
  const auto days = call.services.statistics->days(first);
  if (!days) return unstored(days.error());
  const auto attendance = call.services.statistics->attendance(first);
  if (!attendance) return unstored(attendance.error());
  documents::StatisticsDays page;
  for (const DayCount& day : *days) {
    page.days.push_back({day.day, day.mode, day.web_visitors, {}});
    for (const auto& [what, amount] : day.counts) page.days.back().counts[to_text(what)] = amount;
  }
  for (const auto& [day, mode, stop] : *attendance)
    page.attendance.push_back(
        {day, mode, to_seconds(stop.tour_began - Time{}), stop.tour, stop.stop, stop.exhibit, stop.people});
  return page;
}

ApiAnswer<documents::AccountLines> list_accounts(ApiCall& call, const Nothing& /*wish*/) {
  const auto accounts = call.services.accounts->list();
  if (!accounts) return unstored(accounts.error());
  documents::AccountLines page;
  for (const Account& account : *accounts)
    page.accounts.push_back({account.name, account.rank, to_seconds(account.created)});
  return page;
}

std::vector<Endpoint> make_table() {
  using documents::Me;
  std::vector<Endpoint> table{
      endpoint<Nothing, Me>(at("GET", "/login", Rank::viewer, "who_am_i", "Who the caller is"),
                            [](ApiCall& call, const Nothing&) -> ApiAnswer<Me> { return me_of(call.login); }),
      endpoint<documents::NewLogin, Me>(
          at("POST", "/login", Rank::viewer, "login", "Begins the login of an account; sets a cookie"), log_in),
      endpoint<Nothing, Nothing>(at("DELETE", "/login", Rank::viewer, "logout", "Ends the login"), log_out),
      endpoint<documents::NewVisitor, Me>(
          at("POST", "/visitor", Rank::viewer, "name_oneself", "Takes a name, with which one may write; sets a cookie"),
          name_oneself),
      endpoint<Nothing, documents::ForumThreads>(at("GET", "/forum", Rank::viewer, "list_threads",
                                                    "A page of threads, that with the newest post first", {"before"}),
                                                 list_threads),
      endpoint<documents::NewPost, documents::PostWritten>(
          at("POST", "/forum", Rank::visitor, "begin_thread", "Begins a thread"), write),
      endpoint<Nothing, documents::ForumPosts>(at("GET", "/forum/{thread}", Rank::viewer, "list_posts",
                                                  "A page of a thread's posts, the oldest first", {"after"}),
                                               list_posts),
      endpoint<documents::NewPost, documents::PostWritten>(
          at("POST", "/forum/{thread}", Rank::visitor, "write_post", "Writes in a thread"), write),
      endpoint<Nothing, Nothing>(
          at("POST", "/posts/{post}/report", Rank::visitor, "report_post", "Says that a post should not stand there"),
          report),
      endpoint<Nothing, documents::ForumPosts>(at("GET", "/moderation", Rank::moderator, "moderation_queue",
                                                  "Posts that a moderator has to read, the oldest first"),
                                               moderation_queue),
      endpoint<documents::Verdict, Nothing>(
          at("PUT", "/posts/{post}", Rank::moderator, "judge_post", "Shows or hides a post"), judge),
      endpoint<Nothing, Nothing>(at("POST", "/posts/{post}/send_away", Rank::moderator, "send_away",
                                    "Sends the author of a post away for some days, and hides all that they wrote"),
                                 send_away),
      endpoint<Nothing, documents::StatisticsDays>(at("GET", "/statistics", Rank::moderator, "statistics",
                                                      "What was counted, by day and kind of hours", {"from"}),
                                                   statistics),
      endpoint<Nothing, documents::AccountLines>(
          at("GET", "/accounts", Rank::operator_, "list_accounts", "Who has an account"), list_accounts),
  };
  for (Endpoint& each : audit_endpoints()) table.push_back(std::move(each));
  for (Endpoint& each : museum_endpoints()) table.push_back(std::move(each));
  for (Endpoint& each : setup_endpoints()) table.push_back(std::move(each));
  for (Endpoint& each : robot_endpoints()) table.push_back(std::move(each));
  for (Endpoint& each : table) {
    const std::string_view name = each.name;
    each.is_dear = name == "login";
    if (name == "begin_thread" || name == "write_post") each.scarce = Scarce::posts;
    if (name == "report_post") each.scarce = Scarce::reports;
  }
  return table;
}

}  // namespace

Endpoint at(const char* method, const char* path, Rank least, const char* name, const char* summary,
            std::vector<const char*> query) {
  Endpoint what;
  what.method = method;
  what.path = path;
  what.least = least;
  what.name = name;
  what.summary = summary;
  what.query = std::move(query);
  return what;
}

std::span<const Endpoint> endpoints() {
  static const std::vector<Endpoint> kTable = make_table();
  return kTable;
}

}  // namespace docent::telepresence
