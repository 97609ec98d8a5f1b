#include "docent/telepresence/forum/forum.h"

#include "docent/telepresence/client_message.h"
#include "docent/telepresence/store/migrations.h"

namespace docent::telepresence {
namespace {

constexpr Migration kTables[] = {
    {"forum",
     "CREATE TABLE posts (id TEXT PRIMARY KEY, thread TEXT NOT NULL, person TEXT NOT NULL, name TEXT NOT NULL,"
     " title TEXT NOT NULL, text TEXT NOT NULL, written BIGINT NOT NULL, state TEXT NOT NULL);"
     "CREATE INDEX posts_of_thread ON posts (thread, id);"
     "CREATE INDEX posts_of_person ON posts (person, written);"
     "CREATE INDEX posts_by_state ON posts (state, written);"
     "CREATE TABLE post_reports (post TEXT NOT NULL, person TEXT NOT NULL, PRIMARY KEY (post, person));"
     "CREATE TABLE trusted_authors (person TEXT PRIMARY KEY)"},
    {"ranks and networks",
     "ALTER TABLE posts ADD COLUMN rank TEXT NOT NULL DEFAULT 'visitor';"
     "UPDATE posts SET rank = 'moderator' WHERE person LIKE 'account:%';"
     "ALTER TABLE post_reports ADD COLUMN network TEXT NOT NULL DEFAULT ''"},
};

/// Of whom a report counts: whoever comes from one network is one, however many names they have.
const std::string kReporters = "(SELECT count(DISTINCT CASE network WHEN '' THEN person ELSE network END)";

const std::string kColumns =
    "posts.id, posts.thread, posts.person, posts.name, posts.title, posts.text, posts.written, posts.state, " +
    kReporters + " FROM post_reports WHERE post_reports.post = posts.id), posts.rank";

Post post_of(const Row& row) {
  return {row.text(0),         row.text(1),
          row.text(2),         row.text(3),
          row.text(4),         row.text(5),
          Time{row.number(6)}, parse<PostState>(row.text(7)).value_or(PostState::hidden),
          row.number(8),       parse<Rank>(row.text(9)).value_or(Rank::visitor)};
}

Result<std::vector<Post>> posts_of(const Result<QueryResult>& rows) {
  if (!rows) return tl::unexpected<Error>(rows.error());
  std::vector<Post> posts;
  for (const Row& row : rows->rows) posts.push_back(post_of(row));
  return posts;
}

}  // namespace

Result<void> ForumParams::validate() const {
  if (page < 1 || page > 100) return fail("web.forum.page must be 1 to 100");
  if (posts_in_a_while < 1) return fail("web.forum.posts_in_a_while must be at least 1");
  if (!(while_s > 0.0)) return fail("web.forum.while_s must be > 0");
  if (posts_of_address < 1) return fail("web.forum.posts_of_address must be at least 1");
  if (reports_of_address < 1) return fail("web.forum.reports_of_address must be at least 1");
  if (reports_that_hold < 1) return fail("web.forum.reports_that_hold must be at least 1");
  return {};
}

Result<std::unique_ptr<Forum>> Forum::open(Database& database, const ForumParams& params) {
  if (auto made = migrate(database, "forum", kTables); !made) return tl::unexpected<Error>(made.error());
  return std::unique_ptr<Forum>{new Forum{database, params}};
}

Result<std::vector<Thread>> Forum::threads(std::optional<Time> before) {
  constexpr std::int64_t kEver = INT64_MAX;
  auto rows = database_.run(
      "SELECT " + kColumns +
          ", shown.latest, shown.number FROM posts JOIN (SELECT thread, max(written) AS latest, count(*) AS number"
          " FROM posts WHERE state = 'shown' GROUP BY thread) AS shown ON shown.thread = posts.id"
          " WHERE posts.state = 'shown' AND shown.latest < $1 ORDER BY shown.latest DESC LIMIT $2",
      {before ? before->nanoseconds : kEver, std::int64_t{params_.page}});
  if (!rows) return tl::unexpected<Error>(rows.error());
  std::vector<Thread> threads;
  for (const Row& row : rows->rows) threads.push_back({post_of(row), Time{row.number(10)}, row.number(11)});
  return threads;
}

Result<std::vector<Post>> Forum::posts(const std::string& thread, const std::string& after, const Person& reader) {
  const std::int64_t sees_all = reader.is_at_least(Rank::moderator) ? 1 : 0;
  return posts_of(database_.run("SELECT " + kColumns +
                                    " FROM posts WHERE thread = $1 AND id > $2 AND ($3 = 1 OR state = 'shown' OR "
                                    "(state = 'held' AND person = $4))"
                                    " ORDER BY id LIMIT $5",
                                {thread, after, sees_all, reader.id, std::int64_t{params_.page}}));
}

Result<std::vector<Post>> Forum::queue() {
  return posts_of(database_.run("SELECT " + kColumns +
                                    " FROM posts WHERE state = 'held' OR (state = 'shown' AND EXISTS"
                                    " (SELECT 1 FROM post_reports WHERE post_reports.post = posts.id))"
                                    " ORDER BY written, id LIMIT $1",
                                {std::int64_t{params_.page}}));
}

Result<bool> Forum::is_trusted(const Person& person) {
  if (person.is_at_least(Rank::moderator)) return true;
  auto rows = database_.run("SELECT 1 FROM trusted_authors WHERE person = $1", {person.id});
  if (!rows) return tl::unexpected<Error>(rows.error());
  return !rows->rows.empty();
}

Result<Forum::Written> Forum::write(Post post, const Person& author, Time now) {
  post.person = author.id;
  post.rank = author.rank;
  post.name = clean_name(author.name);
  post.title = clean_name(post.title, kLongestTitle);
  post.text = clean_text(post.text, kLongestText);
  post.written = now;
  const bool is_new_thread = post.thread == post.id;
  if (!is_new_thread) post.title.clear();
  if (post.text.empty() || (is_new_thread && post.title.empty())) return Written::empty;
  auto is_known = is_trusted(author);
  if (!is_known) return tl::unexpected<Error>(is_known.error());
  post.state = *is_known ? PostState::shown : PostState::held;
  return insert(post);
}

Result<Forum::Written> Forum::insert(const Post& post) {
  if (post.thread != post.id) {
    auto first = database_.run("SELECT 1 FROM posts WHERE id = $1 AND thread = $1 AND state = 'shown'", {post.thread});
    if (!first) return tl::unexpected<Error>(first.error());
    if (first->rows.empty()) return Written::no_thread;
  }
  if (post.state == PostState::held || !post.person.starts_with("account:")) {
    auto written = database_.run("SELECT count(*) FROM posts WHERE person = $1 AND written > $2 AND id <> $3",
                                 {post.person, (post.written - seconds(params_.while_s)).nanoseconds, post.id});
    if (!written) return tl::unexpected<Error>(written.error());
    if (written->rows.at(0).number(0) >= params_.posts_in_a_while) return Written::too_often;
  }
  auto stored = database_.run(
      "INSERT INTO posts (id, thread, person, name, title, text, written, state, rank)"
      " VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9) ON CONFLICT (id) DO NOTHING",
      {post.id, post.thread, post.person, post.name, post.title, post.text, post.written.nanoseconds,
       to_text(post.state), to_text(post.rank)});
  if (!stored) return tl::unexpected<Error>(stored.error());
  return post.state == PostState::shown ? Written::shown : Written::held;
}

Result<bool> Forum::report(const std::string& post, const Person& reader, const std::string& network) {
  bool is_there = false;
  auto noted = database_.in_transaction([&]() -> Result<void> {
    auto found = database_.run("SELECT 1 FROM posts WHERE id = $1 AND state = 'shown'", {post});
    if (!found) return done(found);
    is_there = !found->rows.empty();
    if (!is_there) return {};
    auto reported = database_.run(
        "INSERT INTO post_reports (post, person, network) VALUES ($1, $2, $3)"
        " ON CONFLICT (post, person) DO NOTHING",
        {post, reader.id, network});
    if (!reported) return done(reported);
    return done(database_.run("UPDATE posts SET state = 'held' WHERE id = $1 AND $2 <= " + kReporters +
                                  " FROM post_reports WHERE post_reports.post = $1)",
                              {post, std::int64_t{params_.reports_that_hold}}));
  });
  if (!noted) return tl::unexpected<Error>(noted.error());
  return is_there;
}

Result<bool> Forum::judge(const std::string& post, PostState verdict) {
  bool is_there = false;
  auto judged = database_.in_transaction([&]() -> Result<void> {
    auto changed = database_.run("UPDATE posts SET state = $2 WHERE id = $1", {post, to_text(verdict)});
    if (!changed) return done(changed);
    is_there = changed->changed > 0;
    auto forgotten = database_.run("DELETE FROM post_reports WHERE post = $1", {post});
    if (!forgotten || verdict != PostState::shown) return done(forgotten);
    return done(
        database_.run("INSERT INTO trusted_authors (person) SELECT person FROM posts WHERE id = $1"
                      " ON CONFLICT (person) DO NOTHING",
                      {post}));
  });
  if (!judged) return tl::unexpected<Error>(judged.error());
  return is_there;
}

Result<void> Forum::distrust(const std::string& person) {
  return done(database_.run("DELETE FROM trusted_authors WHERE person = $1", {person}));
}

Result<void> Forum::hide_all_of(const std::string& person) {
  return database_.in_transaction([&]() -> Result<void> {
    auto hidden = database_.run("UPDATE posts SET state = 'hidden' WHERE person = $1", {person});
    if (!hidden) return done(hidden);
    return done(database_.run("DELETE FROM trusted_authors WHERE person = $1", {person}));
  });
}

Result<std::optional<Post>> Forum::find(const std::string& post) {
  auto found = posts_of(database_.run("SELECT " + kColumns + " FROM posts WHERE id = $1", {post}));
  if (!found) return tl::unexpected<Error>(found.error());
  return found->empty() ? std::nullopt : std::optional{found->front()};
}

}  // namespace docent::telepresence
