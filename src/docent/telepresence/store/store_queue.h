#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

struct StoreQueueParams {
  std::size_t most_waiting = 1000;  ///< of strangers; more are refused: a database that is slow fills no memory
  std::size_t kept = 200;           ///< besides these, for the hall's screen, for staff and for what gateways note
  std::size_t most_together = 200;  ///< that are committed at once
  Duration patience = std::chrono::milliseconds{2500};  ///< then whoever waits is told that it is not stored
  /// After strangers' things the database is left to others, who store for themselves (logins, posts), for as long as
  /// these took: SQLite lets one at a time write, and whoever begins again at once is always first.
  Duration most_rest = std::chrono::milliseconds{50};
  bool at_once = false;  ///< crippled, for evaluation: the caller's thread stores, each thing by itself
};

/// What waits for a disk or for a server waits here, on a thread of its own, and nothing else waits with it. All that
/// has come meanwhile is committed together, so that two hundred votes cost one write; what is ours waits for at most
/// one such write of strangers. A database that is gone fails at once all that waits for it.
///
/// Whoever calls `put` and `look` is one thread, the caller's; `done` comes back to it through `post`.
class StoreQueue {
 public:
  /// On the store's thread. It may begin a transaction, which is then part of the common one. It is called a second
  /// time when something of its batch failed: what fails then is taken back alone.
  using Work = std::function<Result<void>()>;
  /// On the caller's thread, once.
  using Done = std::function<void(const Result<void>&)>;
  using Post = std::function<void(std::function<void()>)>;

  enum class Of { strangers, ours };

  /// @param database  which the work is done in; outlives it
  /// @param post  has something done on the caller's thread; empty: there is no thread, and `put` does the work itself
  StoreQueue(Database& database, Post post, const StoreQueueParams& params = {});
  StoreQueue(const StoreQueue&) = delete;
  StoreQueue& operator=(const StoreQueue&) = delete;
  ~StoreQueue() { finish(); }

  void put(Work work, Done done, Time now, Of whom = Of::ours);
  /// Now and then: tells those who wait for too long that it is not stored. It may still be, later.
  void look(Time now);
  /// Does what waits, and ends the thread. What is done then is told to nobody. @pre nothing is put any more
  void finish();
  /// Since when the oldest waits that nobody has been told of. @returns zero: nobody waits
  [[nodiscard]] Duration waits(Time now) const;

 private:
  struct Job {
    Work work;
    Done done;  ///< empty: it was told
    Time since;
    Result<void> result;
  };
  using Jobs = std::vector<std::shared_ptr<Job>>;

  [[nodiscard]] bool has_thread() const { return post_ && !params_.at_once; }
  void run(const std::weak_ptr<StoreQueue*>& queue);
  /// The next that are done together: ours and strangers' in turn, where both wait. @pre something waits; locked
  Jobs next(bool& is_of_strangers);
  void do_all(const Jobs& jobs);
  void tell(const Jobs& jobs);
  static void tell(Job& job, const Result<void>& result);

  Database& database_;
  const Post post_;
  const StoreQueueParams params_;
  std::deque<std::shared_ptr<Job>> told_of_;           ///< of the caller's thread: in the order of their coming
  std::shared_ptr<StoreQueue*> self_;                  ///< null once nobody may be told any more
  std::mutex mutex_;                                   ///< of the three below
  std::deque<std::shared_ptr<Job>> ours_, strangers_;  ///< who wait, in the order of their coming
  bool is_ending_ = false;
  std::condition_variable wakes_;
  std::thread thread_;  ///< last: it uses the others
};

}  // namespace docent::telepresence
