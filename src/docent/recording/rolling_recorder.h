#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/recording/recorder.h"

namespace docent::recording {

struct RollingRecorderParams {
  double max_file_megabytes = 500.0;  ///< > 0; then a new file begins
  double max_hours = 2.0;             ///< > 0; likewise
  int keep_files = 12;                ///< >= 1; older recordings are removed

  template <class V>
  void visit(V& v) {
    v("max_file_megabytes", max_file_megabytes);
    v("max_hours", max_hours);
    v("keep_files", keep_files);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Records for days: a folder of files recording-YYYYMMDD-HHMMSS.mcap (UTC), the oldest removed. Every file can be
/// understood alone: it begins with the present value of each latched topic.
class RollingRecorder {
 public:
  RollingRecorder(std::filesystem::path folder, RollingRecorderParams params);
  RollingRecorder(const RollingRecorder&) = delete;
  RollingRecorder& operator=(const RollingRecorder&) = delete;
  ~RollingRecorder();

  /// Error: the disk is full or gone. Later messages try again.
  [[nodiscard]] Result<void> write(const transport::TopicInfo& topic, Time time,
                                   const std::shared_ptr<const void>& message);
  [[nodiscard]] Result<void> flush();

  /// The file that is being written; empty before the first message.
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  /// What killed recorders left unfinished in the folder. @pre no recorder is at work there
  [[nodiscard]] static std::vector<std::filesystem::path> unfinished(const std::filesystem::path& folder);

 private:
  struct Latched {
    transport::TopicInfo topic;
    std::shared_ptr<const void> message;
  };
  [[nodiscard]] Result<void> begin(Time time);
  void remove_old() const;

  std::filesystem::path folder_;
  RollingRecorderParams params_;
  std::filesystem::path file_;
  std::optional<Recorder> recorder_;
  Time begun_{};
  std::map<std::string, Latched, std::less<>> latched_;
};

}  // namespace docent::recording
