#include "docent/modules/guide/drive_goals.h"

#include <utility>

namespace docent::modules {

DriveGoals::DriveGoals(transport::Bus& bus, bool docks_by_action)
    : bus_{bus}, goal_{bus.publisher(topics::kDriveGoal)} {
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
  publish();
}

bool DriveGoals::is_held() const { return dock_ && (!dock_->is_known() || dock_->is_docked() || dock_->is_moving()); }

void DriveGoals::publish() { goal_.publish(is_held() ? docent_msgs::DriveGoal{} : ordered_); }

void DriveGoals::tick(task_control::Executive& executive) {
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
