#pragma once

#include <memory>
#include <string>

#include "docent/telepresence/counting/statistics.h"
#include "docent/telepresence/outbox.h"
#include "docent/telepresence/store/database.h"
#include "docent/telepresence/tour_votes.h"

namespace docent::modules {

/// What lies in the database, on the bus's thread.
struct WebStore {
  std::unique_ptr<telepresence::Database> database;
  std::unique_ptr<telepresence::Outbox> outbox;
  std::unique_ptr<telepresence::TourVotes> votes;
  std::unique_ptr<telepresence::Statistics> statistics;
  static Result<WebStore> open(const std::string& where) {
    auto database = telepresence::Database::open(where);
    if (!database) return tl::unexpected<Error>(database.error());
    auto outbox = telepresence::Outbox::open(**database);
    if (!outbox) return tl::unexpected<Error>(outbox.error());
    auto votes = telepresence::TourVotes::open(**database);
    if (!votes) return tl::unexpected<Error>(votes.error());
    auto statistics = telepresence::Statistics::open(**database);
    if (!statistics) return tl::unexpected<Error>(statistics.error());
    return WebStore{std::move(*database), std::move(*outbox), std::move(*votes), std::move(*statistics)};
  }
};

}  // namespace docent::modules
