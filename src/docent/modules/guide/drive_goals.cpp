#include "docent/modules/guide/drive_goals.h"

#include <utility>

#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {

using task_control::ByTag;

TagDock::TagDock(transport::Bus& bus) : bus_{bus}, orders_{bus.publisher(topics::kDockOrder)} {
  bus_.subscribe<docent_msgs::GoalState>(topics::kDockState, [this](const auto& state) {
    heard_ = state;
    heard_at_ = bus_.now();
  });
}

void TagDock::tick(task_control::Executive& executive) {
  const bool is_silent = heard_at_ == Time{} || bus_.now() - heard_at_ > kSilent;
  std::optional<GoalStatus> state;
  if (!is_silent) state = parse<GoalStatus>(heard_.state);
  const bool is_of_order = !ordered_.empty() && heard_.id == ordered_;
  ByTag by_tag = ByTag::none;
  if (is_of_order && state)
    by_tag = state == GoalStatus::arrived       ? ByTag::arrived
             : state == GoalStatus::unreachable ? ByTag::failed
                                                : ByTag::drives;
  else if (state && state != GoalStatus::unreachable)
    by_tag = ByTag::ready;
  executive.tag_report(by_tag);
  const auto order = executive.tag_order();
  const std::string id = order ? order->id : "";
  if (id == ordered_) return;
  ordered_ = id;
  docent_msgs::DriveGoal goal;
  goal.id = id;
  if (order) {
    goal.x = order->map_from_base.x;
    goal.y = order->map_from_base.y;
    goal.theta = order->map_from_base.theta.radians();
  }
  orders_.publish(std::move(goal));
}

DriveGoals::DriveGoals(transport::Bus& bus, bool docks_by_action)
    : bus_{bus}, tag_{bus}, goal_{bus.publisher(topics::kDriveGoal)} {
  if (docks_by_action) dock_.emplace(bus);
  was_held_ = is_held();
}

void DriveGoals::order(const task_control::DriveOrder& order) {
  ordered_ = {};
  ordered_.id = order.id;
  ordered_.x = order.map_from_base.x;
  ordered_.y = order.map_from_base.y;
  ordered_.theta = order.map_from_base.theta.radians();
  ordered_.relocalize = order.relocalize;
  ordered_.position_tolerance = order.position_tolerance;
  ordered_.heading_tolerance = order.heading_tolerance;
  publish();
}

bool DriveGoals::is_held() const { return dock_ && (!dock_->is_known() || dock_->is_docked() || dock_->is_moving()); }

void DriveGoals::publish() { goal_.publish(is_held() ? docent_msgs::DriveGoal{} : ordered_); }

void DriveGoals::tick(task_control::Executive& executive) {
  tag_.tick(executive);
  if (!dock_) return;
  using task_control::Contact;
  using Wish = DockClient::Wish;
  const bool stays = executive.is_on_way_to_charger() || ordered_.id.empty();
  dock_->want(executive.wants_contact() ? Wish::docked : stays ? Wish::none : Wish::free);
  dock_->tick();
  executive.contact_report(dock_->is_docked() ? Contact::made : dock_->is_moving() ? Contact::coming : Contact::none);
  if (dock_->is_docked() && !dock_->is_moving()) executive.stand_at_charger(bus_.now());
  if (std::exchange(was_held_, is_held()) != is_held()) publish();
}

}  // namespace docent::modules
