// No laser sees glass, a plate on the floor or a staircase. But a robot that knows the map and, roughly, where it is
// can measure them in its mind: in each direction the largest range that with 99 % underestimates the true one,
// whatever pose of its belief is right. The less it knows, the nearer such hazards come, and the slower it drives.
#include <docent/collision_avoidance/virtual_measurements/virtual_measurements.h>
#include <docent/museum/museum.h>

#include <string>
#include <vector>

#include "simulated_robot.h"

using docent::collision_avoidance::VirtualMeasurements;
using docent::collision_avoidance::WeightedPose;

int main(int argc, char** argv) {
  const std::string folder = example::argument_or_exit(argc, argv, "MUSEUM", DOCENT_MUSEUM);
  const docent::museum::Museum museum = example::value_or_exit(docent::museum::load_museum(folder));
  const docent::Pose2 truth{14.5, 10.5, docent::Angle::degrees(90.0)};  // heads for the plate on the floor
  VirtualMeasurements measurements{museum.area, museum.hazard_polygons(), {}};

  // Three beliefs about the same robot: it knows, it is unsure by 10 cm, by 40 cm.
  docent::Rng rng{4};
  std::vector<VirtualMeasurements::Scan> scans;
  for (const double deviation : {0.0, 0.1, 0.4}) {
    std::vector<WeightedPose> belief;
    for (int i = 0; i < 4000; ++i) {
      const docent::Point2 off{rng.normal(0.0, deviation), rng.normal(0.0, deviation)};
      belief.push_back({truth.position() + off, truth.theta.radians() + rng.normal(0.0, 0.2 * deviation), 1.0 / 4000});
    }
    scans.push_back(measurements.measure(belief, {}));
  }

  std::printf("bearing    known  +-10 cm  +-40 cm   [m] to what no sensor sees\n");
  for (int i = 0; i < VirtualMeasurements::kDirections; i += 10) {
    const auto direction = static_cast<std::size_t>(i);
    std::printf("%4d deg %8.2f %8.2f %8.2f\n", 2 * i - 180, scans[0].ranges[direction], scans[1].ranges[direction],
                scans[2].ranges[direction]);
  }
  // The promise: no belief that holds the truth measures farther than the truth allows; and ahead lies the plate.
  bool is_safe = true;
  for (std::size_t i = 0; i < scans[0].ranges.size(); ++i)
    is_safe = is_safe && scans[1].ranges[i] <= scans[0].ranges[i] && scans[2].ranges[i] <= scans[1].ranges[i];
  const double ahead = scans[0].ranges[90];
  std::printf("straight ahead: %.2f m, of which %.2f m are left to a robot that knows its place to 40 cm\n", ahead,
              scans[2].ranges[90]);
  return is_safe && ahead > 2.0 && ahead < 3.0 && scans[2].ranges[90] < ahead - 0.4 ? 0 : 1;
}
