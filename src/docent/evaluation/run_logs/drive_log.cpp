#include "docent/evaluation/run_logs/drive_log.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "docent/base/files.h"
#include "docent/evaluation/deployment_evaluator.h"
#include "docent/geometry/angle.h"

namespace docent::evaluation {

void DriveLog::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  if (name == topics::kTrueState.name) {
    add_row(*static_cast<const docent_msgs::TrueState*>(message.get()), time);
  } else if (name == topics::kTrueContact.name) {
    const bool counts = is_contact(*static_cast<const docent_msgs::TrueContact*>(message.get()));
    ++(counts ? contacts_ : bumps_);
  } else if (name == topics::kTrueOffer.name) {
    const auto& offer = *static_cast<const docent_msgs::TrueOffer*>(message.get());
    if (offer.kind == "left_out") leaves_out_ = offer.subject == "begins";
  } else if (name == topics::kAvoidState.name) {
    avoid_ = *static_cast<const docent_msgs::AvoidState*>(message.get());
    reason_ = avoid_.reason;
    std::replace(reason_.begin(), reason_.end(), ',', ';');
  }
}

void DriveLog::add_row(const docent_msgs::TrueState& truth, Time time) {
  if (!has_truth_) first_ = time;
  has_truth_ = true;
  if (was_inside_ && !truth.inside_area) ++violations_;
  was_inside_ = truth.inside_area;
  std::array<char, 256> line{};
  const int size =
      std::snprintf(line.data(), line.size(), "%.2f,%.3f,%.3f,%.2f,%.3f,%.3f,%.3f,%d,%d,%d,%.3f,%.3f,%d,%s,%.3f,",
                    to_seconds(time - first_), truth.x, truth.y, Angle::radians(truth.theta).degrees(), truth.linear,
                    truth.angular, truth.distance_m, contacts_, bumps_, violations_, truth.nearest_person_m,
                    truth.nearest_solid_m, leaves_out_ ? 1 : 0, avoid_.state.c_str(), avoid_.speed_cap);
  rows_.append(line.data(), static_cast<std::size_t>(std::max(0, size)));
  rows_ += reason_ + "\n";
}

Result<void> DriveLog::save(const std::string& path) const {
  return write_file_atomically(path,
                               "time,x,y,heading,speed,turn_rate,distance,contacts,bumps,violations,nearest_person,"
                               "nearest_solid,left_out,state,speed_cap,reason\n" +
                                   rows_);
}

}  // namespace docent::evaluation
