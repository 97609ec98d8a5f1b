#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

/// How the Web's visitors vote in the present round.
struct Tally {
  std::string round;  ///< a UUIDv7: the id of the request that the robot makes of the most voted tour
  std::map<std::string, std::uint32_t> counts;  ///< by tour, of those that have votes
};

/// Which tour comes next is put to the vote, in rounds: one ends when the robot has taken its most voted tour
/// ([Minerva2000] 6.4). Several gateways may share the database. One thread.
class TourVotes {
 public:
  /// Makes its tables where there are none. The database outlives it.
  [[nodiscard]] static Result<std::unique_ptr<TourVotes>> open(Database& database);
  TourVotes(const TourVotes&) = delete;
  TourVotes& operator=(const TourVotes&) = delete;

  /// Committed to disk when it returns. Whoever votes again in a round changes their vote.
  /// @param voter  an id that the browser keeps
  [[nodiscard]] Result<void> vote(const std::string& voter, const std::string& tour, Time now);
  [[nodiscard]] Result<Tally> tally();
  /// The robot has taken the tour of this round: the next one begins, unless somebody else began it.
  /// @param next  a new UUIDv7
  [[nodiscard]] Result<void> close(const std::string& round, const std::string& next, Time now);
  /// Begins the first round where there is none.
  [[nodiscard]] Result<void> begin(const std::string& round, Time now);
  [[nodiscard]] Result<void> forget_before(Time time);

 private:
  explicit TourVotes(Database& database) : database_{database} {}

  Database& database_;
};

}  // namespace docent::telepresence
