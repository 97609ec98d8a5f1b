#include "docent/simulator/body/contact_log.h"

#include <algorithm>
#include <cmath>

#include "docent/messages/conversions.h"

namespace docent::simulator {
namespace {

using PersonSample = ContactLog::PersonSample;

constexpr double kReaction = 0.3;     // [s]
constexpr double kForgotten = 0.5;    // [s] outside, then a new approach begins
constexpr double kSameContact = 1.0;  // [s] apart, then a new contact begins
constexpr double kMargin = 0.03;      // [m] to the sides of the robot's way

}  // namespace

bool is_inside_stopping_distance(const PersonSample& person, const Body& body) {
  constexpr double kStep = 0.02;  // [m]
  const double sign = body.linear() < 0.0 ? -1.0 : 1.0;
  const double speed = std::max(std::abs(body.linear()), 1e-3);
  const double reach = body.params().radius + person.radius + kMargin;
  const double stop = body.stopping_distance(kReaction);
  if (norm(person.offset) > reach + stop + kStep) return false;
  const Angle turned = Angle::radians(kStep * body.angular() / speed);
  Point2 at{};
  Angle heading = body.pose().theta;
  for (double way = 0.0; way <= stop; way += kStep) {
    const Point2 ahead = sign * unit(heading);
    if (dot(person.offset - at, ahead) > 0.0 && distance(person.offset, at) < reach) return true;
    at = at + kStep * ahead;
    heading = heading + turned;
  }
  return false;
}

void ContactLog::watch(Time now, const Body& body, const std::vector<PersonSample>& people) {
  for (const PersonSample& person : people) {
    const auto known = approaches_.find(person.id);
    const bool is_new = known == approaches_.end();
    if (std::abs(body.linear()) < 0.02 && is_new) continue;
    // A person who was seen inside stays watched while they are there, also when the braking shortens that distance.
    const bool inside = is_inside_stopping_distance(person, body);
    if (is_new) {
      if (inside && person.in_sight) approaches_[person.id] = {now, now, body.is_braking_fully()};
      continue;
    }
    if (inside) known->second.last = now;
  }
  for (auto entry = approaches_.begin(); entry != approaches_.end();) {
    Approach& approach = entry->second;
    if (body.is_braking_fully() && now <= approach.first + seconds(kReaction)) approach.has_braked = true;
    // A robot that stands has ended the matter: the next start is a new approach.
    const bool is_over = now - approach.last > seconds(kForgotten) && pending_.empty();
    entry = is_over ? approaches_.erase(entry) : std::next(entry);
  }
}

void ContactLog::touch(Time now, const Body& body, const Touching& touching) {
  ++touches_;
  const auto [place, is_new] = open_.try_emplace(touching.kind + "/" + touching.what);
  place->second.last = now;
  if (!is_new) return;
  Pending pending;
  docent_msgs::TrueContact& contact = pending.contact;
  contact.header = {to_message(now), "world"};
  contact.kind = touching.kind;
  contact.what = touching.what;
  contact.x = touching.point.x;
  contact.y = touching.point.y;
  contact.robot_speed = body.linear() * dot(unit(body.pose().theta), touching.towards);
  contact.other_speed = touching.other_speed;
  contact.wheel_speed = body.linear();
  pending.person = touching.person;
  pending.was_braking = body.is_braking_fully();
  pending.due = now;
  if (touching.person) {
    const auto approach = approaches_.find(*touching.person);
    // A person never seen inside the stopping distance before the touch is first seen there now.
    if (approach == approaches_.end()) approaches_[*touching.person] = {now, now, body.is_braking_fully()};
    pending.due = std::max(now, approaches_[*touching.person].first + seconds(kReaction));
  }
  pending_.push_back(std::move(pending));
}

std::vector<docent_msgs::TrueContact> ContactLog::finish_step(Time now, double dt, const Body& body) {
  const bool wheels_turn = std::abs(body.linear()) > 0.01 || std::abs(body.angular()) > 0.02;
  if (touches_ > 0 && wheels_turn) wheels_turning_ += dt;
  touches_ = 0;
  std::erase_if(open_, [&](const auto& entry) { return now - entry.second.last > seconds(kSameContact); });

  std::vector<docent_msgs::TrueContact> ripe;
  for (Pending& pending : pending_) {
    if (now < pending.due) continue;
    if (pending.person) {
      const auto approach = approaches_.find(*pending.person);
      const bool had_begun = approach != approaches_.end() && approach->second.has_braked;
      const Time touched = from_message(pending.contact.header.stamp);
      const bool deadline_was_open = pending.due > touched;
      pending.contact.braked_in_time = had_begun && (pending.was_braking || deadline_was_open);
    }
    ripe.push_back(pending.contact);
  }
  std::erase_if(pending_, [&](const Pending& pending) { return now >= pending.due; });
  return ripe;
}

void ContactLog::forget() {
  open_.clear();
  approaches_.clear();
}

}  // namespace docent::simulator
