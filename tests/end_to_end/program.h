#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace docent {

/// A folder that is removed with this object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::string write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

/// $DOCENT_BINARY, else the one that was built.
[[nodiscard]] std::filesystem::path docent_program();

/// A started `docent`, or `docent-lab` where the first argument is one of its commands, with all that it prints and a
/// cache of its own. Ended (with its children) at the latest with this object.
class Program {
 public:
  explicit Program(const std::vector<std::string>& arguments);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  void signal(int number) const;
  /// Its exit code, or -1 when it has not ended in time.
  [[nodiscard]] int wait(std::chrono::duration<double> patience = std::chrono::seconds{20});
  /// What it has printed so far.
  [[nodiscard]] std::string output();
  /// Until it has printed `text`.
  [[nodiscard]] bool prints(const std::string& text, std::chrono::duration<double> patience);
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Processes whose parent it is.
  [[nodiscard]] std::vector<pid_t> children() const;

 private:
  TemporaryFolder cache_;
  pid_t pid_ = 0;
  int output_ = -1;
  std::string text_;
};

struct Finished {
  int code = -1;
  std::string output;
};
[[nodiscard]] Finished run_program(const std::vector<std::string>& arguments);

/// Asks `done` every 10 ms.
[[nodiscard]] bool eventually(const std::function<bool()>& done, std::chrono::duration<double> patience);
[[nodiscard]] bool is_running(pid_t pid);

}  // namespace docent
