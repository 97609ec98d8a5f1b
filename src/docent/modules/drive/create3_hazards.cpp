#include "docent/modules/drive/create3_hazards.h"

#include "docent/messages/conversions.h"
#include "docent/transport/create3_support.h"

namespace docent::modules {
namespace {

constexpr const char* kSource = "create3";  // of its lines
constexpr double kLifetime = 1.0;           // [s] of a line: the reader itself remembers
constexpr double kPeriod = 0.1;             // [s] while nothing changes; a touch is told at once
constexpr double kSilent = 1.0;             // [s] without a word of hazards

}  // namespace

Create3Hazards::Create3Hazards(transport::Bus& bus, double radius)
    : bus_{bus},
      reader_{radius},
      tactile_{bus_.publisher(topics::kTactile)},
      lines_{bus_.publisher(topics::kObstacleLines)} {
  bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const nav_msgs::Odometry& odometry) {
    odom_from_base_ = from_message(odometry.pose.pose);
    speed_ = odometry.twist.twist.linear.x;
  });
  bus_.subscribe<irobot_create_msgs::KidnapStatus>(topics::kKidnapStatus,
                                                   [this](const auto& status) { is_kidnapped_ = status.is_kidnapped; });
  bus_.subscribe<irobot_create_msgs::HazardDetectionVector>(topics::kHazards,
                                                            [this](const auto& hazards) { read(hazards); });
}

std::string Create3Hazards::complaint() const {
  if (!heard_) return "no hazard_detection of the base yet";
  if (bus_.now() - *heard_ > seconds(kSilent)) return "no fresh hazard_detection from the base";
  return is_lifted_ ? "somebody has lifted the robot, or a wheel hangs in the air" : "";
}

void Create3Hazards::read(const irobot_create_msgs::HazardDetectionVector& hazards) {
  const Time now = bus_.now();
  heard_ = now;
  const HazardReading reading = reader_.read(hazards, is_kidnapped_, odom_from_base_, speed_, now);
  is_lifted_ = reading.is_lifted;
  const bool is_news = reading.segments != told_ || reading.edges.size() != edges_told_;
  if (!is_news && told_at_ && now - *told_at_ < seconds(kPeriod)) return;
  told_at_ = now;
  told_ = reading.segments;
  edges_told_ = reading.edges.size();
  tactile_.publish({{to_message(now), "base_link"}, reading.segments, ++count_});
  docent_msgs::ObstacleLines lines{{to_message(now), "base_link"}, kSource, kLifetime, {}};
  for (const Segment& edge : reading.edges)
    lines.lines.push_back({static_cast<float>(edge.a.x), static_cast<float>(edge.a.y), static_cast<float>(edge.b.x),
                           static_cast<float>(edge.b.y)});
  lines_.publish(std::move(lines));
}

}  // namespace docent::modules
