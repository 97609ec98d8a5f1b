// A module is a class that has a Bus, and nothing else, to talk to others: it subscribes, it publishes, it has timers.
// The same class runs in virtual time, where a run is the same bit for bit, and over DDS beside ROS 2 (DdsBus::create).
// This one drives ahead and stops before what it sees. Beside it runs another one, which stands in for the robot.
#include <docent/messages/topics.h>
#include <docent/transport/virtual_time_bus.h>

#include <string>

#include "simulated_base.h"

namespace {

class StopsBeforeWalls {
 public:
  explicit StopsBeforeWalls(docent::transport::Bus& bus) : commands_{bus.publisher(docent::topics::kCommandVelocity)} {
    bus.subscribe<docent::sensor_msgs::LaserScan>(docent::topics::kScanFront, [this](const auto& scan) { see(scan); });
  }
  StopsBeforeWalls(const StopsBeforeWalls&) = delete;  // the subscription holds `this`

 private:
  void see(const docent::sensor_msgs::LaserScan& scan) {
    float nearest = scan.range_max;
    for (const float range : scan.ranges) nearest = std::min(nearest, range);
    docent::geometry_msgs::Twist command;
    command.linear.x = std::clamp(0.5 * (nearest - 0.6), 0.0, 0.5);  // [m/s]
    commands_.publish(command);
  }
  docent::transport::Publisher<docent::geometry_msgs::Twist> commands_;
};

}  // namespace

int main(int argc, char** argv) {
  const std::string museum = example::argument_or_exit(argc, argv, "MUSEUM", DOCENT_MUSEUM);
  const docent::OccupancyGrid map = example::value_or_exit(docent::load_map(museum + "/map.yaml"));
  docent::Pose2 ends[2];
  double gap = 0.0;
  for (docent::Pose2& end : ends) {  // twice, to compare
    docent::transport::VirtualTimeHub hub;
    const auto bus_of_module = hub.connect("stops"), bus_of_base = hub.connect("base");
    example::SimulatedBase base{*bus_of_base, map};
    StopsBeforeWalls module{*bus_of_module};
    hub.run_until(docent::time_from_seconds(90.0));  // takes some milliseconds
    end = base.pose();
    gap = 10.0;
    for (const auto& beam : base.look().beams)
      if (std::abs(beam.bearing) <= 0.5) gap = std::min(gap, beam.range);
  }
  std::printf("After 90 s it stands at (%.3f, %.3f), %.2f m from a wall, after %.1f m\n", ends[0].x, ends[0].y, gap,
              ends[0].y - 3.6);
  const bool is_same = ends[0].x == ends[1].x && ends[0].y == ends[1].y;
  std::printf("The second run ended at %s place\n", is_same ? "the same" : "another");
  return is_same && gap > 0.5 && gap < 0.7 && ends[0].y > 4.6 ? 0 : 1;
}
