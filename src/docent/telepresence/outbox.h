#pragma once

#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/messages/request_messages.h"
#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

/// Requests that were acknowledged to a browser and are not yet on the request board (architecture 10.8, 10.9), as they
/// lie in the database. Several gateways may share it: each tells the robot what any of them took. One thread.
class Outbox {
 public:
  /// Makes its table where there is none. The database outlives it.
  [[nodiscard]] static Result<std::unique_ptr<Outbox>> open(Database& database);
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;

  /// Committed to disk when it returns. A request with a known id is left as it is: asking twice is asking once.
  /// @returns whether it is a new one
  [[nodiscard]] Result<bool> put(const docent_msgs::Request& request);
  /// What still has to be resent, oldest first.
  [[nodiscard]] Result<std::vector<docent_msgs::Request>> pending();
  /// The request is on the board, it need not be resent.
  [[nodiscard]] Result<void> delivered(const std::string& id);
  /// Forgets delivered requests made before `time`; gives up undelivered ones too.
  [[nodiscard]] Result<void> forget_before(Time time);

 private:
  explicit Outbox(Database& database) : database_{database} {}

  Database& database_;
};

}  // namespace docent::telepresence
