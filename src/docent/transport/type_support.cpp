#include "docent/transport/type_support.h"

// The type of each topic, compiled here alone: in every source that names topics it was most of what the compiler did.
// One that is missing fails to link.

namespace docent::transport {

template <Message T>
const TypeSupport& type_support() {
  static constexpr TypeSupport kSupport = support_of<T>();
  return kSupport;
}

template const TypeSupport& type_support<docent_msgs::AvoidState>();
template const TypeSupport& type_support<docent_msgs::Belief>();
template const TypeSupport& type_support<docent_msgs::Button>();
template const TypeSupport& type_support<docent_msgs::ButtonLamps>();
template const TypeSupport& type_support<docent_msgs::Calibration>();
template const TypeSupport& type_support<docent_msgs::CameraView>();
template const TypeSupport& type_support<docent_msgs::Choice>();
template const TypeSupport& type_support<docent_msgs::Drive>();
template const TypeSupport& type_support<docent_msgs::DriveGoal>();
template const TypeSupport& type_support<docent_msgs::Event>();
template const TypeSupport& type_support<docent_msgs::Exploration>();
template const TypeSupport& type_support<docent_msgs::ExplorationOrder>();
template const TypeSupport& type_support<docent_msgs::Expression>();
template const TypeSupport& type_support<docent_msgs::Gaze>();
template const TypeSupport& type_support<docent_msgs::GoalState>();
template const TypeSupport& type_support<docent_msgs::Health>();
template const TypeSupport& type_support<docent_msgs::Horn>();
template const TypeSupport& type_support<docent_msgs::Limits>();
template const TypeSupport& type_support<docent_msgs::LiveMapUpdate>();
template const TypeSupport& type_support<docent_msgs::MissionState>();
template const TypeSupport& type_support<docent_msgs::MuseumMoved>();
template const TypeSupport& type_support<docent_msgs::Music>();
template const TypeSupport& type_support<docent_msgs::ObstacleLines>();
template const TypeSupport& type_support<docent_msgs::OfficeOrder>();
template const TypeSupport& type_support<docent_msgs::OfficeState>();
template const TypeSupport& type_support<docent_msgs::People>();
template const TypeSupport& type_support<docent_msgs::PersonBeams>();
template const TypeSupport& type_support<docent_msgs::Reaction>();
template const TypeSupport& type_support<docent_msgs::PoseFix>();
template const TypeSupport& type_support<docent_msgs::Request>();
template const TypeSupport& type_support<docent_msgs::RequestBoard>();
template const TypeSupport& type_support<docent_msgs::RunInfo>();
template const TypeSupport& type_support<docent_msgs::Say>();
template const TypeSupport& type_support<docent_msgs::SeenThings>();
template const TypeSupport& type_support<docent_msgs::SoundState>();
template const TypeSupport& type_support<docent_msgs::SpeechState>();
template const TypeSupport& type_support<docent_msgs::Steering>();
template const TypeSupport& type_support<docent_msgs::Stop>();
template const TypeSupport& type_support<docent_msgs::Tactile>();
template const TypeSupport& type_support<docent_msgs::Target>();
template const TypeSupport& type_support<docent_msgs::Task>();
template const TypeSupport& type_support<docent_msgs::TaskState>();
template const TypeSupport& type_support<docent_msgs::TrueContact>();
template const TypeSupport& type_support<docent_msgs::TrueOffer>();
template const TypeSupport& type_support<docent_msgs::TrueState>();
template const TypeSupport& type_support<docent_msgs::Votes>();
template const TypeSupport& type_support<diagnostic_msgs::DiagnosticArray>();
template const TypeSupport& type_support<geometry_msgs::PoseArray>();
template const TypeSupport& type_support<geometry_msgs::PoseStamped>();
template const TypeSupport& type_support<geometry_msgs::PoseWithCovarianceStamped>();
template const TypeSupport& type_support<geometry_msgs::Twist>();
template const TypeSupport& type_support<nav2_msgs::ParticleCloud>();
template const TypeSupport& type_support<nav_msgs::OccupancyGrid>();
template const TypeSupport& type_support<nav_msgs::Odometry>();
template const TypeSupport& type_support<nav_msgs::Path>();
template const TypeSupport& type_support<sensor_msgs::BatteryState>();
template const TypeSupport& type_support<sensor_msgs::CameraInfo>();
template const TypeSupport& type_support<sensor_msgs::CompressedImage>();
template const TypeSupport& type_support<sensor_msgs::Image>();
template const TypeSupport& type_support<sensor_msgs::JointState>();
template const TypeSupport& type_support<sensor_msgs::LaserScan>();
template const TypeSupport& type_support<sensor_msgs::Range>();
template const TypeSupport& type_support<tf2_msgs::TFMessage>();
template const TypeSupport& type_support<visualization_msgs::MarkerArray>();

}  // namespace docent::transport
