#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/messages/request_messages.h"
#include "docent/transport/bus.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {

/// The one place at a time to which an office's order wants the robot: a request of the staff, said until it stands on
/// the board; and what was wished for before, until the board shows it closed.
class OfficeWishes {
 public:
  /// @param over  what became of the wish: whether it was fulfilled, and why not
  OfficeWishes(transport::Bus& bus, const Rng& rng, std::function<void(bool, const std::string&)> over);

  void make(RequestKind kind, std::string target);
  void withdraw();
  /// Several times a second.
  void tick();

 private:
  void read(const docent_msgs::RequestBoard& board);
  void send(docent_msgs::Request request);
  [[nodiscard]] docent_msgs::Request request_of(RequestKind kind, std::string target);

  transport::Bus& bus_;
  Rng rng_;
  std::function<void(bool, const std::string&)> over_;
  transport::Publisher<docent_msgs::Request> requests_;
  std::optional<docent_msgs::Request> wish_;     ///< the one under way
  bool is_on_board_ = false;                     ///< and the mission has it
  std::vector<docent_msgs::Request> withdrawn_;  ///< withdrawals
  Time next_send_{};
};

}  // namespace docent::modules
