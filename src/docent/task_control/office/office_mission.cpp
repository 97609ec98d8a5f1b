#include "docent/task_control/office/office_mission.h"

#include <algorithm>
#include <cstdio>

namespace docent::task_control {
namespace {

constexpr double kSamePlace = 0.25;  // [m]: a thing there was dealt with already

std::string target_at(const Pose2& pose) {
  char text[80];
  std::snprintf(text, sizeof text, "%.2f,%.2f,%.3f", pose.x, pose.y, pose.theta.radians());
  return text;
}

}  // namespace

Result<void> OfficeParams::validate() const {
  if (bin_holds < 1) return fail("office.bin_holds must be >= 1");
  if (!(hand_over_s > 0.0 && ask_s > 0.0 && empty_s > 0.0 && gone_s > 0.0))
    return fail("office.hand_over_s, ask_s, empty_s and gone_s must be > 0");
  if (!(check_s >= 0.0 && settle_s >= 0.0)) return fail("office.check_s and settle_s must be >= 0");
  if (!(before_thing > 0.0)) return fail("office.before_thing must be > 0");
  if (auto valid = view.validate(); !valid) return fail("office." + valid.error().message);
  return {};
}

void OfficeMission::enter(OfficePhase phase, Time now) {
  status_.phase = phase;
  status_.points.reset();
  since_ = now;
  stands_since_.reset();
}

void OfficeMission::end(OfficePhase phase, std::string reason, Time now) {
  if (is_wishing_) actions_.withdraws = true;
  is_wishing_ = false;
  status_.reason = std::move(reason);
  thing_.reset();
  enter(phase, now);
}

void OfficeMission::wish(const Wish& wish) {
  if (is_wishing_) actions_.withdraws = true;
  actions_.wish = wish;
  is_wishing_ = true;
}

void OfficeMission::drive_to(const Pose2& pose) {
  goal_ = pose;
  wish({RequestKind::point, target_at(pose)});
}

void OfficeMission::order(const OfficeOrder& order, Time now) {
  if (order.kind == OfficeOrderKind::confirm) return confirm(now);
  if (order.kind == OfficeOrderKind::stop) {
    if (status_.phase != OfficePhase::idle) end(OfficePhase::idle, "", now);
    return;
  }
  if (order.id == status_.order.id) return;
  if (is_wishing_) actions_.withdraws = true;
  is_wishing_ = false;
  const std::uint32_t in_bin = status_.in_bin;  // what lies in it, lies in it
  status_ = {};
  status_.order = order;
  status_.in_bin = in_bin;
  thing_.reset();
  plan_.reset();
  goal_.reset();
  handled_.clear();
  counted_.clear();
  if (order.kind == OfficeOrderKind::deliver) {
    enter(OfficePhase::driving, now);
    return wish({RequestKind::room, order.room});
  }
  enter(OfficePhase::looking, now);
}

void OfficeMission::confirm(Time now) {
  switch (status_.phase) {
    case OfficePhase::handing_over:
      actions_.lines.emplace_back(OfficeLine::thanks, "");
      return end(OfficePhase::done, "", now);
    case OfficePhase::asking:
      return put_away(true, now);
    case OfficePhase::emptying:
      status_.in_bin = 0;
      actions_.lines.emplace_back(OfficeLine::thanks, "");
      return enter(OfficePhase::looking, now);
    default:
      return;
  }
}

void OfficeMission::wish_over(bool is_fulfilled, const std::string& reason, Time now) {
  if (!is_wishing_) return;
  is_wishing_ = false;
  switch (status_.phase) {
    case OfficePhase::driving:
      if (!is_fulfilled) {
        actions_.lines.emplace_back(OfficeLine::cannot_get_there, status_.order.room);
        return end(OfficePhase::failed, reason, now);
      }
      actions_.lines.emplace_back(OfficeLine::delivery, status_.order.room);
      return enter(OfficePhase::handing_over, now);
    case OfficePhase::looking:
      if (!is_fulfilled && plan_ && goal_) plan_->give_up(goal_->position());
      stands_since_ = now;
      return;
    case OfficePhase::approaching:
      if (is_fulfilled) {
        thing_seen_ = now;
        return enter(OfficePhase::checking, now);
      }
      if (plan_ && goal_) plan_->give_up(goal_->position());
      return put_away(false, now);
    case OfficePhase::to_bin:
      if (!is_fulfilled) return end(OfficePhase::failed, "no way to where the bin is emptied: " + reason, now);
      actions_.lines.emplace_back(OfficeLine::please_empty, "");
      return enter(OfficePhase::emptying, now);
    default:
      return;
  }
}

bool OfficeMission::is_litter(const KnownThing& thing) const {
  return std::find(params_.objects.begin(), params_.objects.end(), thing.object) != params_.objects.end();
}

bool OfficeMission::is_handled(const KnownThing& thing) const {
  return std::any_of(handled_.begin(), handled_.end(),
                     [&](Point2 place) { return distance(place, thing.in_map) < kSamePlace; });
}

const KnownThing* OfficeMission::wanted_thing() const {
  const KnownThing* best = nullptr;
  for (const KnownThing& thing : things_) {
    if (!is_litter(thing) || is_handled(thing)) continue;
    if (best == nullptr || distance(thing.in_map, pose_->position()) < distance(best->in_map, pose_->position()))
      best = &thing;
  }
  return best;
}

void OfficeMission::stand(const Pose2& map_from_base, bool looks, Time now) {
  pose_ = map_from_base;
  if (status_.order.kind != OfficeOrderKind::tidy || status_.order.id.empty()) return;
  if (status_.phase == OfficePhase::looking && !plan_) {
    plan_ = make_plan_(status_.order.room, map_from_base.position());
    if (!plan_) return end(OfficePhase::failed, "there is no room " + status_.order.room, now);
    stands_since_ = now;
  }
  if (looks && plan_) plan_->see(map_from_base);
}

void OfficeMission::look_on(Time now) {
  if (status_.in_bin >= static_cast<std::uint32_t>(params_.bin_holds)) return go_to_bin(now);
  if (const KnownThing* thing = wanted_thing()) {
    thing_ = *thing;
    if (const auto pose = plan_->stand_before(thing->in_map, params_.before_thing, *pose_)) {
      enter(OfficePhase::approaching, now);
      return drive_to(*pose);
    }
    return put_away(false, now);  // it lies where the robot cannot stand before it
  }
  if (const auto pose = plan_->next(*pose_)) {
    stands_since_.reset();
    return drive_to(*pose);
  }
  if (status_.in_bin > 0) return go_to_bin(now);
  actions_.lines.emplace_back(OfficeLine::all_tidy, "");
  end(OfficePhase::done, "", now);
}

void OfficeMission::go_to_bin(Time now) {
  enter(OfficePhase::to_bin, now);
  if (params_.bin_room.empty()) return drive_to(home_);
  wish({RequestKind::room, params_.bin_room});
}

void OfficeMission::put_away(bool is_picked_up, Time now) {
  if (thing_) {
    handled_.push_back(thing_->in_map);
    if (counted_.insert(thing_->id).second) ++status_.found;
    ++(is_picked_up ? status_.picked_up : status_.left);
  }
  if (is_picked_up) {
    ++status_.in_bin;
    actions_.lines.emplace_back(OfficeLine::thanks, "");
  }
  thing_.reset();
  enter(OfficePhase::looking, now);
  stands_since_ = now;
}

void OfficeMission::tick(Time now) {
  if (!pose_) return;
  const auto same = [&](const KnownThing& thing) {
    return thing_ && distance(thing.in_map, thing_->in_map) < kSamePlace;
  };
  switch (status_.phase) {
    case OfficePhase::handing_over:
      if (waited(params_.hand_over_s, now)) end(OfficePhase::done, "nobody confirmed it", now);
      return;
    case OfficePhase::looking:
      if (!plan_) return;
      if (!is_wishing_ && !stands_since_) stands_since_ = now;
      if (!is_wishing_ && now - *stands_since_ >= seconds(params_.settle_s)) look_on(now);
      return;
    case OfficePhase::checking: {
      const auto seen = std::find_if(things_.begin(), things_.end(), same);
      if (!waited(params_.check_s, now)) return;
      if (seen == things_.end() || !is_litter(*seen)) {
        handled_.push_back(thing_->in_map);  // from near it is something else
        thing_.reset();
        enter(OfficePhase::looking, now);
        return;
      }
      thing_ = *seen;
      if (counted_.insert(seen->id).second) ++status_.found;
      enter(OfficePhase::asking, now);
      status_.points = seen->in_map;
      thing_seen_ = now;
      actions_.lines.emplace_back(OfficeLine::please_put_in, seen->object);
      return;
    }
    case OfficePhase::asking:
      if (std::any_of(things_.begin(), things_.end(), same)) thing_seen_ = now;
      if (now - thing_seen_ >= seconds(params_.gone_s)) return put_away(true, now);
      if (waited(params_.ask_s, now)) put_away(false, now);
      return;
    case OfficePhase::emptying:
      if (!waited(params_.empty_s, now)) return;
      actions_.lines.emplace_back(OfficeLine::bin_stays_full, "");
      return end(OfficePhase::failed, "nobody emptied the bin", now);
    default:
      return;
  }
}

}  // namespace docent::task_control
