#pragma once

#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/messages/request_messages.h"
#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

/// Requests that were acknowledged to a browser and are not yet on the request board (architecture 10.8, 10.9). Several
/// gateways may share the database: each tells the robot what any of them took. One thread.
class Outbox {
 public:
  /// Makes its table where there is none. The database outlives it.
  [[nodiscard]] static Result<std::unique_ptr<Outbox>> open(Database& database);
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;

  /// Committed to disk when it returns. A request with a known id is left as it is: asking twice is asking once.
  [[nodiscard]] Result<void> put(const docent_msgs::Request& request);
  /// What still has to be resent, oldest first.
  [[nodiscard]] const std::vector<docent_msgs::Request>& pending() const { return pending_; }
  /// Reads again what is pending, for others write into a shared database.
  [[nodiscard]] Result<void> refresh();
  /// The request is on the board, it need not be resent.
  void delivered(const std::string& id);
  /// Forgets delivered requests made before `time`; gives up undelivered ones too.
  void forget_before(Time time);

 private:
  explicit Outbox(Database& database) : database_{database} {}

  Database& database_;
  std::vector<docent_msgs::Request> pending_;
};

}  // namespace docent::telepresence
