#include <chrono>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <string>
#include <thread>

#include "fast_node.h"
#include "tour_content.h"

// A base whose driver speaks Fast DDS: fast_base ROLE DOMAIN NUMBER [stamped].
//   tour    NUMBER steps of a tour, one after the other: sensors out, then the command that answers them
//   drive   a base that obeys for NUMBER seconds, in real time
//   list    what it hears of others within NUMBER seconds
// Ends with 0 where all went as promised.

namespace second_vendor {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kPatience = 15s;  // to find the other side

Time stamp_of(std::chrono::nanoseconds since_epoch) {
  Time stamp;
  stamp.sec = static_cast<std::int32_t>(since_epoch.count() / 1000000000);
  stamp.nanosec = static_cast<std::uint32_t>(since_epoch.count() % 1000000000);
  return stamp;
}
/// Of a step of the tour, 20 a second: what tells the other side which step it is.
Time stamp_of_step(std::uint32_t step) { return stamp_of(1700000000s + step * 50ms); }

void set_pose(Pose& pose, double x, double y, double yaw) {
  pose.position.x = x;
  pose.position.y = y;
  pose.orientation.z = std::sin(yaw / 2);
  pose.orientation.w = std::cos(yaw / 2);
}

LaserScan full_circle(const std::string& frame, const Time& stamp) {
  LaserScan scan;
  scan.header.stamp = stamp;
  scan.header.frame_id = frame;
  scan.angle_increment = static_cast<float>(2.0 * M_PI / kBeams);
  scan.angle_min = static_cast<float>(-M_PI);
  scan.angle_max = static_cast<float>(M_PI) - scan.angle_increment;
  scan.scan_time = 0.1F;
  scan.range_min = 0.05F;
  scan.range_max = 12.0F;
  return scan;
}

int fail(const std::string& what) {
  std::cout << "FAILED " << what << std::endl;
  return 1;
}

/// What a driver offers, and what it asks for.
struct Base {
  explicit Base(FastNode& node, bool is_stamped)
      : scan_front{node.writer<LaserScan>("scan_front", Quality::sensor_data)},
        scan_rear{node.writer<LaserScan>("scan_rear", Quality::reliable)},
        odom{node.writer<Odometry>("odom", Quality::reliable)},
        battery{node.writer<BatteryState>("battery_state", Quality::reliable)},
        tf{node.writer<TFMessage>("tf", Quality::reliable)} {
    if (is_stamped) {
      node.reader<TwistStamped>("cmd_vel", Quality::reliable, &stamped);
    } else {
      node.reader<Twist>("cmd_vel", Quality::reliable, &plain);
    }
  }
  std::optional<Twist> command(std::chrono::milliseconds patience, bool is_stamped) {
    if (!is_stamped) return plain.take(patience);
    const auto message = stamped.take(patience);
    if (!message) return std::nullopt;
    if (message->header.frame_id != "base_link" || message->header.stamp.sec == 0) return Twist{};
    return message->twist;
  }

  dds::DataWriter *scan_front, *scan_rear, *odom, *battery, *tf;
  Inbox<Twist> plain;
  Inbox<TwistStamped> stamped;
};

void send_step(const Base& base, std::uint32_t step) {
  LaserScan scan = full_circle("laser", stamp_of_step(step));
  scan.ranges.resize(kBeams);
  for (int i = 0; i < kBeams; ++i) scan.ranges[static_cast<std::size_t>(i)] = range_of(step, i);
  base.scan_front->write(&scan);
  for (int i = 0; i < kBeams; ++i) scan.ranges[static_cast<std::size_t>(i)] = range_of(step + 7, i);
  scan.intensities.assign(step % 5, 47.0F);
  base.scan_rear->write(&scan);
  BatteryState battery;
  battery.header.stamp = scan.header.stamp;
  battery.percentage = 0.5F;
  battery.voltage = static_cast<float>(step);
  battery.present = true;
  battery.cell_voltage = {3.7F, 3.8F, 3.9F};
  battery.serial_number = std::to_string(step);
  if (step % 20 == 0) base.battery->write(&battery);
  TFMessage frames;
  frames.transforms.resize(2);
  for (auto& frame : frames.transforms) frame.header.stamp = scan.header.stamp;
  frames.transforms[1].header.frame_id = "odom";
  frames.transforms[1].child_frame_id = "base_footprint";
  set_pose(frames.transforms[1].transform, odometry_x(step), 1.0, odometry_yaw(step));
  base.tf->write(&frames);
  Odometry odometry;
  odometry.header.stamp = scan.header.stamp;
  odometry.header.frame_id = "odom";
  odometry.child_frame_id = "base_link";
  set_pose(odometry.pose.pose, odometry_x(step), -2.0, odometry_yaw(step));
  odometry.pose.covariance[35] = 0.25;
  odometry.twist.linear.x = speed_of(step);
  odometry.twist_covariance[0] = 1.0 / (1.0 + step);
  base.odom->write(&odometry);
}

std::string fault_of(const OccupancyGrid& map) {
  if (map.width != kMapWidth || map.height != kMapHeight || map.data.size() != std::size_t{kMapWidth} * kMapHeight)
    return "the map's size";
  if (map.resolution != 0.05F || map.origin.position.x != -3.5 || map.header.frame_id != "map") return "the map's head";
  for (std::size_t i = 0; i < map.data.size(); ++i)
    if (map.data[i] != map_cell(i)) return "cell " + std::to_string(i) + " of the map";
  return {};
}

int tour(FastNode& node, std::uint32_t steps, bool is_stamped) {
  Base base{node, is_stamped};
  Inbox<OccupancyGrid> maps;
  node.reader<OccupancyGrid>("map", Quality::latched, &maps);
  Inbox<TFMessage> frames;
  node.reader<TFMessage>("tf", Quality::reliable, &frames);
  dds::DataWriter* live_map = node.writer<OccupancyGrid>("docent/live_map", Quality::latched);

  // A map that was published before this program was there.
  auto map = maps.take(kPatience);
  if (!map) return fail("no map");
  if (const auto fault = fault_of(*map); !fault.empty()) return fail(fault);
  live_map->write(&*map);  // and back

  std::uint32_t repeated = 0;
  for (std::uint32_t step = 0; step < steps; ++step) {
    std::optional<Twist> command;
    for (int attempt = 0; !command; ++attempt) {
      if (attempt > 30) return fail("no command for step " + std::to_string(step));
      if (attempt > 0 && step > 0) ++repeated;
      send_step(base, step);
      command = base.command(500ms, is_stamped);
      // An answer to a step that was sent twice.
      while (command && step > 0 && command->angular.x == step - 1) command = base.command(500ms, is_stamped);
    }
    if (command->angular.x != step || command->linear.x != speed_of(step) || command->angular.z != turn_of(step) ||
        command->linear.y != 0.0)
      return fail("command " + std::to_string(step));
    std::optional<TFMessage> frame;
    do {
      frame = frames.take(2s);
    } while (frame && !frame->transforms.empty() && frame->transforms.back().child_frame_id != "odom");
    if (!frame || frame->transforms.size() != 1 || frame->transforms[0].header.frame_id != "map" ||
        frame->transforms[0].transform.position.x != odometry_x(step))
      return fail("frame " + std::to_string(step));
  }
  std::cout << "OK " << steps << " steps, " << repeated << " sent again" << std::endl;
  // A program that ends takes along what nobody has heard yet.
  dds::PublicationMatchedStatus heard;
  for (int i = 0; i < 100 && heard.current_count == 0; ++i) {
    std::this_thread::sleep_for(100ms);
    live_map->get_publication_matched_status(heard);
  }
  live_map->wait_for_acknowledgments({5, 0});
  return 0;
}

/// A disc on a plane with a wall all round, ten metres away.
int drive(FastNode& node, int duration_s, bool is_stamped) {
  constexpr auto kPeriod = 50ms;
  constexpr double kStep = 0.05;
  Base base{node, is_stamped};
  double x = 0.0, y = 0.0, yaw = 0.0;
  Twist command;
  auto heard = Clock::now() - 1h;
  const auto end = Clock::now() + std::chrono::seconds{duration_s};
  for (auto next = Clock::now(); next < end; next += kPeriod) {
    std::this_thread::sleep_until(next);
    while (const auto newer = base.command(0ms, is_stamped)) {
      command = *newer;
      heard = Clock::now();
    }
    if (Clock::now() - heard > 300ms) command = {};  // as a base must
    x += command.linear.x * std::cos(yaw) * kStep;
    y += command.linear.x * std::sin(yaw) * kStep;
    yaw = std::remainder(yaw + command.angular.z * kStep, 2.0 * M_PI);
    Odometry odometry;
    odometry.header.stamp = stamp_of(std::chrono::system_clock::now().time_since_epoch());
    odometry.header.frame_id = "odom";
    odometry.child_frame_id = "base_link";
    set_pose(odometry.pose.pose, x, y, yaw);
    odometry.twist.linear.x = command.linear.x;
    odometry.twist.angular.z = command.angular.z;
    base.odom->write(&odometry);
    LaserScan scan = full_circle("laser", odometry.header.stamp);
    scan.ranges.assign(kBeams, static_cast<float>(10.0));
    base.scan_front->write(&scan);
    BatteryState battery;
    battery.header.stamp = odometry.header.stamp;
    battery.percentage = 0.8F;
    battery.voltage = 24.0F;
    base.battery->write(&battery);
  }
  std::cout << "OK drove to " << x << ' ' << y << ' ' << yaw << std::endl;
  return 0;
}

int list(const FastNode& node, int duration_s) {
  std::this_thread::sleep_for(std::chrono::seconds{duration_s});
  for (const auto& neighbour : node.neighbours())
    std::cout << "participant " << neighbour.name << " '" << neighbour.user_data << "'\n";
  for (const auto& endpoint : node.endpoints())
    std::cout << (endpoint.writes ? "writer " : "reader ") << endpoint.topic << ' ' << endpoint.type
              << (endpoint.is_reliable ? " reliable" : " best-effort")
              << (endpoint.is_latched ? " transient-local" : " volatile") << " '" << endpoint.user_data << "'\n";
  std::cout << "OK" << std::endl;
  return 0;
}

}  // namespace
}  // namespace second_vendor

int main(int argc, char** argv) {
  using namespace second_vendor;
  if (argc < 4) return 2;
  const std::string role = argv[1];
  const int number = std::atoi(argv[3]);
  bool is_stamped = false;
  auto range = FastNode::Range::localhost;
  for (int i = 4; i < argc; ++i) {
    if (std::strcmp(argv[i], "stamped") == 0) is_stamped = true;
    if (std::strcmp(argv[i], "subnet") == 0) range = FastNode::Range::subnet;
  }
  FastNode node{std::atoi(argv[2]), range};
  if (!node.is_up()) return fail("no participant");
  if (role == "tour") return tour(node, static_cast<std::uint32_t>(number), is_stamped);
  if (role == "drive") return drive(node, number, is_stamped);
  if (role == "list") return list(node, number);
  return 2;
}
