#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// What the modules said of themselves, as CSV with a row for every change: time [s] since the first truth, module,
/// state, reason (commas in it become semicolons).
class HealthLog {
 public:
  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  [[nodiscard]] const std::string& rows() const { return rows_; }
  [[nodiscard]] Result<void> save(const std::string& path) const;

 private:
  Time first_{};
  bool has_truth_ = false;
  std::map<std::string, std::string> last_;  ///< "state,reason" of each module
  std::string rows_;
};

}  // namespace docent::evaluation
