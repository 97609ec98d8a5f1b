#include "docent/modules/web/operators/robot_desk.h"

#include <cstdio>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/shared/battery.h"

namespace docent::modules {
namespace {

std::string target_of(const telepresence::documents::RobotGoal& goal) {
  char text[80];
  std::snprintf(text, sizeof text, "%.2f,%.2f,%.3f", goal.x, goal.y, goal.heading);
  return text;
}

docent_msgs::Request request_of(std::string id, RequestKind kind, std::string target) {
  docent_msgs::Request request;
  request.id = std::move(id);
  request.source = to_text(RequestSource::staff);
  request.kind = to_text(kind);
  request.target = std::move(target);
  return request;
}

}  // namespace

RobotDesk::RobotDesk(transport::Bus& bus)
    : bus_{bus}, requests_{bus.publisher(topics::kRequest)}, orders_{bus.publisher(topics::kOfficeOrder)} {
  telepresence::RobotOffice office;
  office.state = [this] {
    const std::scoped_lock lock{mutex_};
    return state_;
  };
  office.drive = [this](const telepresence::documents::RobotGoal& goal) {
    bus_.post([this, goal] { tell(request_of(goal.id, RequestKind::point, target_of(goal))); });
  };
  office.cancel = [this](const std::string& goal) {
    bus_.post([this, goal] { tell(request_of(telepresence::withdrawal_id(goal), RequestKind::cancel, goal)); });
  };
  office.order = [this](const telepresence::documents::OfficeWish& wish) {
    bus_.post([this, wish] { orders_.publish({wish.id, wish.kind, wish.room, to_text(RequestSource::staff)}); });
  };
  office.report = [this] {
    const std::scoped_lock lock{mutex_};
    return report_;
  };
  office_ = std::make_shared<const telepresence::RobotOffice>(std::move(office));
  subscribe();
}

void RobotDesk::tell(docent_msgs::Request request) {
  request.stamp = to_message(bus_.now());
  requests_.publish(std::move(request));
}

void RobotDesk::subscribe() {
  bus_.subscribe<docent_msgs::RequestBoard>(topics::kRequestBoard, [this](const auto& board) { take(board); });
  bus_.subscribe<docent_msgs::MissionState>(topics::kMissionState, [this](const auto& mission) {
    const std::scoped_lock lock{mutex_};
    state_.phase = mission.phase;
  });
  bus_.subscribe<docent_msgs::OfficeState>(topics::kOfficeState, [this](const auto& state) {
    const std::scoped_lock lock{mutex_};
    report_ = {state.order,
               state.kind,
               state.phase,
               state.room,
               state.reason,
               static_cast<int>(state.found),
               static_cast<int>(state.picked_up),
               static_cast<int>(state.left),
               static_cast<int>(state.in_bin)};
  });
  bus_.subscribe<docent_msgs::GoalState>(topics::kGoalState, [this](const auto& goal) {
    const std::scoped_lock lock{mutex_};
    state_.remaining_m = goal.id.empty() ? 0.0 : goal.remaining_m;
  });
  bus_.subscribe<sensor_msgs::BatteryState>(topics::kBattery, [this](const auto& battery) {
    if (says_nothing(battery)) return;
    const std::scoped_lock lock{mutex_};
    state_.battery = static_cast<double>(battery.percentage);
    state_.is_charging = is_charging(battery).value_or(false);
  });
}

void RobotDesk::take(const docent_msgs::RequestBoard& board) {
  std::vector<telepresence::documents::RobotGoalState> goals;
  for (const docent_msgs::RequestState& entry : board.requests) {
    const auto state = parse<RequestStatus>(entry.state);
    const bool is_goal =
        entry.request.kind == to_text(RequestKind::point) && entry.request.source == to_text(RequestSource::staff);
    if (is_goal && state) goals.push_back({entry.request.id, *state, entry.reason});
  }
  const std::scoped_lock lock{mutex_};
  state_.goals = std::move(goals);
}

void RobotDesk::see(const std::optional<Pose2>& map_from_base) {
  const std::scoped_lock lock{mutex_};
  state_.t = to_seconds(bus_.now());
  state_.pose.reset();
  if (map_from_base) state_.pose = {map_from_base->x, map_from_base->y, map_from_base->theta.radians()};
}

void RobotDesk::see(const telepresence::documents::OperationMessage& operation) {
  const std::scoped_lock lock{mutex_};
  state_.is_stopped = operation.is_stopped;
}

}  // namespace docent::modules
