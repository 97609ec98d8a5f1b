#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/transport/bus.h"
#include "scenery.h"

namespace docent::stage {

/// Plays the robot: wakes up lost, finds itself, fulfils requests one after the other. Invented from end to end; only
/// the messages are the real ones.
class Actor {
 public:
  struct Options {
    double lost_s = 12.0;  ///< how long it does not know where it is
    double speed = 0.7;    ///< [m/s]
    double talk = 1.0;     ///< time to say a text, as a factor
    double ask_s = 5.0;    ///< how long a question is open
    std::string music;     ///< file of what it plays while it drives
    double horn_s = 0.0;   ///< it sounds its horn every so many seconds; 0: never
    bool is_busy = false;  ///< other visitors have wishes too
  };
  Actor(transport::Bus& bus, const museum::Museum& museum, Scenery& scenery, Rng rng, Options options);

 private:
  enum class Phase { lost, idle, driving, explaining, asking, going_home };
  void step();
  void move(double dt);
  void think();
  void set_phase(Phase phase);
  void receive(const docent_msgs::Request& request);
  void wish(const std::string& kind, const std::string& target, const std::string& visitor);
  void next_target();
  void speak(const std::string& text, const std::string& name);
  void close_active(const std::string& state);
  void publish_board();
  void ask();
  void publish_mission();
  void publish_path();
  void publish_belief();
  void publish_expression(bool is_blocked);
  void publish_health();

  transport::Bus& bus_;
  const museum::Museum& museum_;
  Scenery& scenery_;
  Rng rng_;
  Options options_;
  Pose2 map_from_base_;
  Pose2 map_from_odom_;
  std::vector<Pose2> guesses_;
  std::vector<Point2> way_;
  double speed_ = 0.0;
  double turn_ = 0.0;
  double valence_ = 0.0;
  Phase phase_ = Phase::lost;
  Time phase_since_{};
  double speech_s_ = 0.0;
  std::string exhibit_;
  std::string tour_;  ///< under way
  std::string language_ = "en";
  bool took_long_ = false;
  std::vector<std::string> agenda_;
  docent_msgs::Prompt prompt_;
  docent_msgs::RequestBoard board_;
  std::uint32_t explained_ = 0, tours_ = 0, served_ = 0;
  int count_ = 0;

  transport::Publisher<nav_msgs::Odometry> odometry_;
  transport::Publisher<sensor_msgs::LaserScan> front_, rear_;
  transport::Publisher<sensor_msgs::BatteryState> battery_;
  transport::Publisher<docent_msgs::Belief> belief_;
  transport::Publisher<docent_msgs::People> people_;
  transport::Publisher<docent_msgs::AvoidState> avoid_;
  transport::Publisher<nav_msgs::Path> path_;
  transport::Publisher<docent_msgs::GoalState> goal_;
  transport::Publisher<docent_msgs::MissionState> mission_;
  transport::Publisher<docent_msgs::RequestBoard> board_publisher_;
  transport::Publisher<docent_msgs::SpeechState> speech_;
  transport::Publisher<docent_msgs::Health> health_;
  transport::Publisher<docent_msgs::Horn> horn_;
  transport::Publisher<docent_msgs::SoundState> sound_;
  transport::Publisher<docent_msgs::Expression> expression_;
};

}  // namespace docent::stage
