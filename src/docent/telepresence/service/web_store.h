#pragma once

#include <memory>
#include <string>
#include <vector>

#include "docent/telepresence/counting/statistics.h"
#include "docent/telepresence/outbox.h"
#include "docent/telepresence/store/database.h"
#include "docent/telepresence/tour_votes.h"

namespace docent::telepresence {

/// What lies in the database of the service. Once that has begun it is used on the thread of its queue alone.
struct WebStore {
  static constexpr Duration kPatience = std::chrono::seconds{2};  ///< whoever hangs for so long is gone

  std::unique_ptr<Database> database;
  std::unique_ptr<Outbox> outbox;
  std::vector<docent_msgs::Request> pending;  ///< what lay in the outbox
  std::unique_ptr<TourVotes> votes;
  std::unique_ptr<Statistics> statistics;
  static Result<WebStore> open(const std::string& where) {
    auto database = Database::open(where);
    if (!database) return tl::unexpected<Error>(database.error());
    auto outbox = Outbox::open(**database);
    if (!outbox) return tl::unexpected<Error>(outbox.error());
    auto pending = (*outbox)->pending();
    if (!pending && (*database)->is_gone()) pending.emplace();  // it is read again and again where others write, too
    if (!pending) return tl::unexpected<Error>(pending.error());
    auto votes = TourVotes::open(**database);
    if (!votes) return tl::unexpected<Error>(votes.error());
    auto statistics = Statistics::open(**database);
    if (!statistics) return tl::unexpected<Error>(statistics.error());
    (*database)->set_patience(kPatience);
    return WebStore{std::move(*database), std::move(*outbox), std::move(*pending), std::move(*votes),
                    std::move(*statistics)};
  }
};

}  // namespace docent::telepresence
