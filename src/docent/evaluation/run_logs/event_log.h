#pragma once

#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// What happened in a run, as CSV with a row for every event: time [s] since the first truth; source (event, reaction,
/// way, say, scenario or contact; way: local or global when a detour of so many more metres begins, none when it ends);
/// kind, subject, detail (commas become semicolons) and value as the message has them; where the robot truly was, x and
/// y [m]; and where its head looked, at and bearing [deg].
class EventLog {
 public:
  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  [[nodiscard]] const std::string& rows() const { return rows_; }
  [[nodiscard]] Result<void> save(const std::string& path) const;

 private:
  void write(Time time, const char* source, std::string kind, std::string subject, std::string detail, double value);

  Time first_{};
  bool has_truth_ = false;
  double x_ = 0.0, y_ = 0.0;
  std::string gaze_at_ = "none";
  std::string detour_ = "none";
  double gaze_deg_ = 0.0;
  std::string rows_;
};

}  // namespace docent::evaluation
