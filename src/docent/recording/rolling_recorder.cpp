#include "docent/recording/rolling_recorder.h"

#include <algorithm>
#include <array>
#include <ctime>

namespace docent::recording {
namespace {

constexpr const char* kPrefix = "recording-";

std::string utc_name(Time time) {
  const std::time_t whole = static_cast<std::time_t>(time.nanoseconds / 1000000000);
  std::tm parts{};
  gmtime_r(&whole, &parts);
  std::array<char, 32> text{};
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y%m%d-%H%M%S", &parts);
  return kPrefix + std::string{text.data(), size};
}

/// Names rise with time.
std::vector<std::filesystem::path> recordings(const std::filesystem::path& folder, const std::string& extension) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator{folder, error}) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kPrefix) && name.ends_with(extension)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Result<void> RollingRecorderParams::validate() const {
  if (!(max_file_megabytes > 0.0)) return fail("max_file_megabytes must be > 0");
  if (!(max_hours > 0.0)) return fail("max_hours must be > 0");
  if (keep_files < 1) return fail("keep_files must be >= 1");
  return {};
}

RollingRecorder::RollingRecorder(std::filesystem::path folder, RollingRecorderParams params)
    : folder_{std::move(folder)}, params_{params} {}

RollingRecorder::~RollingRecorder() {
  if (recorder_) (void)recorder_->close();
}

Result<void> RollingRecorder::begin(Time time) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) return fail(folder_.string() + ": cannot be made: " + error.message());
  const std::string name = utc_name(time);
  std::filesystem::path file = folder_ / (name + ".mcap");
  for (int i = 2; std::filesystem::exists(file, error) || std::filesystem::exists(unfinished_path(file), error); ++i)
    file = folder_ / (name + "-" + std::to_string(i) + ".mcap");
  auto recorder = Recorder::create(file);
  if (!recorder) return tl::unexpected<Error>(recorder.error());
  recorder_.emplace(std::move(*recorder));
  file_ = std::move(file);
  begun_ = time;
  remove_old();
  for (const auto& [name_of_topic, latched] : latched_)
    if (auto written = recorder_->write(latched.topic, time, latched.message); !written) return written;
  return {};
}

Result<void> RollingRecorder::write(const transport::TopicInfo& topic, Time time,
                                    const std::shared_ptr<const void>& message) {
  const bool is_full =
      recorder_ && (static_cast<double>(recorder_->bytes_written()) > params_.max_file_megabytes * 1e6 ||
                    to_seconds(time - begun_) > params_.max_hours * 3600.0);
  if (is_full) {
    auto closed = recorder_->close();
    recorder_.reset();
    if (!closed) return closed;
  }
  if (!recorder_) {
    if (auto begun = begin(time); !begun) return begun;
  }
  if (topic.qos == Qos::state) latched_[topic.name] = {topic, message};
  return recorder_->write(topic, time, message);
}

Result<void> RollingRecorder::flush() { return recorder_ ? recorder_->flush() : Result<void>{}; }

void RollingRecorder::remove_old() const {
  const auto files = recordings(folder_, ".mcap");
  // The new file is not among them: it still has its unfinished name.
  const auto kept = static_cast<std::size_t>(params_.keep_files - 1);
  for (std::size_t i = 0; i + kept < files.size(); ++i) {
    std::error_code error;
    std::filesystem::remove(files[i], error);
  }
}

std::vector<std::filesystem::path> RollingRecorder::unfinished(const std::filesystem::path& folder) {
  return recordings(folder, ".mcap.part");
}

}  // namespace docent::recording
