#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/accounts/person.h"
#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

/// held: until a moderator has read it, only its author and moderators see it.
enum class PostState { held, shown, hidden };
constexpr auto words_of(PostState) { return std::array{"held", "shown", "hidden"}; }

struct Post {
  std::string id;      ///< a UUIDv7
  std::string thread;  ///< the id of its first post
  std::string person;  ///< who wrote it
  std::string name;    ///< theirs
  std::string title;   ///< of the thread; empty but for the first post
  std::string text;    ///< plain, lines separated by \n
  Time written;
  PostState state = PostState::held;
  std::int64_t reports = 0;   ///< networks from which somebody finds that it should not stand there
  Rank rank = Rank::visitor;  ///< its author's, when it was written
};

/// A thread as a list shows it.
struct Thread {
  Post first;
  Time latest;             ///< when the last of its posts that are shown was written
  std::int64_t posts = 0;  ///< that are shown
};

struct ForumParams {
  int page = 20;              ///< threads or posts that are given at a time
  int posts_in_a_while = 5;   ///< that one person may write in
  double while_s = 600.0;     ///< [s] so long
  int posts_of_address = 20;  ///< likewise, that all who come from one address may write; all far visitors: five times
  int reports_of_address = 20;  ///< likewise, of posts that should not stand there
  int reports_that_hold = 3;    ///< by so many people: a moderator is to read it again
  template <class V>
  void visit(V& v) {
    v("page", page);
    v("posts_in_a_while", posts_in_a_while);
    v("while_s", while_s);
    v("posts_of_address", posts_of_address);
    v("reports_of_address", reports_of_address);
    v("reports_that_hold", reports_that_hold);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Threads and posts. What changes is committed when a call returns. Several gateways may share the database. One
/// thread.
class Forum {
 public:
  static constexpr std::size_t kLongestTitle = 100;  ///< characters
  static constexpr std::size_t kLongestText = 2000;  ///< characters

  /// What became of a post.
  enum class Written { held, shown, too_often, no_thread, empty };

  /// Makes its tables where there are none. The database outlives it.
  [[nodiscard]] static Result<std::unique_ptr<Forum>> open(Database& database, const ForumParams& params = {});
  Forum(const Forum&) = delete;
  Forum& operator=(const Forum&) = delete;

  /// A page of threads, that with the newest post first. @param before  only those whose newest post is older
  [[nodiscard]] Result<std::vector<Thread>> threads(std::optional<Time> before);
  /// A page of a thread's posts, the oldest first, with those of `reader` that are held; moderators see all.
  /// @param after  only those with a greater id; empty: from the first
  [[nodiscard]] Result<std::vector<Post>> posts(const std::string& thread, const std::string& after,
                                                const Person& reader);
  /// What moderators have to read, the oldest first: held posts, and reported ones.
  [[nodiscard]] Result<std::vector<Post>> queue();

  /// @param post  id (a second time: nothing happens), thread (its own id: a new one) and title, text as they came
  [[nodiscard]] Result<Written> write(Post post, const Person& author, Time now);
  /// False: there is no such post.
  /// @param network  from which the reader comes: all of one count once
  [[nodiscard]] Result<bool> report(const std::string& post, const Person& reader, const std::string& network);
  /// What they write is read by a moderator before it is shown, as a new author's is.
  [[nodiscard]] Result<void> distrust(const std::string& person);
  /// A moderator has read it. Shown: from now on its author's posts are shown at once. False: there is no such post.
  [[nodiscard]] Result<bool> judge(const std::string& post, PostState verdict);
  /// All that somebody wrote is hidden.
  [[nodiscard]] Result<void> hide_all_of(const std::string& person);
  [[nodiscard]] Result<std::optional<Post>> find(const std::string& post);

 private:
  Forum(Database& database, const ForumParams& params) : database_{database}, params_{params} {}
  [[nodiscard]] Result<Written> insert(const Post& post);
  [[nodiscard]] Result<bool> is_trusted(const Person& person);

  Database& database_;
  ForumParams params_;
};

}  // namespace docent::telepresence
