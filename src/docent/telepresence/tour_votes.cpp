#include "docent/telepresence/tour_votes.h"

#include "docent/telepresence/store/migrations.h"

namespace docent::telepresence {
namespace {

// The open round is the one that is not closed; the index lets there be one alone.
constexpr Migration kVoteTables[] = {
    {"votes",
     "CREATE TABLE vote_rounds (round TEXT PRIMARY KEY, begun BIGINT NOT NULL, is_open BIGINT);"
     "CREATE UNIQUE INDEX one_open_round ON vote_rounds (is_open);"
     "CREATE TABLE votes (round TEXT NOT NULL, voter TEXT NOT NULL, tour TEXT NOT NULL, cast_at BIGINT NOT NULL,"
     " PRIMARY KEY (round, voter))"},
};
constexpr const char* kOpenRound = "(SELECT round FROM vote_rounds WHERE is_open = 1)";

}  // namespace

Result<std::unique_ptr<TourVotes>> TourVotes::open(Database& database) {
  if (auto made = migrate(database, "votes", kVoteTables); !made) return tl::unexpected<Error>(made.error());
  return std::unique_ptr<TourVotes>{new TourVotes{database}};
}

Result<void> TourVotes::begin(const std::string& round, Time now) {
  // A closed round has NULL there, of which an index may hold many.
  return done(database_.run("INSERT INTO vote_rounds (round, begun, is_open) VALUES ($1, $2, 1) ON CONFLICT DO NOTHING",
                            {round, now.nanoseconds}));
}

Result<void> TourVotes::vote(const std::string& voter, const std::string& tour, Time now) {
  auto cast = database_.run(std::string{"INSERT INTO votes (round, voter, tour, cast_at) SELECT round, $1, $2, $3 FROM "
                                        "vote_rounds WHERE is_open = 1 ON CONFLICT (round, voter) DO UPDATE SET tour = "
                                        "excluded.tour, cast_at = excluded.cast_at"},
                            {voter, tour, now.nanoseconds});
  if (cast && cast->changed == 0) return fail("no vote is under way");
  return done(cast);
}

Result<Tally> TourVotes::tally() {
  auto round = database_.run(std::string{"SELECT coalesce("} + kOpenRound + ", '')");
  if (!round) return tl::unexpected<Error>(round.error());
  Tally tally;
  tally.round = round->rows.at(0).text(0);
  auto counts = database_.run("SELECT tour, count(*) FROM votes WHERE round = $1 GROUP BY tour", {tally.round});
  if (!counts) return tl::unexpected<Error>(counts.error());
  for (const Row& row : counts->rows) tally.counts[row.text(0)] = static_cast<std::uint32_t>(row.number(1));
  return tally;
}

Result<void> TourVotes::close(const std::string& round, const std::string& next, Time now) {
  return database_.in_transaction([&]() -> Result<void> {
    auto closed = database_.run("UPDATE vote_rounds SET is_open = NULL WHERE round = $1 AND is_open = 1", {round});
    if (!closed) return tl::unexpected<Error>(closed.error());
    if (closed->changed == 0) return {};
    return begin(next, now);
  });
}

Result<void> TourVotes::forget_before(Time time) {
  if (auto votes = done(database_.run("DELETE FROM votes WHERE cast_at < $1", {time.nanoseconds})); !votes)
    return votes;
  return done(database_.run("DELETE FROM vote_rounds WHERE is_open IS NULL AND begun < $1", {time.nanoseconds}));
}

}  // namespace docent::telepresence
