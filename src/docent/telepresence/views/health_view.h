#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

#include "docent/base/time.h"
#include "docent/messages/operation_messages.h"
#include "docent/telepresence/live_encoding.h"
#include "docent/telepresence/server/web_server.h"

namespace docent::telepresence {

/// How the modules of the robot are, as each said last.
class HealthView {
 public:
  void see(const docent_msgs::Health& health, Time now);
  /// From now on that is the document. @param viewers  how many watch
  std::string show(std::size_t viewers, Time now);
  /// Any thread: as it was shown last.
  [[nodiscard]] std::string document() const;

 private:
  std::map<std::string, HealthEntry> modules_;
  mutable std::mutex mutex_;  ///< of the text
  std::string text_ = R"({"type":"health","modules":[]})";
};

/// What the server counts, as Prometheus reads it.
[[nodiscard]] std::string metrics_text(const WebServerFigures& figures);

}  // namespace docent::telepresence
