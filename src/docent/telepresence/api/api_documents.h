#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/telepresence/accounts/person.h"
#include "docent/telepresence/forum/forum.h"
#include "docent/vocabulary/vocabulary.h"

// What /api/v1 takes and gives, as structs: the one definition of it, like documents.h. Times are seconds since 1970.

namespace docent::telepresence {

/// Why a call was refused.
enum class ApiFault {
  not_found,       ///< no such path, or no such thing
  wrong_method,    ///< of that path
  not_understood,  ///< the body; `about` says what of it
  too_large,
  too_fast,
  not_allowed,     ///< for somebody of that rank
  other_site,      ///< a page of another site sent it
  wrong_csrf,      ///< the header Docent-Csrf
  wrong_password,  ///< or there is no such account
  sent_away,       ///< by a moderator
  too_often,       ///< more posts than one person may write
  name_taken,      ///< somebody with an account has it, or one that looks like it
  nothing_said,    ///< an empty text, or a thread without a title
  not_stored,      ///< the disk is full or gone
  must_stand,      ///< the robot first; somebody has to press the stop button
  outdated,        ///< somebody else has changed it since
  busy,
};
constexpr auto words_of(ApiFault) {
  return std::array{"not_found",    "wrong_method", "not_understood", "too_large", "too_fast",  "not_allowed",
                    "other_site",   "wrong_csrf",   "wrong_password", "sent_away", "too_often", "name_taken",
                    "nothing_said", "not_stored",   "must_stand",     "outdated",  "busy"};
}

}  // namespace docent::telepresence

namespace docent::telepresence::documents {

struct Fault {
  static constexpr const char* kName = "Fault";
  ApiFault reason{};
  std::string about;  ///< in English, for whoever writes a program; empty: nothing more
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("reason", d.reason), v("about", d.about);
  }
};

struct Nothing {
  static constexpr const char* kName = "Nothing";
  template <class Self, class V>
  static void visit(Self& /*d*/, V& /*v*/) {}
};

struct NewLogin {
  static constexpr const char* kName = "NewLogin";
  std::string name, password;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("name", d.name), v("password", d.password);
  }
};
struct NewVisitor {
  static constexpr const char* kName = "NewVisitor";
  std::string name;  ///< that others see
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("name", d.name);
  }
};
struct Me {
  static constexpr const char* kName = "Me";
  std::string name;
  Rank rank{};
  std::string csrf;    ///< to be sent as header Docent-Csrf with everything that changes something; empty: no login
  double expires = 0;  ///< 0: no login
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("name", d.name), v("rank", d.rank), v("csrf", d.csrf), v("expires", d.expires);
  }
};

struct ForumThread {
  static constexpr const char* kName = "ForumThread";
  std::string id, title, name;
  double written = 0, latest = 0;
  std::int64_t posts = 0;
  Rank rank{};  ///< of whoever began it
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("title", d.title), v("name", d.name), v("written", d.written), v("latest", d.latest);
    v("posts", d.posts), v("rank", d.rank);
  }
};
struct ForumThreads {
  static constexpr const char* kName = "ForumThreads";
  std::vector<ForumThread> threads;
  bool is_last = false;  ///< there are no older ones
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("threads", d.threads), v("is_last", d.is_last);
  }
};
struct ForumPost {
  static constexpr const char* kName = "ForumPost";
  std::string id, thread, name, title, text;
  double written = 0;
  PostState state{};
  std::int64_t reports = 0;  ///< 0 for all but moderators
  bool is_own = false;       ///< the reader wrote it
  Rank rank{};               ///< the author's
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("thread", d.thread), v("name", d.name), v("title", d.title), v("text", d.text);
    v("written", d.written), v("state", d.state), v("reports", d.reports), v("is_own", d.is_own);
    v("rank", d.rank);
  }
};
struct ForumPosts {
  static constexpr const char* kName = "ForumPosts";
  std::vector<ForumPost> posts;
  bool is_last = false;  ///< there are no later ones
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("posts", d.posts), v("is_last", d.is_last);
  }
};
struct NewPost {
  static constexpr const char* kName = "NewPost";
  std::string id;  ///< a UUIDv7 that the page has made: sent twice, it is written once
  std::string title, text;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("title", d.title), v("text", d.text);
  }
};
struct PostWritten {
  static constexpr const char* kName = "PostWritten";
  PostState state{};
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("state", d.state);
  }
};
struct Verdict {
  static constexpr const char* kName = "Verdict";
  PostState state{};
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("state", d.state);
  }
};

struct AuditLine {
  static constexpr const char* kName = "AuditLine";
  double time = 0;
  std::string who, what, about, address;
  std::int64_t count = 1;  ///< wrong passwords of an hour, an account and an address are one line
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("time", d.time), v("who", d.who), v("what", d.what), v("about", d.about), v("address", d.address);
    v("count", d.count);
  }
};
struct AuditLines {
  static constexpr const char* kName = "AuditLines";
  std::vector<AuditLine> lines;
  std::string next;  ///< `before` of the next page; empty: this was the last
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("lines", d.lines), v("next", d.next);
  }
};

struct StatisticsDay {
  static constexpr const char* kName = "StatisticsDay";
  std::string day, mode;
  std::int64_t web_visitors = 0;
  std::map<std::string, double> counts;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("day", d.day), v("mode", d.mode), v("web_visitors", d.web_visitors), v("counts", d.counts);
  }
};
/// How many people stood round the robot when it had explained a stop of a tour.
struct TourStopCount {
  static constexpr const char* kName = "TourStopCount";
  std::string day, mode;
  double tour_began = 0;  ///< [s] since 1970
  std::string tour;
  int stop = 0;  ///< of those that the tour has shown, from 1
  std::string exhibit;
  int people = 0;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("day", d.day), v("mode", d.mode), v("tour_began", d.tour_began), v("tour", d.tour), v("stop", d.stop),
        v("exhibit", d.exhibit), v("people", d.people);
  }
};
struct StatisticsDays {
  static constexpr const char* kName = "StatisticsDays";
  std::vector<StatisticsDay> days;
  std::vector<TourStopCount> attendance;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("days", d.days), v("attendance", d.attendance);
  }
};

struct AccountLine {
  static constexpr const char* kName = "AccountLine";
  std::string name;
  Rank rank{};
  double created = 0;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("name", d.name), v("rank", d.rank), v("created", d.created);
  }
};
struct AccountLines {
  static constexpr const char* kName = "AccountLines";
  std::vector<AccountLine> accounts;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("accounts", d.accounts);
  }
};

}  // namespace docent::telepresence::documents
