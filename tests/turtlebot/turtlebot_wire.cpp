#include "turtlebot_wire.h"

#include <dds/dds.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "turtlebot.h"

namespace docent::turtlebot {
namespace {

constexpr int kTicksPerSecond = 60;
constexpr int kBeams = 360;
constexpr const char* kConfig =
    R"(<CycloneDDS><Domain Id="any"><General><Interfaces><NetworkInterface name="lo"/></Interfaces>
<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>
<MaxAutoParticipantIndex>120</MaxAutoParticipantIndex><Peers><Peer Address="127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>)";

std::int32_t good(std::int32_t entity, const char* what) {
  if (entity < 0) throw std::runtime_error{std::string{what} + ": " + dds_strretcode(-entity)};
  return entity;
}

std_msgs_msg_dds__Header_ header(const char* frame) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  return {{static_cast<std::int32_t>(nanoseconds / 1000000000), static_cast<std::uint32_t>(nanoseconds % 1000000000)},
          const_cast<char*>(frame)};
}

/// As rmw does: XCDR1, nothing disposed of.
std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> quality(bool is_reliable, bool is_latched, int depth) {
  std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos{dds_create_qos(), dds_delete_qos};
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &representation);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  dds_qset_reliability(qos.get(), is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_MSECS(100));
  dds_qset_durability(qos.get(), is_latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  return qos;
}

std::int32_t topic_of(std::int32_t participant, const dds_topic_descriptor_t& type, const std::string& name) {
  return good(dds_create_topic(participant, &type, name.c_str(), nullptr, nullptr), name.c_str());
}

/// Calls f(sample) for all that has come.
template <class T, class F>
void take_all(std::int32_t reader, F&& f) {
  void* samples[8] = {};
  dds_sample_info_t infos[8];
  const int count = dds_take(reader, samples, infos, 8, 8);
  for (int i = 0; i < count; ++i)
    if (infos[i].valid_data) f(*static_cast<const T*>(samples[i]));
  if (count > 0) dds_return_loan(reader, samples, count);
}

}  // namespace

Turtlebot::Turtlebot(const Settings& settings, const WireSettings& wire) : body_{settings}, wire_{wire} {
  open(wire);
  thread_ = std::jthread{[this](const std::stop_token& stop) { run(stop); }};
}

Turtlebot::~Turtlebot() {
  thread_ = {};
  dds_delete(participant_);
  if (own_domain_ > 0) dds_delete(own_domain_);
}

void Turtlebot::open(const WireSettings& wire) {
  own_domain_ = dds_create_domain(static_cast<dds_domainid_t>(wire.domain), kConfig);  // another bus may have made it
  participant_ =
      good(dds_create_participant(static_cast<dds_domainid_t>(wire.domain), nullptr, nullptr), "participant");
  const auto write = [&](const std::string& name, const dds_topic_descriptor_t& type, bool is_reliable) {
    const auto qos = quality(is_reliable, false, 5);
    writers_[name] = good(
        dds_create_writer(participant_, topic_of(participant_, type, "rt/" + name), qos.get(), nullptr), name.c_str());
  };
  write(wire.scan_topic, sensor_msgs_msg_dds__LaserScan__desc, true);
  // The Create 3 offers its sensors by best effort.
  write("odom", nav_msgs_msg_dds__Odometry__desc, false);
  write("hazard_detection", irobot_create_msgs_msg_dds__HazardDetectionVector__desc, false);
  write("kidnap_status", irobot_create_msgs_msg_dds__KidnapStatus__desc, false);
  write("battery_state", sensor_msgs_msg_dds__BatteryState__desc, false);
  write("dock_status", irobot_create_msgs_msg_dds__DockStatus__desc, false);
  const auto& type =
      wire.stamped_commands ? geometry_msgs_msg_dds__TwistStamped__desc : geometry_msgs_msg_dds__Twist__desc;
  const auto qos = quality(true, false, 1);
  commands_ =
      good(dds_create_reader(participant_, topic_of(participant_, type, "rt/cmd_vel"), qos.get(), nullptr), "cmd_vel");
  if (!wire.offers_actions) return;
  open_action(dock_);
  open_action(undock_);
}

void Turtlebot::open_action(Action& action) {
  const bool docks = action.name == "dock";
  const auto& request = docks ? irobot_create_msgs_action_dds__Dock_SendGoal_Request__desc
                              : irobot_create_msgs_action_dds__Undock_SendGoal_Request__desc;
  const auto& reply = docks ? irobot_create_msgs_action_dds__Dock_SendGoal_Response__desc
                            : irobot_create_msgs_action_dds__Undock_SendGoal_Response__desc;
  const std::string base = action.name + "/_action/";
  const auto service = quality(true, false, 10);
  const auto latched = quality(true, true, 1);
  action.requests =
      good(dds_create_reader(participant_, topic_of(participant_, request, "rq/" + base + "send_goalRequest"),
                             service.get(), nullptr),
           "requests");
  action.replies = good(dds_create_writer(participant_, topic_of(participant_, reply, "rr/" + base + "send_goalReply"),
                                          service.get(), nullptr),
                        "replies");
  action.status = good(
      dds_create_writer(participant_,
                        topic_of(participant_, action_msgs_msg_dds__GoalStatusArray__desc, "rt/" + base + "status"),
                        latched.get(), nullptr),
      "status");
}

void Turtlebot::run(const std::stop_token& stop) {
  using Clock = std::chrono::steady_clock;
  auto next = Clock::now();
  for (std::int64_t tick = 0; !stop.stop_requested(); ++tick) {
    {
      const std::scoped_lock lock{mutex_};
      hear_commands();
      if (wire_.offers_actions) {
        hear_goals(dock_);
        hear_goals(undock_);
      }
      body_.step(1.0 / kTicksPerSecond);
      end_goals();
      say(tick);
    }
    next += std::chrono::nanoseconds{1000000000 / kTicksPerSecond};
    if (next < Clock::now()) next = Clock::now();  // a busy computer: it is late, and catches nothing up
    std::this_thread::sleep_until(next);
  }
}

void Turtlebot::hear_commands() {
  const auto obey = [this](const geometry_msgs_msg_dds__Twist_& twist) {
    body_.command(twist.linear.x, twist.angular.z);
  };
  if (wire_.stamped_commands)
    take_all<geometry_msgs_msg_dds__TwistStamped_>(commands_, [&](const auto& stamped) { obey(stamped.twist); });
  else
    take_all<geometry_msgs_msg_dds__Twist_>(commands_, obey);
}

void Turtlebot::hear_goals(Action& action) {
  // Both types of request look the same.
  take_all<irobot_create_msgs_action_dds__Dock_SendGoal_Request_>(action.requests, [&](const auto& request) {
    GoalId id;
    if (wire_.rmw == Rmw::cyclonedds) {
      std::memcpy(id.data(), request.goal_id, id.size());
    } else {  // it knows of no header: the first bytes are the id
      std::memcpy(id.data(), &request.client, 8);
      std::memcpy(id.data() + 8, &request.number, 8);
    }
    const bool is_taken = action.name == "dock" ? body_.dock() : body_.undock();
    (is_taken ? goals_taken_ : goals_refused_) += 1;
    if (is_taken) {
      action.goals.emplace_back(id, 2);  // executing
      say_goals(action);
    }
    if (wire_.rmw == Rmw::cyclonedds) {
      irobot_create_msgs_action_dds__Dock_SendGoal_Response_ reply{request.client, request.number, is_taken,
                                                                   header("").stamp};
      dds_write(action.replies, &reply);
    }
  });
}

void Turtlebot::end_goals() {
  if (body_.behaviour() != Body::Behaviour::none) return;
  for (Action* action : {&dock_, &undock_}) {
    if (action->goals.empty() || action->goals.back().second != 2) continue;
    action->goals.back().second = body_.is_docked() == (action->name == "dock") ? 4 : 6;  // succeeded, aborted
    say_dock();
    say_goals(*action);
  }
}

void Turtlebot::say_goals(Action& action) {
  std::vector<action_msgs_msg_dds__GoalStatus_> list;
  for (const auto& [id, status] : action.goals) {
    action_msgs_msg_dds__GoalStatus_ goal{};
    std::memcpy(goal.goal_info.goal_id.uuid, id.data(), id.size());
    goal.status = status;
    list.push_back(goal);
  }
  action_msgs_msg_dds__GoalStatusArray_ all{};
  const auto count = static_cast<std::uint32_t>(list.size());
  all.status_list = {count, count, list.data(), false};
  dds_write(action.status, &all);
}

void Turtlebot::say(std::int64_t tick) {
  if (tick % 8 == 0) say_scan();      // 7.5 Hz
  if (tick % 3 == 0) say_odometry();  // 20 Hz
  if (tick % 4 == 1 && says_hazards_) say_hazards();
  if (tick % 60 == 2) say_battery();
  if (tick % 30 == 3) say_dock();
}

void Turtlebot::say_scan() {
  std::vector<float> ranges = body_.scan(kBeams, -0.04, 0.5 * std::numbers::pi);
  sensor_msgs_msg_dds__LaserScan_ scan{};
  scan.header = header("rplidar_link");
  scan.angle_min = -std::numbers::pi_v<float>;
  scan.angle_increment = 2.0F * std::numbers::pi_v<float> / kBeams;
  scan.angle_max = scan.angle_min + (kBeams - 1) * scan.angle_increment;
  scan.scan_time = 8.0F / kTicksPerSecond;
  scan.range_min = 0.15F;
  scan.range_max = 12.0F;
  scan.ranges = {kBeams, kBeams, ranges.data(), false};
  dds_write(writers_[wire_.scan_topic], &scan);
}

void Turtlebot::say_odometry() {
  nav_msgs_msg_dds__Odometry_ odometry{};
  const Pose2 pose = body_.odom_from_robot();
  odometry.header = header("odom");
  odometry.child_frame_id = const_cast<char*>("base_link");
  odometry.pose.pose.position = {pose.x, pose.y, 0.0};
  odometry.pose.pose.orientation = {0.0, 0.0, std::sin(0.5 * pose.theta.radians()),
                                    std::cos(0.5 * pose.theta.radians())};
  odometry.twist.twist.linear.x = body_.linear();
  odometry.twist.twist.angular.z = body_.angular();
  dds_write(writers_["odom"], &odometry);
}

void Turtlebot::say_hazards() {
  const std::vector<Body::Hazard> found = body_.hazards();
  std::vector<irobot_create_msgs_msg_dds__HazardDetection_> list;
  for (const Body::Hazard& hazard : found) list.push_back({header(hazard.frame.c_str()), hazard.type});
  irobot_create_msgs_msg_dds__HazardDetectionVector_ hazards{};
  hazards.header = header("base_link");
  const auto count = static_cast<std::uint32_t>(list.size());
  hazards.detections = {count, count, list.data(), false};
  dds_write(writers_["hazard_detection"], &hazards);
  irobot_create_msgs_msg_dds__KidnapStatus_ kidnapped{header("base_link"), body_.is_lifted};
  dds_write(writers_["kidnap_status"], &kidnapped);
}

void Turtlebot::say_battery() {
  sensor_msgs_msg_dds__BatteryState_ battery{};
  battery.header = header("");
  battery.voltage = 15.0F;
  battery.percentage = static_cast<float>(body_.battery);
  battery.power_supply_status = body_.is_docked() ? 1 : 2;
  battery.present = true;
  battery.location = battery.serial_number = const_cast<char*>("");
  dds_write(writers_["battery_state"], &battery);
}

void Turtlebot::say_dock() {
  irobot_create_msgs_msg_dds__DockStatus_ dock{header("base_link"), body_.sees_dock(), body_.is_docked()};
  dds_write(writers_["dock_status"], &dock);
}

}  // namespace docent::turtlebot
