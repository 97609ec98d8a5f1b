#include "docent/modules/guide/dock_client.h"

#include <cstring>
#include <utility>

#include "docent/transport/create3_support.h"

namespace docent::modules {
namespace {

const char* action_of(DockClient::Wish wish) { return wish == DockClient::Wish::docked ? "/dock" : "/undock"; }

}  // namespace

DockClient::DockClient(transport::Bus& bus, const DockClientParams& params)
    : bus_{bus}, params_{params}, dock_{bus.publisher(topics::kSendDock)}, undock_{bus.publisher(topics::kSendUndock)} {
  bus_.subscribe<irobot_create_msgs::DockStatus>(topics::kDockStatus, [this](const auto& dock) {
    is_docked_ = dock.is_docked;
    is_known_ = true;
  });
  bus_.subscribe<action_msgs::GoalStatusArray>(topics::kDockGoals,
                                               [this](const auto& goals) { hear(Wish::docked, goals); });
  bus_.subscribe<action_msgs::GoalStatusArray>(topics::kUndockGoals,
                                               [this](const auto& goals) { hear(Wish::free, goals); });
}

bool DockClient::is_fulfilled() const { return wish_ == Wish::none || (wish_ == Wish::docked) == is_docked(); }

void DockClient::want(Wish wish) {
  if (wish == wish_) return;
  wish_ = wish;
  failed_.reset();
  complaint_.clear();
}

DockClient::GoalId DockClient::next_id() {
  // A goal's id must be another one than that of any goal which the base remembers, also of a program before this one.
  GoalId id{};
  const std::int64_t now = bus_.now().nanoseconds;
  std::memcpy(id.data(), &now, sizeof now);
  ++goals_;
  std::memcpy(id.data() + sizeof now, &goals_, sizeof goals_);
  return id;
}

void DockClient::send() {
  const auto& status = wish_ == Wish::docked ? topics::kDockGoals : topics::kUndockGoals;
  if (bus_.other_writers(transport::topic_info(status)) == 0)
    return fail(std::string{"the base offers no action "} + action_of(wish_));
  goal_ = Goal{wish_, next_id(), bus_.now(), false};
  irobot_create_msgs::SendGoal goal;
  goal.goal_id = goal.request_id = goal_->id;
  if (wish_ == Wish::docked)
    dock_.publish({goal});
  else
    undock_.publish({goal});
}

void DockClient::fail(std::string why) {
  complaint_ = std::move(why);
  failed_ = bus_.now();
  goal_.reset();
}

void DockClient::hear(Wish of, const action_msgs::GoalStatusArray& goals) {
  using action_msgs::GoalStatus;
  if (!goal_ || goal_->wish != of) return;
  for (const GoalStatus& goal : goals.status_list) {
    if (goal.goal_info.goal_id.uuid != goal_->id) continue;
    if (goal.status == GoalStatus::kSucceeded) {
      // Whether that is what is wanted, the dock says.
      complaint_.clear();
      failed_ = bus_.now();
      goal_.reset();
    } else if (goal.status == GoalStatus::kAborted || goal.status == GoalStatus::kCanceled) {
      fail(std::string{action_of(of)} + (goal.status == GoalStatus::kAborted ? " failed" : " was cancelled") +
           ", says the base");
    } else {
      goal_->is_accepted = true;
    }
    return;
  }
}

void DockClient::tick() {
  const Time now = bus_.now();
  if (goal_) {
    const Duration lasted = now - goal_->sent;
    if (!goal_->is_accepted && lasted > seconds(params_.accept_s))
      fail(std::string{"the base has not taken the goal "} + action_of(goal_->wish));
    else if (lasted > seconds(params_.action_s))
      fail(std::string{action_of(goal_->wish)} + " has not come to an end");
    return;
  }
  if (!is_known()) {
    complaint_ = "the base says nothing of its dock (dock_status)";
    return;
  }
  if (is_fulfilled()) {
    complaint_.clear();
    return;
  }
  if (!failed_ || now - *failed_ >= seconds(params_.retry_s)) send();
}

}  // namespace docent::modules
