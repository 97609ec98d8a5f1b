#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// How an office's orders went and what the eyes made of things, as CSV: time [s] since the first truth, what (state: a
/// change of the order under way; thing: a thing got another name, or was forgotten), name (the phase, or the object;
/// empty: none), x, y [m] (of the robot in truth, of what it points at, or of the thing on the map), about (the order's
/// kind and room, or the thing's number), looks, found, picked_up, left.
class OfficeLog {
 public:
  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  [[nodiscard]] const std::string& rows() const { return rows_; }
  [[nodiscard]] Result<void> save(const std::string& path) const;

 private:
  void add_row(Time time, const std::string& rest);

  Time first_{};
  bool has_truth_ = false;
  Point2 robot_;
  std::map<std::uint32_t, std::string> named_;  ///< [things]
  std::string rows_;
};

}  // namespace docent::evaluation
