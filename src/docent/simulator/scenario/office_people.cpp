#include "docent/simulator/scenario/office_people.h"

#include <utility>

namespace docent::simulator {

void OfficePeople::play(const OfficeEvent& event) {
  if (event.kind == OfficeEvent::Kind::helper) {
    helps_after_ = event.after;
    return;
  }
  orders_.push_back({"office-" + std::to_string(++ordered_), to_text(event.kind), event.room, "staff"});
}

void OfficePeople::see(const docent_msgs::OfficeState& state, Time now) {
  const bool waits = state.phase == "asking" || state.phase == "handing_over" || state.phase == "emptying";
  const bool is_new = state.phase != state_.phase || state.order != state_.order;
  state_ = state;
  if (!waits) asked_.reset();
  if (waits && is_new) asked_ = now;
}

OfficePeople::Output OfficePeople::step(Time now) {
  constexpr int kGreen = 3;
  Output output{std::exchange(orders_, {}), {}, {}};
  if (!helps_after_ || !asked_ || now - *asked_ < seconds(*helps_after_)) return output;
  asked_.reset();
  output.presses.push_back({{}, kGreen});
  if (state_.points) output.takes = Point2{state_.x, state_.y};
  return output;
}

}  // namespace docent::simulator
