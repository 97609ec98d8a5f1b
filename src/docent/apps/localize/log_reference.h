#pragma once

#include <cstdint>
#include <string>

#include "docent/evaluation/reference/odometry_noise.h"
#include "docent/evaluation/reference/reference_poses.h"
#include "docent/recording/laser_log.h"

namespace CLI {
class App;
}

namespace docent::apps::localize_command {

/// What `docent map` and `docent localize` are told about a log beside its name.
struct LogChoice {
  std::string log;
  std::string reference;           ///< "" none, "logged" the poses in the log itself, else a file of poses
  std::string scans = "all";       ///< all, odd, even: the first scan of the log is odd
  recording::WantedTopics topics;  ///< of a recording of ROS
  std::string times = "stamps";    ///< likewise: stamps, index
};
void add_log_options(CLI::App& command, LogChoice& choice);

/// A log, and where its scans were truly taken if anybody says so.
struct ReferencedLog {
  recording::LaserLog log;
  evaluation::ScanReference reference;  ///< of every scan of the log; all nullopt without a reference
};
/// CommandFailed on bad input.
[[nodiscard]] ReferencedLog load_referenced_log(const LogChoice& choice, const evaluation::ReferenceGaps& gaps = {});

/// Keeps the scans that have a reference and gives them odometry of our making in place of the log's. CommandFailed
/// when no scan has one.
void replace_odometry(ReferencedLog& referenced, const evaluation::OdometryNoiseParams& noise, std::uint64_t seed);

/// Leaves out the scans before the first and after the last one that have a reference. CommandFailed when none has.
void begin_where_known(ReferencedLog& referenced);

}  // namespace docent::apps::localize_command
