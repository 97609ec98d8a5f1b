#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/messages/request_messages.h"

namespace docent::telepresence {

/// Requests that were acknowledged to a browser and are not yet on the request board (architecture 10.8, 10.9).
/// A file of its own (SQLite, WAL); one writer. One thread.
class Outbox {
 public:
  /// Opens or makes the file. A damaged one is set aside as FILE.damaged and a new one begun: see `was_damaged`.
  [[nodiscard]] static Result<std::unique_ptr<Outbox>> open(const std::filesystem::path& path);
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;
  ~Outbox();

  /// Committed to disk when it returns. A request with a known id is left as it is: asking twice is asking once.
  [[nodiscard]] Result<void> put(const docent_msgs::Request& request);
  /// What still has to be resent, oldest first.
  [[nodiscard]] const std::vector<docent_msgs::Request>& pending() const { return pending_; }
  /// The request is on the board, it need not be resent.
  void delivered(const std::string& id);
  /// Forgets delivered requests made before `time`; gives up undelivered ones too.
  void forget_before(Time time);
  [[nodiscard]] bool was_damaged() const { return was_damaged_; }

 private:
  struct Database;
  explicit Outbox(std::unique_ptr<Database> database);
  [[nodiscard]] Result<void> read_pending();

  std::unique_ptr<Database> database_;
  std::vector<docent_msgs::Request> pending_;
  bool was_damaged_ = false;
};

}  // namespace docent::telepresence
