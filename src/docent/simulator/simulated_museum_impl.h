#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "docent/simulator/body/battery.h"
#include "docent/simulator/body/body.h"
#include "docent/simulator/body/contact_log.h"
#include "docent/simulator/body/obstacles.h"
#include "docent/simulator/crowd/crowd.h"
#include "docent/simulator/instruments.h"
#include "docent/simulator/scenario/office_people.h"
#include "docent/simulator/simulated_museum.h"
#include "docent/simulator/steersman.h"
#include "docent/simulator/visitors.h"

namespace docent::simulator {

/// All that goes on in a simulated museum. Only simulated_museum.cpp and scenario_play.cpp know it.
class SimulatedMuseum::Impl {
 public:
  Impl(transport::Bus& robot_bus, transport::Bus& truth_bus, SimulationOptions options);

  void command(const geometry_msgs::Twist& twist);
  void hear_horn() { crowd_.hear_horn(run_seconds()); }
  void hear_speech(const docent_msgs::SpeechState& speech);
  void see_face(const docent_msgs::Expression& expression) {
    crowd_.see_face(expression.valence);
    if (cameras_) cameras_->see_face(expression);
  }
  void turn_camera(const docent_msgs::CameraView& view) {
    if (cameras_) cameras_->turn_mount(view);
  }
  void see_board(const docent_msgs::RequestBoard& board) { visitors_.see_board(board); }
  void see_mission(const docent_msgs::MissionState& mission);
  void see_office(const docent_msgs::OfficeState& state) { office_.see(state, time_); }

  /// Steps when the next step is due, for as long as it lives. A beat of its own would, in wall time, have every sensor
  /// read up to a step late.
  static void start(const std::shared_ptr<Impl>& impl);  ///< now: to make a world took some time
  static void keep_stepping(const std::weak_ptr<Impl>& weak);
  /// Catches up with the bus's clock.
  void tick();

  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const Crowd& crowd() const { return crowd_; }

 private:
  static constexpr int kTactileSegments = 24;
  [[nodiscard]] double run_seconds() const { return to_seconds(time_ - start_); }
  [[nodiscard]] bool every(std::uint64_t steps) const { return steps_ % steps == 0; }

  template <class T>
  void tell(const transport::Publisher<T>& publisher, T message) {
    // The truth has a bus of its own, perhaps a thread of its own.
    truth_bus_.post([publisher, message = std::move(message)] { publisher.publish(message); });
  }

  Pose2 first_pose();
  Crowd make_crowd();
  WishParams wish_params() const;
  [[nodiscard]] RobotView view() const;

  void step();
  /// The robot stands at its charger, or does not.
  void charge();
  void steer();
  /// Contacts of the disc with solids and people; pushes both apart.
  void touch();
  void press(Point2 towards);
  void watch_people();
  void publish();
  void publish_truth();
  /// [m] between the robot's outline, its centre there, and somebody.
  [[nodiscard]] double gap_to(std::size_t person, Point2 centre) const;
  void offer(std::string kind, std::string subject);

  // scenario_play.cpp: what a scenario does.
  void play_scenario();
  void show_world();  ///< to everybody, after a change
  void play(const Kidnap& event);
  /// The robot's outline at most so far [m] from a hazard; nullopt: no room.
  [[nodiscard]] std::optional<Pose2> place_near_hazard(double within);
  [[nodiscard]] double hazard_distance(Point2 point) const;
  void play(const SensorFault& event);
  void play(const Stool& event);
  void play(const ClosedPassage& event);
  void put_up(const std::string& kind, SolidKind solid, Polygon outline, double bottom, double top, double duration);
  void play(const Visitors& event);
  [[nodiscard]] double end_of(double duration) const { return duration > 0.0 ? run_seconds() + duration : 1e9; }
  void play(const Pushers& event);
  void play(const Runners& event);
  void play(const Escort& event);
  void play(const Steering& event);
  void play(const LaserReach& event);
  void play(const Wish& event) { visitors_.ask(time_, event); }
  void play(const Answers& event);
  void play(const BatteryChange& event);
  void play(const ChargerFault& event);
  void play(const EyeFault& event);
  void play(const OfficeEvent& event);
  void help_in_office();
  void play(const OdometryJump& event);
  void play(const ScannerLie& event);
  void play(const Transport& event);
  void play(const PoseError& event) { leave_to_application(event, "pose_error", ""); }
  void play(const SecondMode& event) { leave_to_application(event, "second_mode", ""); }
  void play(const Kill& event) { leave_to_application(event, "kill", event.module); }
  template <class Event>
  void leave_to_application(const Event& event, const char* kind, const std::string& subject) {
    if (options_.application) options_.application(event);
    offer(kind, subject);
  }
  [[nodiscard]] bool is_now(const Moment& moment) const;

  struct Temporary {
    Solid solid;
    double until = 0.0;  ///< [s] run time; 0: for good
    bool stands = false;
    bool is_over = false;
  };

  transport::Bus& bus_;
  transport::Bus& truth_bus_;
  SimulationOptions options_;
  World world_;
  Rng rng_;
  Rng place_rng_;
  Time start_;
  Time time_;
  std::optional<WalkableFloor> floor_;  ///< until the crowd takes it
  Obstacles obstacles_;
  Body body_;
  Crowd crowd_;
  Instruments instruments_;
  std::optional<Cameras> cameras_;
  WishingVisitors visitors_;
  OfficePeople office_;
  Battery battery_;
  std::optional<ChargerFault::Kind> charger_fault_;
  double charger_fault_until_ = 0.0;  ///< [s] run time
  bool has_mute_battery_ = false;
  ContactLog log_;
  std::uint64_t steps_ = 0;
  double distance_ = 0.0;
  bool has_fallen_ = false;
  bool leaves_out_ = false;  ///< a lying scanner, what is near
  std::optional<Steersman> steersman_;
  double steered_until_ = 0.0;  ///< [s] run time; 0: to the end
  std::size_t next_event_ = 0;
  std::size_t event_ = 0;                    ///< the one that is played
  std::vector<std::size_t> waiting_events_;  ///< indices of those whose time has come, but not their moment
  std::optional<MissionPhase> phase_;        ///< of the mission; nullopt: it has said nothing yet
  Time phase_began_{};
  std::vector<Temporary> temporary_;
  std::vector<Disc> people_;         ///< the room that others leave each
  std::vector<Posture> postures_;    ///< [people] as they stand
  std::vector<std::size_t> beside_;  ///< indices of the people who are near the robot
  std::vector<Touch> touches_;
  std::vector<ContactLog::PersonSample> samples_;
  std::vector<std::uint8_t> tactile_;
  std::vector<std::uint8_t> tactile_now_ = std::vector<std::uint8_t>(kTactileSegments, 0);
  transport::Publisher<docent_msgs::Request> requests_;
  transport::Publisher<docent_msgs::OfficeOrder> office_orders_;
  transport::Publisher<docent_msgs::Button> buttons_;
  transport::Publisher<docent_msgs::Choice> choices_;
  transport::Publisher<docent_msgs::RunInfo> run_infos_;
  transport::Publisher<docent_msgs::TrueState> states_;
  transport::Publisher<docent_msgs::TrueContact> contacts_;
  transport::Publisher<docent_msgs::TrueOffer> offers_;
};

}  // namespace docent::simulator
