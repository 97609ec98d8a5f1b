#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "docent/base/random.h"
#include "docent/messages/topics.h"
#include "docent/simulator/scenario/eye_event.h"
#include "docent/simulator/sensing/camera/eyes/robot_eyes.h"
#include "docent/transport/bus.h"

namespace docent::simulator {

/// Which eyes the robot has.
struct EyeOptions {
  bool up = false;          ///< one that looks at the ceiling
  bool depth = false;       ///< one that measures how far the floor ahead is
  bool front = false;       ///< one that sees it in colours
  double up_rate = 2.5;     ///< [Hz], at most 10
  double depth_rate = 5.0;  ///< [Hz], at most 10
  double front_rate = 2.5;  ///< [Hz], at most 10
  RobotEyesParams eyes{};   ///< what they are like; their seed comes of the run
};

/// The robot's eyes with their drivers: publishes pictures and lenses as drivers of ROS 2 would. They draw from a
/// chance of their own and change nothing in the museum.
class EyeDrivers {
 public:
  /// The bus must outlive this.
  EyeDrivers(transport::Bus& bus, const EyeOptions& options, const Rng& rng);

  void set_fault(const EyeFault& fault, Time now);
  /// `step` counts steps of 10 ms.
  [[nodiscard]] bool is_due(std::uint64_t step) const;
  /// Takes the pictures that are due of what the renderer has, whose figures are those of now.
  void look(const Renderer& renderer, Time now, std::uint64_t step, const Pose2& world_from_base);
  /// Publishes what has arrived.
  void send(Time now);

 private:
  struct Eye {
    transport::Publisher<sensor_msgs::Image> images;
    transport::Publisher<sensor_msgs::CameraInfo> infos;
    sensor_msgs::CameraInfo info;
    std::optional<EyeFault> fault;
    Time fault_ends{};
    std::vector<std::uint8_t> last{};  ///< picture
  };
  struct Waiting {
    Time due{};
    Eye* eye = nullptr;
    sensor_msgs::Image image;
  };
  [[nodiscard]] static bool has(const Eye& eye, EyeFault::Kind kind, Time now);
  [[nodiscard]] static Eye eye_of(transport::Bus& bus, const Topic<sensor_msgs::Image>& images,
                                  const Topic<sensor_msgs::CameraInfo>& infos, const simulator::Eye& told,
                                  const char* frame);
  [[nodiscard]] Eye& which(EyeFault::Eye eye);
  void keep(Eye& eye, Time now, std::vector<std::uint8_t> bytes, const char* encoding, std::uint32_t pixel_bytes);

  EyeOptions options_;
  RobotEyes eyes_;
  Rng rng_;
  Eye up_, depth_, front_;
  std::deque<Waiting> waiting_;
  std::optional<Pose2> last_pose_;
  Time last_look_{};
};

}  // namespace docent::simulator
