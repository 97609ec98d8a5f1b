#pragma once

#include <string_view>

#include "docent/base/time.h"
#include "docent/messages/docent_messages.h"
#include "docent/messages/message_fitness.h"
#include "docent/messages/nav2_messages.h"
#include "docent/messages/standard_messages.h"
#include "docent/messages/visualization_messages.h"

// Every topic, declared once: name, type, quality of service. A ROS 2 peer sees /scan_front; on the wire it is
// rt/scan_front (ROS 2's prefix for topics).

namespace docent {

/// Quality of service, by what a topic is for.
enum class Qos {
  sensor,   ///< best effort, the last few; late joiners get nothing
  state,    ///< reliable, transient-local, the last one: a late joiner gets the present state
  command,  ///< reliable, volatile, the last few
};

/// A topic: its name and how it is delivered.
template <class T>
struct Topic {
  using Type = T;        ///< of its messages
  const char* name;      ///< without ROS 2's prefix
  Qos qos;               ///< how it is delivered
  int depth = 0;         ///< samples kept for a reader that is late; 0: what the class says
  double max_age_s = 0;  ///< under DDS, older samples are dropped; 0: any age. For what must not be obeyed late: a
                         ///< process that was stopped and goes on finds all that it missed.
  MessageFault (*fault)(const T& message) = nullptr;  ///< of what is fit for its type and yet not for this topic
};

/// What is wrong with a message that came on `topic`; `of_type` is what fault_of says of it.
template <class T>
[[nodiscard]] MessageFault fault_on(const Topic<T>& topic, const T& message, const MessageFault& of_type) {
  return of_type || topic.fault == nullptr ? of_type : topic.fault(message);
}

namespace topics {

// Hardware, as any ROS 2 base offers it. Published by the simulator or by drivers.
inline constexpr Topic<sensor_msgs::LaserScan> kScanFront{"scan_front", Qos::sensor};
inline constexpr Topic<sensor_msgs::LaserScan> kScanRear{"scan_rear", Qos::sensor};
inline constexpr Topic<sensor_msgs::LaserScan> kScanLeft{"scan_left", Qos::sensor};
inline constexpr Topic<sensor_msgs::LaserScan> kScanRight{"scan_right", Qos::sensor};
inline constexpr Topic<sensor_msgs::Range> kSonar{"sonar", Qos::sensor, 96};        // 24 sensors, one topic
inline constexpr Topic<sensor_msgs::Range> kInfrared{"infrared", Qos::sensor, 96};  // likewise
inline constexpr Topic<nav_msgs::Odometry> kOdometry{"odom", Qos::sensor};
inline constexpr Topic<sensor_msgs::BatteryState> kBattery{"battery_state", Qos::sensor};
inline constexpr Topic<docent_msgs::Tactile> kTactile{"tactile", Qos::sensor};
inline constexpr Topic<docent_msgs::ObstacleLines> kObstacleLines{"obstacle_lines", Qos::sensor};
/// On the robot's head, and in the hall: [Rhino1999] 5.2 shows both. Under DDS a picture may be a few kilobytes or some
/// hundred.
inline constexpr Topic<sensor_msgs::CompressedImage> kCamera{"camera/image/compressed", Qos::sensor, 1};
inline constexpr Topic<sensor_msgs::CompressedImage> kSceneCamera{"scene_camera/image/compressed", Qos::sensor, 1};
/// The same from drivers that do not compress, which then need no topic of a compressed picture.
inline constexpr Topic<sensor_msgs::Image> kCameraImage{"camera/image", Qos::sensor, 1};
inline constexpr Topic<sensor_msgs::Image> kSceneCameraImage{"scene_camera/image", Qos::sensor, 1};
/// The robot's eyes, which no person looks through: ahead and down, in mm or m of depth and in colour, and up at the
/// ceiling. Their lenses are said beside them.
inline constexpr Topic<sensor_msgs::Image> kDepthImage{"depth_camera/image", Qos::sensor, 1};
inline constexpr Topic<sensor_msgs::CameraInfo> kDepthInfo{"depth_camera/camera_info", Qos::sensor, 1};
inline constexpr Topic<sensor_msgs::Image> kFrontImage{"front_camera/image", Qos::sensor, 1};
inline constexpr Topic<sensor_msgs::CameraInfo> kFrontInfo{"front_camera/camera_info", Qos::sensor, 1};
inline constexpr Topic<sensor_msgs::Image> kCeilingImage{"ceiling_camera/image", Qos::sensor, 1};
inline constexpr Topic<sensor_msgs::CameraInfo> kCeilingInfo{"ceiling_camera/camera_info", Qos::sensor, 1};
inline constexpr Topic<docent_msgs::CameraView> kSceneCameraView{"scene_camera/view", Qos::command, 0, 2.0};
inline constexpr Topic<geometry_msgs::Twist> kCommandVelocity{"cmd_vel", Qos::command, 0, 0.3};
// Frames.
inline constexpr Topic<tf2_msgs::TFMessage> kTransforms{"tf", Qos::sensor};
/// Each of several programs says its own part once: a reader must keep them all, and tf2's keeps as many.
inline constexpr Topic<tf2_msgs::TFMessage> kStaticTransforms{"tf_static", Qos::state, 100};
// State estimation.
inline constexpr Topic<nav_msgs::OccupancyGrid> kStaticMap{"map", Qos::state};
inline constexpr Topic<nav_msgs::OccupancyGrid> kLiveMap{"docent/live_map", Qos::state};
inline constexpr Topic<docent_msgs::LiveMapUpdate> kLiveMapUpdate{"docent/live_map_updates", Qos::command};
inline constexpr Topic<docent_msgs::Belief> kBelief{"docent/belief", Qos::state};
inline constexpr Topic<geometry_msgs::PoseWithCovarianceStamped> kPose{"amcl_pose", Qos::state};
inline constexpr Topic<docent_msgs::PoseFix> kPoseFix{"docent/pose_fix", Qos::sensor};
/// From a person with rviz2 or Lichtblick: here stands the robot.
inline constexpr Topic<geometry_msgs::PoseWithCovarianceStamped> kInitialPose{"initialpose", Qos::command, 0, 2.0,
                                                                              fault_of_initial_pose};
/// Likewise: there shall it go. Obeyed where mission.goal_poses says so.
inline constexpr Topic<geometry_msgs::PoseStamped> kGoalPose{"goal_pose", Qos::command, 0, 2.0, fault_of_goal_pose};
inline constexpr Topic<docent_msgs::Exploration> kExploration{"docent/exploration", Qos::state};
inline constexpr Topic<docent_msgs::ExplorationOrder> kExplorationOrder{"docent/exploration_order", Qos::state};
inline constexpr Topic<docent_msgs::Calibration> kCalibration{"docent/calibration", Qos::state};
inline constexpr Topic<docent_msgs::SeenThings> kSeenThings{"docent/seen_things", Qos::state};
inline constexpr Topic<docent_msgs::PersonBeams> kPersonBeams{"docent/person_beams", Qos::sensor};
inline constexpr Topic<docent_msgs::People> kPeople{"docent/people", Qos::sensor};
inline constexpr Topic<docent_msgs::People> kPeopleInOdom{"docent/people_odom", Qos::sensor};
// Motion.
/// Goes round twice, see fault_of_virtual_scan: rviz shows both turns in one another.
inline constexpr Topic<sensor_msgs::LaserScan> kVirtualScan{"docent/virtual_scan", Qos::sensor, 0, 0.0,
                                                            fault_of_virtual_scan};
inline constexpr Topic<docent_msgs::DriveGoal> kDriveGoal{"docent/drive_goal", Qos::state};
inline constexpr Topic<docent_msgs::GoalState> kGoalState{"docent/goal_state", Qos::state};
inline constexpr Topic<docent_msgs::Target> kTarget{"docent/target", Qos::command, 0, 1.0};
inline constexpr Topic<nav_msgs::Path> kPath{"docent/path", Qos::state};
/// Share of the costs to the goal, 0 at it, 100 farthest; -1: no way from there. For those who look; no module needs
/// it.
inline constexpr Topic<nav_msgs::OccupancyGrid> kValueFunction{"docent/value_function", Qos::state};
/// Older steering is no longer meant: the avoidance stops by itself.
inline constexpr Topic<docent_msgs::Steering> kSteering{"docent/steering", Qos::command, 0, 0.5};
inline constexpr Topic<docent_msgs::Stop> kStop{"docent/stop", Qos::state};
inline constexpr Topic<docent_msgs::Drive> kDrive{"docent/drive", Qos::command, 0, 0.3};
inline constexpr Topic<docent_msgs::AvoidState> kAvoidState{"docent/avoid_state", Qos::sensor};
// Task and interaction.
inline constexpr Topic<docent_msgs::Request> kRequest{"docent/request", Qos::command};
inline constexpr Topic<docent_msgs::Choice> kChoice{"docent/choice", Qos::command};
inline constexpr Topic<docent_msgs::Votes> kVotes{"docent/votes", Qos::state};
inline constexpr Topic<docent_msgs::RequestBoard> kRequestBoard{"docent/request_board", Qos::state};
inline constexpr Topic<docent_msgs::MissionState> kMissionState{"docent/mission_state", Qos::state};
inline constexpr Topic<docent_msgs::Task> kTask{"docent/task", Qos::state};
inline constexpr Topic<docent_msgs::TaskState> kTaskState{"docent/task_state", Qos::state};
/// An order that comes late is meant no longer: whoever gave it has seen that the robot did not take it.
inline constexpr Topic<docent_msgs::OfficeOrder> kOfficeOrder{"docent/office_order", Qos::command, 0, 5.0};
inline constexpr Topic<docent_msgs::OfficeState> kOfficeState{"docent/office_state", Qos::state};
inline constexpr Topic<docent_msgs::Event> kEvent{"docent/event", Qos::command};
inline constexpr Topic<docent_msgs::Reaction> kReaction{"docent/reaction", Qos::command};
inline constexpr Topic<docent_msgs::Gaze> kGaze{"docent/gaze", Qos::sensor};
inline constexpr Topic<docent_msgs::Expression> kExpression{"docent/expression", Qos::sensor};
/// Where the joints of head and face shall be, for robots that have them; see head_module.h.
inline constexpr Topic<sensor_msgs::JointState> kHeadCommand{"head/joint_command", Qos::command, 0, 0.5};
/// Where the joints of the base are, as its drivers measure them. Recorded; no module reads it.
inline constexpr Topic<sensor_msgs::JointState> kJointStates{"joint_states", Qos::sensor};
/// A press that comes late means another question.
inline constexpr Topic<docent_msgs::Button> kButton{"docent/button", Qos::command, 0, 1.0};
inline constexpr Topic<docent_msgs::ButtonLamps> kButtonLamps{"docent/button_lamps", Qos::state};
inline constexpr Topic<docent_msgs::Say> kSay{"docent/say", Qos::command};
inline constexpr Topic<docent_msgs::SpeechState> kSpeechState{"docent/speech_state", Qos::state};
inline constexpr Topic<docent_msgs::Horn> kHorn{"docent/horn", Qos::command};
inline constexpr Topic<docent_msgs::Music> kMusic{"docent/music", Qos::state};
inline constexpr Topic<docent_msgs::SoundState> kSoundState{"docent/sound_state", Qos::state};
inline constexpr Topic<docent_msgs::Limits> kLimits{"docent/limits", Qos::state};
inline constexpr Topic<docent_msgs::MuseumMoved> kMuseumMoved{"docent/museum_moved", Qos::command, 0, 5.0};
inline constexpr Topic<docent_msgs::Health> kHealth{"docent/health", Qos::command};
// For viewers of ROS 2. No module of the robot reads them.
inline constexpr Topic<nav2_msgs::ParticleCloud> kParticleCloud{"particle_cloud", Qos::state};
inline constexpr Topic<geometry_msgs::PoseArray> kBeliefPoses{"docent/belief_poses", Qos::state};
inline constexpr Topic<diagnostic_msgs::DiagnosticArray> kDiagnostics{"diagnostics", Qos::command};
inline constexpr Topic<visualization_msgs::MarkerArray> kPeopleMarkers{"docent/people_markers", Qos::sensor};
inline constexpr Topic<visualization_msgs::MarkerArray> kMuseumMarkers{"docent/museum_markers", Qos::state};
// Ground truth: another DDS domain, one channel of a recording. No module of the robot may name these.
inline constexpr Topic<docent_msgs::RunInfo> kRunInfo{"truth/run_info", Qos::state};
inline constexpr Topic<docent_msgs::TrueState> kTrueState{"truth/state", Qos::command};
inline constexpr Topic<docent_msgs::TrueContact> kTrueContact{"truth/contact", Qos::command};
inline constexpr Topic<docent_msgs::TrueOffer> kTrueOffer{"truth/offer", Qos::command};

/// Of a laser scanner of the body: "front" speaks on scan_front. @pre name is one of RobotBody::kScannerNames
[[nodiscard]] inline const Topic<sensor_msgs::LaserScan>& scan_topic(std::string_view name) {
  for (const auto* topic : {&kScanRear, &kScanLeft, &kScanRight})
    if (name == std::string_view{topic->name}.substr(std::string_view{"scan_"}.size())) return *topic;
  return kScanFront;
}

}  // namespace topics

/// Calls f(topic) for every topic of the robot.
template <class F>
void for_each_robot_topic(F&& f) {
  using namespace topics;
  f(kScanFront), f(kScanRear), f(kSonar), f(kOdometry), f(kBattery), f(kTactile), f(kCommandVelocity);
  f(kScanLeft), f(kScanRight), f(kInfrared), f(kObstacleLines), f(kCamera), f(kSceneCamera), f(kSceneCameraView);
  f(kTransforms), f(kStaticTransforms), f(kStaticMap), f(kLiveMap), f(kLiveMapUpdate), f(kBelief), f(kPose);
  f(kExploration), f(kExplorationOrder), f(kCalibration);
  f(kPersonBeams), f(kPeople), f(kPeopleInOdom), f(kVirtualScan), f(kDriveGoal), f(kGoalState), f(kTarget), f(kPath),
      f(kValueFunction);
  f(kDrive), f(kAvoidState), f(kRequest), f(kChoice), f(kVotes), f(kRequestBoard), f(kMissionState), f(kTask),
      f(kTaskState), f(kEvent);
  f(kReaction), f(kGaze), f(kExpression), f(kButton), f(kButtonLamps), f(kSay), f(kSpeechState), f(kHorn), f(kMusic),
      f(kSoundState), f(kLimits), f(kSteering), f(kStop), f(kMuseumMoved), f(kHealth);
  f(kInitialPose), f(kGoalPose), f(kParticleCloud), f(kBeliefPoses), f(kPeopleMarkers), f(kMuseumMarkers);
  f(kHeadCommand), f(kJointStates), f(kDiagnostics), f(kCameraImage), f(kSceneCameraImage);
  f(kDepthImage), f(kDepthInfo), f(kCeilingImage), f(kCeilingInfo), f(kPoseFix);
  f(kFrontImage), f(kFrontInfo), f(kSeenThings), f(kOfficeOrder), f(kOfficeState);
}
/// Calls f(topic) for every topic of the truth.
template <class F>
void for_each_truth_topic(F&& f) {
  using namespace topics;
  f(kRunInfo), f(kTrueState), f(kTrueContact), f(kTrueOffer);
}

}  // namespace docent
