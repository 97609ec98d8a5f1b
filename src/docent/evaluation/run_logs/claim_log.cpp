#include "docent/evaluation/run_logs/claim_log.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "docent/base/files.h"
#include "docent/evaluation/deployment_evaluator.h"
#include "docent/messages/conversions.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::evaluation {
namespace {

constexpr const char* kClaimColumns =
    "time,true_x,true_y,true_heading,has_pose,x,y,heading,mass,localized,p_lost,entropy,hypotheses,active_cells,"
    "beams_used,beams_filtered,blocked,distance,speed,kidnaps,"
    "agreement,contradiction,surprise,hidden,confirmation,blind_way,unmapped,spread,share,explained,contacts,"
    "violations\n";
constexpr std::size_t kMostClaimsWaiting = 1000;

}  // namespace

void ClaimLog::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  if (name == topics::kBelief.name) {
    waiting_.push_back(std::static_pointer_cast<const docent_msgs::Belief>(message));
    if (waiting_.size() > kMostClaimsWaiting) waiting_.pop_front();
  } else if (name == topics::kTrueOffer.name) {
    if (static_cast<const docent_msgs::TrueOffer*>(message.get())->kind == "kidnap") ++kidnaps_;
  } else if (name == topics::kEvent.name) {
    const std::string& kind = static_cast<const docent_msgs::Event*>(message.get())->kind;
    if (parse<EventKind>(kind) == EventKind::explained) ++explained_;
  } else if (name == topics::kTrueContact.name) {
    contacts_ += is_contact(*static_cast<const docent_msgs::TrueContact*>(message.get())) ? 1 : 0;
  } else if (name == topics::kTrueState.name) {
    if (truth_.empty()) first_ = last_stamp_ = time;
    const bool is_inside = static_cast<const docent_msgs::TrueState*>(message.get())->inside_area;
    if (!is_inside && (truth_.empty() || truth_.latest().inside_area)) ++violations_;
    truth_.add(std::static_pointer_cast<const docent_msgs::TrueState>(message));
    while (!waiting_.empty() && from_message(waiting_.front()->header.stamp) <= truth_.latest_time()) {
      const auto belief = waiting_.front();
      waiting_.pop_front();
      const Time stamp = from_message(belief->header.stamp);
      const auto pose = truth_.pose_at(stamp);
      if (!pose || stamp <= last_stamp_) continue;
      last_stamp_ = stamp;
      judge(*belief, *pose);
    }
  }
}

void ClaimLog::judge(const docent_msgs::Belief& belief, const Pose2& truth) {
  ++claims_;
  const auto& state = truth_.latest();
  const bool has_pose = !belief.hypotheses.empty();
  const docent_msgs::Hypothesis best = has_pose ? belief.hypotheses.front() : docent_msgs::Hypothesis{};
  char line[600];
  const int size = std::snprintf(
      line, sizeof line,
      "%.2f,%.4f,%.4f,%.2f,%d,%.4f,%.4f,%.2f,%.6f,%d,%.6f,%.4f,%zu,%u,%u,%u,%.4f,%.3f,%.3f,%d,%.4f,%.4f,%"
      ".4f,%.4f,%.4f,%.3f,%.4f,%.4f,%.6f,%d,%d,%d\n",
      to_seconds(last_stamp_ - first_), truth.x, truth.y, truth.theta.degrees(), has_pose ? 1 : 0, best.x, best.y,
      Angle::radians(best.theta).degrees(), best.mass, belief.localized ? 1 : 0, belief.p_lost, belief.entropy,
      belief.hypotheses.size(), belief.active_cells, belief.beams_used, belief.beams_filtered, state.blocked_beams,
      state.distance_m, state.linear, kidnaps_, belief.agreement, belief.contradiction, belief.surprise, belief.hidden,
      belief.confirmation, belief.blind_way, belief.unmapped,
      std::sqrt(std::max(0.0, best.covariance[0] + best.covariance[4])), belief.share, explained_, contacts_,
      violations_);
  lines_.append(line, static_cast<std::size_t>(size));
}

Result<void> ClaimLog::save(const std::string& path) const {
  return write_file_atomically(path, kClaimColumns + lines_);
}

}  // namespace docent::evaluation
