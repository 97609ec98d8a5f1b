#include <dds/dds.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <numeric>

#include "docent/messages/conversions.h"
#include "docent/transport/cdr_sertype.h"
#include "docent/transport/dds_bus.h"

// The other process of dds_bus_test: dds_peer ROLE DOMAIN. Runs until it is killed.

int main(int argc, char** argv) {
  using namespace docent;
  if (argc != 3) return 2;
  const std::string role = argv[1];
  auto created = transport::DdsBus::create({std::atoi(argv[2]), "", {}});
  if (!created) {
    std::cerr << created.error().message << '\n';
    return 1;
  }
  transport::DdsBus& bus = **created;
  if (role == "scans") {
    sensor_msgs::LaserScan scan;
    scan.angle_increment = 0.01F;
    scan.range_max = 10.0F;
    for (int i = 0; i < 360; ++i) scan.ranges.push_back(static_cast<float>(i) * 0.01F);
    bus.every(std::chrono::milliseconds{20}, [scan, out = bus.publisher(topics::kScanFront)] { out.publish(scan); });
  } else if (role == "drive_echo") {
    // What it obeys, with the time of its own clock at which it did.
    bus.subscribe<docent_msgs::Drive>(
        topics::kDrive, [&bus, out = bus.publisher(topics::kHorn)](const docent_msgs::Drive& drive) {
          out.publish({drive.header, std::to_string(to_seconds(bus.now() - from_message(drive.header.stamp)))});
        });
  } else if (role == "map") {
    nav_msgs::OccupancyGrid map;
    map.info.resolution = 0.05F;
    map.info.width = map.info.height = 2000;
    map.data.resize(std::size_t{2000} * 2000);
    for (std::size_t i = 0; i < map.data.size(); ++i) map.data[i] = static_cast<std::int8_t>(i % 101);
    bus.publisher(topics::kStaticMap).publish(map);
  } else if (role == "map_echo") {
    bus.subscribe<nav_msgs::OccupancyGrid>(topics::kStaticMap,
                                           [out = bus.publisher(topics::kHorn)](const nav_msgs::OccupancyGrid& map) {
                                             out.publish({{}, std::to_string(std::lround(map.info.origin.position.x))});
                                           });
  } else if (role == "joystick") {
    // As programs of ROS 2 do: no lease of its own, and a type that nobody here reads.
    ddsi_sertype* type = transport::make_cdr_sertype("geometry_msgs::msg::dds_::TwistStamped_");
    const dds_entity_t participant = dds_create_participant(std::atoi(argv[2]), nullptr, nullptr);
    const dds_entity_t topic = dds_create_topic_sertype(participant, "rt/cmd_vel", &type, nullptr, nullptr, nullptr);
    if (dds_create_writer(participant, topic, nullptr, nullptr) < 0) return 1;
  } else if (role == "second_robot") {
    bus.every(std::chrono::milliseconds{50}, [out = bus.publisher(topics::kCommandVelocity)] {
      out.publish({{0.1, 0.0, 0.0}, {}});
    });
  } else {
    return 2;
  }
  bus.run({});
  return 0;
}
