#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "docent/messages/operation_messages.h"
#include "docent/modules/shared/module.h"
#include "docent/telepresence/documents.h"
#include "docent/telepresence/museum_office/museum_office.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: what operators change of the museum, which the desk of /api/v1 does on a thread of its own,
/// and then tells all modules to begin anew.
class MuseumDesk {
 public:
  /// The bus outlives it. What has become of its office is used no longer than it.
  explicit MuseumDesk(const ModuleContext& context);

  [[nodiscard]] std::shared_ptr<const telepresence::MuseumOffice> office() const { return office_; }
  /// While the museum is set up nothing drives by itself: there it is enough that nobody holds the knob.
  void see(const telepresence::documents::OperationMessage& operation) {
    is_stopped_ = operation.is_stopped || (nothing_drives_ && !operation.is_pressed);
  }

 private:
  void look();

  transport::Bus& bus_;
  transport::Publisher<docent_msgs::MuseumMoved> moved_;
  const bool nothing_drives_;
  std::atomic<bool> is_stopped_ = false;
  struct Move {
    bool into_trial;
    Time when;
  };
  std::optional<Move> move_;
  std::shared_ptr<const telepresence::MuseumOffice> office_;
};

}  // namespace docent::modules
