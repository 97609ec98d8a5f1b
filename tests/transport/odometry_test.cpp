// A hundred hours of odometry over the wires of the simulator: no reading is a jump that was none, every real one is
// one. Both as it comes, and by the clock of whoever hears it, as the robot's modules take it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <queue>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/collision_avoidance/clocks/driver_stamps.h"
#include "docent/collision_avoidance/clocks/local_time.h"
#include "docent/collision_avoidance/watches/message_rhythm.h"
#include "docent/motion_models/unbroken_odometry.h"
#include "docent/simulator/transport/wire.h"

namespace docent::transport_test {
namespace {

using simulator::Wire;
using simulator::WireParams;

/// A base on tour: it drives, turns on the spot and stands, as its wheels can.
class Base {
 public:
  explicit Base(const Rng& rng) : rng_{rng} {}
  void step(double dt) {
    rest_ -= dt;
    if (rest_ < 0.0) {
      rest_ = rng_.uniform(0.5, 8.0);
      const double what = rng_.uniform();
      linear_wanted_ = what < 0.6 ? rng_.uniform(-0.2, 0.8) : 0.0;
      angular_wanted_ = what < 0.8 ? rng_.uniform(-1.2, 1.2) : 0.0;
    }
    linear_ += std::clamp(linear_wanted_ - linear_, -2.0 * dt, 2.0 * dt);
    angular_ += std::clamp(angular_wanted_ - angular_, -3.0 * dt, 3.0 * dt);
    pose_ = pose_ * Pose2{linear_ * dt, 0.0, Angle::radians(angular_ * dt)};
  }
  /// Nobody hears it: its brakes are on.
  void stand() { linear_ = angular_ = linear_wanted_ = angular_wanted_ = 0.0; }
  [[nodiscard]] bool stands() const { return linear_ == 0.0 && angular_ == 0.0; }
  [[nodiscard]] const Pose2& pose() const { return pose_; }

 private:
  Rng rng_;
  double rest_ = 0.0;
  double linear_ = 0.0, angular_ = 0.0, linear_wanted_ = 0.0, angular_wanted_ = 0.0;
  Pose2 pose_{4.0, 7.0, {}};
};

struct Message {
  Time comes, stamp, sent;
  Pose2 raw, truth;
  bool stands = false;
  bool operator>(const Message& other) const { return comes > other.comes; }
};

struct Day {
  std::string name;
  WireParams wire;
  bool only_in_local_time = false;  ///< its stamps say nothing to who does not know when it hears them
};

/// What became of it.
struct Seen {
  double hours = 0.0;
  double readings = 0.0;
  int false_jumps = 0;
  int made = 0;               ///< real ones
  int found = 0;              ///< of these, within three readings
  double worst_step = 0.0;    ///< [m] by which one step of the unbroken odometry is off
  double seem_missing = 0.0;  ///< readings at which messages seemed to be missing
};

/// Hears one base's odometry.
class Listener {
 public:
  Listener(const motion_models::UnbrokenOdometryParams& params, bool in_local_time)
      : odometry_{params}, in_local_time_{in_local_time} {}

  void hear(const Message& message) {
    const Time mended = stamps_.mend(message.comes, message.stamp, message.raw, message.stands);
    const Time stamp = in_local_time_ ? local_.receive("odometry", message.comes, mended) : message.stamp;
    const auto reading = odometry_.add(stamp, message.raw);
    rhythm_.receive(in_local_time_ ? mended : message.stamp);
    ++seen.readings;
    seen.seem_missing += rhythm_.misses_many() ? 1.0 : 0.0;
    if (reading.is_late) return;
    if (awaited_ > 0) {
      // What was sent before the jump may still be on its way.
      if (message.sent >= made_) --awaited_;
      if (reading.jumped) ++seen.found, awaited_ = 0;
    } else if (reading.jumped) {
      ++seen.false_jumps;
    }
    if (last_) {
      const Pose2 step = inverse(last_->odom_from_base) * reading.odom_from_base;
      const Pose2 true_step = inverse(last_truth_) * message.truth;
      seen.worst_step = std::max(seen.worst_step, distance(step.position(), true_step.position()));
    }
    last_ = reading;
    last_truth_ = message.truth;
  }
  void expect_jump(Time made) {
    made_ = made;
    awaited_ = 3;
    ++seen.made;
  }
  Seen seen;

 private:
  motion_models::UnbrokenOdometry odometry_;
  collision_avoidance::LocalTime local_;
  collision_avoidance::OdometryStamps stamps_;
  collision_avoidance::MessageRhythm rhythm_;
  bool in_local_time_;
  Time made_{};
  int awaited_ = 0;  ///< readings in which a jump is to be found
  std::optional<motion_models::UnbrokenOdometry::Reading> last_;
  Pose2 last_truth_;
};

struct Exposure {
  double rate = 20.0;  ///< [1/s]
  double hours = 1.0;
  double jump_every = 0.0;  ///< [s]; 0: never
  bool restarts = false;    ///< a jump is a driver that is silent for 0.3 to 8 s and begins anew near zero
};

Seen live(const WireParams& wire_params, const Exposure& exposure, Listener listener, std::uint64_t seed) {
  const Rng rng{seed};
  Base base{rng.stream("base")};
  Rng jumps = rng.stream("jumps");
  const Time begins = time_from_seconds(1000.0);
  Wire wire{wire_params, rng.stream("wire"), begins};
  std::priority_queue<Message, std::vector<Message>, std::greater<>> on_the_way;
  listener.seen.hours = exposure.hours;
  Pose2 raw_from_true;
  double silent_until = 0.0;
  double next_jump = exposure.jump_every > 0.0 ? exposure.jump_every : 1e18;
  const auto count = static_cast<long>(3600.0 * exposure.hours * exposure.rate);
  for (long i = 0; i < count; ++i) {
    const double now = static_cast<double>(i) / exposure.rate;
    const Time sent = begins + seconds(now);
    base.step(1.0 / exposure.rate);
    for (; !on_the_way.empty() && on_the_way.top().comes <= sent; on_the_way.pop()) listener.hear(on_the_way.top());
    if (now >= next_jump) {
      next_jump += exposure.jump_every * jumps.uniform(0.5, 1.5);
      if (exposure.restarts && norm((raw_from_true * base.pose()).position()) > 2.0) {
        silent_until = now + jumps.uniform(0.3, 8.0);
        base.stand();
        const double off = jumps.chance(0.5) ? 0.0 : 0.01;  // what its first message tells of already
        raw_from_true = Pose2{off, 0.0, Angle::radians(off)} * inverse(base.pose());
        listener.expect_jump(sent);
      }
      if (exposure.restarts) continue;
      const Point2 to = jumps.uniform(1.5, 9.0) * unit(Angle::radians(jumps.uniform(-3.1, 3.1)));
      const Pose2 by{to.x, to.y, Angle::radians(jumps.uniform(-3.1, 3.1))};
      raw_from_true = raw_from_true * base.pose() * by * inverse(base.pose());
      listener.expect_jump(sent);
    }
    if (now < silent_until) {
      base.stand();
      continue;
    }
    const Pose2 raw = raw_from_true * base.pose();
    for (const Wire::Delivery& delivery : wire.carry(sent, !base.stands()))
      on_the_way.push({sent + delivery.after, delivery.stamp, sent, raw, base.pose(), base.stands()});
  }
  return listener.seen;
}

std::vector<Day> days() {
  const WireParams all{.jitter = 0.05,
                       .hiccups = 6.0,
                       .hold = 0.1,
                       .reorder = 0.02,
                       .twice = 0.02,
                       .drop = 0.1,
                       .clock = 0.03,
                       .drift = 5e-5,
                       .set_back = 0.1,
                       .every = 300.0};
  WireParams worse = all;
  worse.hold = 0.3;
  worse.set_back = 0.9;
  WireParams received = all;
  received.stamps = "receipt";
  received.reorder = 0.0;
  WireParams repeats = all;
  repeats.stamps = "moving";
  return {{"as it is", {}},
          {"jitter", {.jitter = 0.05}},
          {"jitter, on receipt", {.jitter = 0.05, .stamps = "receipt"}},
          {"hiccups", {.hiccups = 20.0, .hold = 0.12}},
          {"hiccups, on receipt", {.hiccups = 20.0, .hold = 0.12, .stamps = "receipt"}},
          {"long hiccups, on receipt", {.hiccups = 6.0, .hold = 0.4, .stamps = "receipt"}},
          {"drops", {.drop = 0.1}},
          {"a third lost", {.drop = 0.33}},
          {"reordered, doubled", {.reorder = 0.05, .twice = 0.05}},
          {"reordered, on receipt", {.stamps = "receipt", .reorder = 0.05, .twice = 0.05}},
          {"drift", {.clock = -0.03, .drift = -2e-4}},
          {"set back by 0.2 s", {.set_back = 0.2, .every = 20.0}},
          {"set back by 5 s", {.set_back = 5.0, .every = 20.0}},
          {"set forward", {.set_back = -0.4, .every = 20.0}},
          {"bursts of a network, on receipt", {.hiccups = 120.0, .hold = 0.2, .stamps = "receipt"}},
          {"late by 300 ms, on receipt", {.delay = 0.3, .stamps = "receipt"}},
          {"from the future", {.clock = 40.0}},
          {"without stamps", {.jitter = 0.02, .stamps = "zero"}, true},
          {"repeats itself where it stands", {.stamps = "moving"}, true},
          {"repeats itself, and all", repeats, true},
          {"all", all},
          {"all, on receipt", received},
          {"all, and worse", worse}};
}

TEST(Transport, NoReadingInAHundredHoursIsAJumpThatWasNone) {
  double hours = 0.0;
  for (const Day& day : days()) {
    for (const bool in_local_time : {false, true}) {
      for (const Exposure& exposure :
           {Exposure{20.0, 1.6}, Exposure{10.0, 0.4}, Exposure{50.0, 0.3}, Exposure{200.0, 0.1}, Exposure{8.0, 0.4}}) {
        if (day.only_in_local_time && !in_local_time) continue;
        SCOPED_TRACE(day.name + (in_local_time ? ", in local time, " : ", ") + std::to_string(exposure.rate) + " Hz");
        const Seen seen = live(day.wire, exposure, Listener{{}, in_local_time}, 11);
        EXPECT_EQ(seen.false_jumps, 0);
        EXPECT_LT(seen.worst_step, 1e-6);
        EXPECT_GT(seen.readings, 0.5 * 3600.0 * exposure.hours * exposure.rate);
        hours += exposure.hours;
      }
    }
  }
  EXPECT_GT(hours, 100.0);
}

TEST(Transport, EveryRealJumpIsOne) {
  int made = 0;
  for (const Day& day : days()) {
    // Whoever stamps what was overtaken on receipt says that the base jumped back.
    if (day.wire.reorder > 0.0 && day.wire.stamps == "receipt") continue;
    for (const bool in_local_time : {false, true}) {
      if (day.only_in_local_time && !in_local_time) continue;
      SCOPED_TRACE(day.name + (in_local_time ? ", in local time" : ""));
      const Seen seen = live(day.wire, {20.0, 1.0, 20.0}, Listener{{}, in_local_time}, 12);
      EXPECT_EQ(seen.false_jumps, 0);
      EXPECT_EQ(seen.found, seen.made);
      EXPECT_LT(seen.worst_step, 0.35) << "what it drove meanwhile is all that it may not know";
      made += seen.made;
    }
  }
  EXPECT_GT(made, 1000);
}

TEST(Transport, EveryDriverThatBeginsAnewIsAJump) {
  int made = 0;
  for (const Day& day : days()) {
    if (day.wire.reorder > 0.0 && day.wire.stamps == "receipt") continue;
    if (day.only_in_local_time) continue;
    SCOPED_TRACE(day.name);
    const Seen seen = live(day.wire, {20.0, 0.5, 20.0, true}, Listener{{}, true}, 15);
    EXPECT_EQ(seen.false_jumps, 0);
    EXPECT_EQ(seen.found, seen.made);
    made += seen.made;
  }
  EXPECT_GT(made, 300);
}

TEST(Transport, WhoAllowsNothingForStampsFindsJumpsThatAreNone) {
  const motion_models::UnbrokenOdometryParams strict{
      .margin = 0.5, .linear_noise = 0.01, .angular_noise = 0.01, .jitter = 0.0, .most_held = 0.0};
  EXPECT_GT(live({.jitter = 0.05, .drop = 0.1}, {20.0, 1.0}, Listener{strict, false}, 13).false_jumps, 100);
}

TEST(Transport, AnOrdinaryNetworkLosesNothing) {
  for (const Day& day : days()) {
    if (day.name == "set back by 5 s" || day.name == "all, and worse") continue;
    SCOPED_TRACE(day.name);
    const Seen seen = live(day.wire, {50.0, 1.0}, Listener{{}, day.only_in_local_time}, 14);
    const double share = seen.seem_missing / seen.readings;
    if (day.wire.drop > 0.2) {
      EXPECT_GT(share, 0.0);
    } else {
      // Of a driver that tells of standing by repeating itself no more is known than when its messages came.
      EXPECT_LE(share, day.only_in_local_time ? 0.01 : 0.0);
    }
  }
}

}  // namespace
}  // namespace docent::transport_test
