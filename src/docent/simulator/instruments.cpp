#include "docent/simulator/instruments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "docent/messages/conversions.h"

namespace docent::simulator {
namespace {

/// Half of the readings are lost; false: the whole message is.
bool halve(sensor_msgs::LaserScan& scan, Rng& rng, bool&) {
  for (float& range : scan.ranges) {
    if (rng.chance(0.5)) range = std::numeric_limits<float>::quiet_NaN();
  }
  return true;
}
bool halve(sensor_msgs::Range& ping, Rng& rng, bool&) {
  if (rng.chance(0.5)) ping.range = std::numeric_limits<float>::quiet_NaN();
  return true;
}
bool halve(docent_msgs::Tactile& tactile, Rng& rng, bool&) {
  constexpr std::uint8_t kNoReading = 255;
  for (std::uint8_t& segment : tactile.segments) {
    if (rng.chance(0.5)) segment = kNoReading;
  }
  return true;
}
bool halve(nav_msgs::Odometry&, Rng&, bool& skips) {
  skips = !skips;
  return !skips;
}

/// What a sensor reads that hears, or sees, something else than the world.
float spoilt(float range, float largest, FaultKind kind, Rng& rng) {
  constexpr float kNear = 0.3F;  // [m]
  if (kind == FaultKind::near) return kNear;
  if (kind == FaultKind::deaf) return largest;
  return rng.chance(0.5)
             ? static_cast<float>(rng.uniform(static_cast<double>(kNear), static_cast<double>(std::max(range, kNear))))
             : range;
}
void spoil(sensor_msgs::LaserScan& scan, FaultKind kind, Rng& rng) {
  for (float& range : scan.ranges) range = spoilt(range, scan.range_max, kind, rng);
}
void spoil(sensor_msgs::Range& ping, FaultKind kind, Rng& rng) {
  ping.range = spoilt(ping.range, ping.max_range, kind, rng);
}
void spoil(nav_msgs::Odometry&, FaultKind, Rng&) {}    // no ranges: the scenario refuses it
void spoil(docent_msgs::Tactile&, FaultKind, Rng&) {}  // likewise

/// Of what lasts so long [s]; 0: to the end.
Time end_of(double duration, Time now) {
  return duration > 0.0 ? now + seconds(duration) : Time{std::numeric_limits<std::int64_t>::max()};
}

Sensor sensor_of(std::string_view scanner) {
  if (scanner == "rear") return Sensor::laser_rear;
  if (scanner == "left") return Sensor::laser_left;
  return scanner == "right" ? Sensor::laser_right : Sensor::laser_front;
}

SonarParams sonars_of(const Hardware& hardware) {
  SonarParams params;
  params.count = hardware.sonars;
  params.ring_radius = hardware.sonar_radius;
  if (params.count % params.together != 0) params.together = 1;
  return params;
}

InfraredParams infrareds_of(const Hardware& hardware) {
  InfraredParams params;
  params.count = hardware.infrareds;
  params.ring_radius = hardware.infrared_radius;
  return params;
}

}  // namespace

Instruments::Instruments(transport::Bus& bus, const World& world, const Hardware& hardware, const Rng& rng)
    : bus_{bus},
      ring_{sonars_of(hardware), rng.stream("sonar")},
      infrared_{infrareds_of(hardware), rng.stream("infrared")},
      fault_rng_{rng.stream("faults")},
      wire_rng_{rng.stream("wires")},
      odometry_rate_{hardware.odometry_rate},
      scale_{hardware.odometry_way, hardware.odometry_turn},
      has_tactile_{hardware.has_tactile},
      pings_{bus.publisher(topics::kSonar)},
      infrared_readings_{bus.publisher(topics::kInfrared)},
      odometry_{bus.publisher(topics::kOdometry)},
      battery_{bus.publisher(topics::kBattery)},
      tactile_{bus.publisher(topics::kTactile)} {
  for (const auto& scanner : hardware.scanners) {
    scanners_.push_back({sensor_of(scanner.name),
                         scanner.frame,
                         scanner.kind,
                         {laser_of(scanner.kind), scanner.base_from_scanner, rng.stream("laser_" + scanner.name)},
                         bus.publisher(topics::scan_topic(scanner.name)),
                         {},
                         {},
                         0,
                         {},
                         scanner.late,
                         plane_at(scanner.height)});
    scanners_.back().laser.see_body(hardware.posts);
    beams_ += scanners_.back().laser.params().beams;
  }
  last_pings_.resize(static_cast<std::size_t>(ring_.params().count));
  last_infrared_.resize(static_cast<std::size_t>(infrared_.params().count));
  change_world(world);
}

std::size_t Instruments::plane_at(double height) {
  const auto known =
      std::find_if(planes_.begin(), planes_.end(), [&](const Plane& plane) { return plane.height == height; });
  if (known != planes_.end()) return static_cast<std::size_t>(known - planes_.begin());
  planes_.push_back({height, nullptr});
  return planes_.size() - 1;
}

void Instruments::change_world(const World& world) {
  for (Plane& plane : planes_) plane.walls = std::make_unique<RayCaster>(surfaces_at(world, plane.height));
  sonar_walls_ = std::make_unique<RayCaster>(sonar_surfaces(world));
  infrared_walls_ = std::make_unique<RayCaster>(surfaces_at(world, kInfraredHeight));
}

void Instruments::set_fault(const SensorFault& fault, Time now) {
  faults_[static_cast<std::size_t>(fault.sensor)] = Fault{fault.kind, end_of(fault.duration, now), fault.delay};
}

void Instruments::set_transport(const Transport& transport, Time now) {
  for (std::size_t sensor = 0; sensor < kSensors; ++sensor) {
    if (transport.sensor && static_cast<std::size_t>(*transport.sensor) != sensor) continue;
    lines_[sensor] =
        Line{Wire{transport.wire, wire_rng_.stream(std::to_string(sensor)), now}, end_of(transport.duration, now)};
  }
}

void Instruments::set_lie(const ScannerLie& lie, Time now) {
  for (Scanner& scanner : scanners_)
    if (scanner.sensor == lie.sensor) scanner.lies.begin(lie, now);
}

const Instruments::Fault* Instruments::fault_of(Sensor sensor, Time now) const {
  const auto& fault = faults_[static_cast<std::size_t>(sensor)];
  return fault && now < fault->until ? &*fault : nullptr;
}

template <class T>
void Instruments::send(Sensor sensor, const transport::Publisher<T>& publisher, T message, Time now, double later) {
  auto& line = lines_[static_cast<std::size_t>(sensor)];
  const bool is_wired = line && now < line->until;
  const bool is_news = sensor != Sensor::odom || is_odometry_news_;
  const auto deliveries = is_wired ? line->wire.carry(now, is_news) : std::vector<Wire::Delivery>{{Duration{}, now}};
  for (const Wire::Delivery& delivery : deliveries) {
    message.header.stamp = to_message(delivery.stamp);
    const Duration after = delivery.after + seconds(later);
    if (after.count() <= 0) {
      publisher.publish(message);
    } else {
      bus_.after(after, [publisher, message] { publisher.publish(message); });
    }
  }
}

template <class T>
void Instruments::emit(Sensor sensor, const transport::Publisher<T>& publisher, T message, std::optional<T>& last,
                       Time now) {
  const Fault* fault = fault_of(sensor, now);
  if (fault == nullptr) {
    last = message;
    send(sensor, publisher, std::move(message), now);
    return;
  }
  switch (fault->kind) {
    case FaultKind::dead:
      return;
    case FaultKind::frozen:
      if (!last) last = message;
      last->header.stamp = message.header.stamp;
      send(sensor, publisher, *last, now);
      return;
    case FaultKind::half:
      if (halve(message, fault_rng_, skips_)) send(sensor, publisher, std::move(message), now);
      return;
    case FaultKind::late:
      send(sensor, publisher, std::move(message), now, fault->delay);
      return;
    case FaultKind::near:
    case FaultKind::deaf:
    case FaultKind::storm:
      spoil(message, fault->kind, fault_rng_);
      send(sensor, publisher, std::move(message), now);
      return;
  }
}

void Instruments::jump(const Pose2& base_from_base, double over) {
  constexpr double kReading = 0.05;  // [s]
  jump_parts_ = std::max(1, static_cast<int>(std::lround(over / kReading)));
  const double share = 1.0 / jump_parts_;
  jump_part_ = {share * base_from_base.x, share * base_from_base.y,
                Angle::radians(share * base_from_base.theta.radians())};
}

void Instruments::publish_odometry(Time now, std::size_t step, const Body& body) {
  if (!is_due(step, odometry_rate_)) return;
  nav_msgs::Odometry message;
  message.header = {to_message(now), "odom"};
  message.child_frame_id = "base_link";
  if (jump_parts_ > 0) {
    --jump_parts_;
    odom_from_body_odom_ = odom_from_body_odom_ * body.odometry() * jump_part_ * inverse(body.odometry());
  }
  const Pose2 odometry = scale_.apply(odom_from_body_odom_ * body.odometry());
  message.pose.pose = to_message(odometry);
  const double dt = to_seconds(now - last_odometry_);
  if (has_odometry_ && dt > 0.0) {
    const Pose2 motion = inverse(last_pose_) * odometry;
    message.twist.twist.linear.x = motion.x / dt;
    message.twist.twist.angular.z = motion.theta.radians() / dt;
  }
  is_odometry_news_ = !has_odometry_ || norm((inverse(last_pose_) * odometry).position()) > 0.0 ||
                      (odometry.theta - last_pose_.theta).radians() != 0.0;
  has_odometry_ = true;
  last_odometry_ = now;
  last_pose_ = odometry;
  constexpr std::array<double, 6> kVariance{1e-4, 1e-4, 1e6, 1e6, 1e6, 1e-3};
  for (std::size_t i = 0; i < 6; ++i) {
    message.pose.covariance[7 * i] = kVariance[i];
    message.twist.covariance[7 * i] = kVariance[i];
  }
  emit(Sensor::odom, odometry_, std::move(message), last_odom_, now);
}

void Instruments::publish_scan(Time now, Scanner& scanner, const Pose2& pose, std::span<const Posture> people) {
  const LaserParams& params = scanner.laser.params();
  const Plane& plane = planes_[scanner.plane];
  slice_.cut(people, plane.height, (pose * scanner.laser.base_from_scanner()).position(), params.max_range);
  const auto& sweep = scanner.laser.sweep(*plane.walls, slice_.discs(), pose);
  sensor_msgs::LaserScan message;
  message.header = {to_message(now), scanner.frame};
  WrittenSweep written = as_written(scanner.kind, params, sweep.ranges);
  message.angle_min = static_cast<float>(written.angle_min);
  message.angle_max = static_cast<float>(written.angle_min + (params.beams - 1) * written.angle_increment);
  message.angle_increment = static_cast<float>(written.angle_increment);
  message.scan_time = static_cast<float>(1.0 / scanner.kind.rate);
  message.range_min = 0.05F;
  message.range_max = static_cast<float>(params.max_range);
  message.ranges = std::move(written.ranges);
  scanner.met.assign(people.size(), 0);
  scanner.blocked = 0;
  for (const std::int32_t disc : sweep.discs) {
    if (disc < 0) continue;
    ++scanner.blocked;
    ++scanner.met[slice_.persons()[static_cast<std::size_t>(disc)]];
  }
  scanner.lies.tell(now,
                    {message.ranges, message.range_min, message.range_max, message.angle_min, message.angle_increment});
  if (scanner.late > 0.0) {
    bus_.after(seconds(scanner.late), [this, &scanner, message = std::move(message)]() mutable {
      message.header.stamp = to_message(bus_.now());
      emit(scanner.sensor, scanner.scans, std::move(message), scanner.last, bus_.now());
    });
    return;
  }
  emit(scanner.sensor, scanner.scans, std::move(message), scanner.last, now);
}

void Instruments::publish_scans(Time now, std::size_t step, const Pose2& world_from_base,
                                std::span<const Posture> people) {
  for (Scanner& scanner : scanners_)
    if (is_due(step, scanner.kind.rate)) publish_scan(now, scanner, world_from_base, people);
}

int Instruments::met(std::size_t person) const {
  int beams = 0;
  for (const Scanner& scanner : scanners_)
    if (person < scanner.met.size()) beams += scanner.met[person];
  return beams;
}

double Instruments::blocked_share() const {
  double share = 0.0;
  for (const Scanner& scanner : scanners_) share += static_cast<double>(scanner.blocked) / beams_;
  return share;
}

double Instruments::left_out() const {
  double angle = 0.0;
  for (const Scanner& scanner : scanners_) angle += scanner.lies.left_out();
  return angle;
}

void Instruments::publish_sonar(Time now, std::uint64_t slot, const Pose2& world_from_base,
                                std::span<const Posture> people) {
  constexpr std::uint64_t kSlots = 40;  // 0.4 s
  const auto groups = static_cast<std::uint64_t>(ring_.groups());
  for (std::uint64_t turn = 0; turn < groups; ++turn) {
    if (turn * kSlots / groups != slot % kSlots) continue;
    // A cone is tall: the echo is that of the body, wherever the legs are.
    slice_.cut_trunks(people, world_from_base.position(), ring_.params().max_range + ring_.params().ring_radius);
    // Neighbours never fire one after the other: each would hear the other's echo.
    const auto group = static_cast<int>(turn * (groups % 3 == 0 ? 1 : 3) % groups);
    for (const Ping& ping : ring_.fire(group, *sonar_walls_, slice_.discs(), world_from_base)) publish_ping(now, ping);
  }
}

void Instruments::publish_ping(Time now, const Ping& ping) {
  const SonarParams& params = ring_.params();
  sensor_msgs::Range message;
  message.header = {to_message(now),
                    ping.index < 10 ? "sonar_0" + std::to_string(ping.index) : "sonar_" + std::to_string(ping.index)};
  message.field_of_view = static_cast<float>(params.field_of_view);
  message.min_range = static_cast<float>(params.min_range);
  message.max_range = static_cast<float>(params.max_range);
  message.range = static_cast<float>(ping.range);
  emit(Sensor::sonar, pings_, std::move(message), last_pings_[static_cast<std::size_t>(ping.index)], now);
}

void Instruments::publish_infrared(Time now, std::uint64_t slot, const Pose2& world_from_base,
                                   std::span<const Posture> people) {
  constexpr std::uint64_t kSlots = 20;  // 0.2 s
  const InfraredParams& params = infrared_.params();
  const auto count = static_cast<std::uint64_t>(params.count);
  const double reach = params.max_range + params.ring_radius;
  slice_.cut(people, kInfraredHeight, world_from_base.position(), reach);
  for (std::uint64_t index = 0; index < count; ++index) {
    if (index * kSlots / count != slot % kSlots) continue;
    sensor_msgs::Range message;
    message.header = {to_message(now), (index < 10 ? "infrared_0" : "infrared_") + std::to_string(index)};
    message.radiation_type = 1;
    message.field_of_view = static_cast<float>(params.field_of_view);
    message.min_range = static_cast<float>(params.min_range);
    message.max_range = static_cast<float>(params.max_range);
    message.range =
        static_cast<float>(infrared_.read(static_cast<int>(index), *infrared_walls_, slice_.discs(), world_from_base));
    emit(Sensor::infrared, infrared_readings_, std::move(message), last_infrared_[index], now);
  }
}

void Instruments::publish_battery(Time now, const Battery& battery) {
  sensor_msgs::BatteryState message;
  message.header = {to_message(now), "base_link"};
  message.voltage = static_cast<float>(battery.voltage());
  message.current = static_cast<float>(battery.current());
  message.design_capacity = 24.0F;
  message.capacity = 24.0F;
  message.charge = static_cast<float>(24.0 * battery.charge());
  message.percentage = static_cast<float>(battery.charge());
  message.temperature = 25.0F;
  message.power_supply_status = battery.supply_status();
  message.power_supply_health = 1;
  battery_.publish(std::move(message));
}

void Instruments::publish_tactile(Time now, const std::vector<std::uint8_t>& segments) {
  if (!has_tactile_) return;
  emit(Sensor::tactile, tactile_, {{to_message(now), "base_link"}, segments, ++tactile_scan_}, last_tactile_, now);
}

bool Instruments::sees(const Pose2& world_from_base, std::size_t person, std::span<const Posture> people) const {
  Slice slice;
  return std::any_of(scanners_.begin(), scanners_.end(), [&](const Scanner& scanner) {
    const Pose2 world_from_scanner = world_from_base * scanner.laser.base_from_scanner();
    const double away = distance(people[person].at, world_from_scanner.position());
    slice.cut(people, planes_[scanner.plane].height, world_from_scanner.position(), away);
    for (std::size_t disc = 0; disc < slice.discs().size(); ++disc)
      if (slice.persons()[disc] == person && shows(scanner, world_from_scanner, disc, slice)) return true;
    return false;
  });
}

bool Instruments::shows(const Scanner& scanner, const Pose2& world_from_scanner, std::size_t disc,
                        const Slice& slice) const {
  const LaserParams& params = scanner.laser.params();
  const Point2 from = world_from_scanner.position();
  const Disc& target = slice.discs()[disc];
  const Point2 offset = target.centre - from;
  const double away = norm(offset);
  if (away < 1e-6) return true;
  if (away > params.max_range) return false;
  const double first_bearing = params.first_bearing - 0.5 * params.bearing_step;  // of what the first beam stands for
  const double last_bearing = first_bearing + params.beams * params.bearing_step;
  const Point2 across = (0.8 * target.radius / away) * Point2{-offset.y, offset.x};
  const RayCaster& walls = *planes_[scanner.plane].walls;
  for (const double side : {0.0, 1.0, -1.0}) {
    const Point2 point = target.centre + side * across;
    const double range = distance(from, point);
    const Point2 ray = (1.0 / range) * (point - from);
    const double bearing = (Angle::radians(std::atan2(ray.y, ray.x)) - world_from_scanner.theta).radians();
    bool is_free = bearing >= first_bearing && bearing <= last_bearing && walls.sees(from, point);
    for (std::size_t other = 0; other < slice.discs().size() && is_free; ++other) {
      const Disc& before = slice.discs()[other];
      if (slice.persons()[other] == slice.persons()[disc] || distance(before.centre, from) > away) continue;
      const auto hit = ray_distance(from, ray, before.centre, before.radius);
      if (hit && *hit < range - target.radius) is_free = false;
    }
    if (is_free) return true;
  }
  return false;
}

}  // namespace docent::simulator
