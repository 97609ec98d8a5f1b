#include "docent/modules/web/operators/museum_desk.h"

#include <utility>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/web/operators/recording_list.h"
#include "docent/museum/editing/museum_setup.h"

namespace docent::modules {
namespace {

// Whoever asked for it hears that it is done before this module, too, begins anew.
constexpr Duration kAnswerGoesOut = std::chrono::milliseconds{300};
constexpr Duration kLookPeriod = std::chrono::milliseconds{100};

bool is_being_set_up(const ModuleContext& context) {
  if (!context.is_setup) return false;
  const auto progress = museum::MuseumSetup::read(context.museum.folder);
  return progress && museum::work_of(progress->step) != museum::SetupWork::guide;
}

}  // namespace

MuseumDesk::MuseumDesk(const ModuleContext& context)
    : bus_{context.bus}, moved_{bus_.publisher(topics::kMuseumMoved)}, nothing_drives_{is_being_set_up(context)} {
  const auto stage = nothing_drives_ ? museum::Stage::being_set_up : museum::Stage::complete;
  telepresence::MuseumOffice office{
      {context.museum.folder, museum::trial_folder(context.state), context.checked_robot, stage},
      [this] { return is_stopped_.load(); },
      [this](bool into_trial) {
        bus_.post([this, into_trial] { move_ = Move{into_trial, bus_.now() + kAnswerGoesOut}; });
      },
      recordings_of};
  office_ = std::make_shared<const telepresence::MuseumOffice>(std::move(office));
  bus_.every(kLookPeriod, [this] { look(); });
}

void MuseumDesk::look() {
  if (!move_ || bus_.now() < move_->when) return;
  moved_.publish({{to_message(bus_.now()), ""}, move_->into_trial});
  move_.reset();
}

}  // namespace docent::modules
