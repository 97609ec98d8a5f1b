#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/task_control/golog/prolog_text.h"

namespace docent::task_control {

/// What programs ask of C++ while they run.
struct PrologQuestions {
  /// [m]; nullopt: there is no such place.
  std::function<std::optional<double>(const std::string& from, const std::string& to)> travel;
  /// The order with the least travel; nullopt: there is no such place.
  std::function<std::optional<std::vector<std::string>>(const std::string& from,
                                                        const std::vector<std::string>& places)>
      order;
};

struct PrologLimits {
  double answer_s = 3.0;  ///< [s] > 0 that it computes or sleeps for one answer; waiting for a processor is no fault
  std::int64_t memory_mb = 512;  ///< [MB] > 0 of addresses, Prolog's own 150 among them
};

/// SWI-Prolog with prolog/host.pl in a process of its own: a program that never returns, takes all memory or halts
/// ends that process and nothing else. Its standard input and output are the line to it; its errors go where ours go.
class PrologProcess {
 public:
  /// Error: `swipl` cannot be started.
  [[nodiscard]] static Result<std::unique_ptr<PrologProcess>> start(const PrologLimits& limits);
  /// Ends the process.
  ~PrologProcess();
  PrologProcess(const PrologProcess&) = delete;
  PrologProcess& operator=(const PrologProcess&) = delete;

  /// Asks one thing, and answers what is asked back meanwhile.
  /// @param question  a term without the full stop, see `answer/4` in prolog/host.pl
  /// @returns what host.pl has found, a list. Error: a fault of the program; or the process has ended, and why.
  [[nodiscard]] Result<PrologValue> ask(const std::string& question, const PrologQuestions& back);
  /// No: the process is over, and each question an error.
  [[nodiscard]] bool is_alive() const { return pid_ > 0; }

 private:
  class Patience;
  PrologProcess(pid_t pid, int line, const PrologLimits& limits) : pid_{pid}, line_{line}, limits_{limits} {}
  [[nodiscard]] Result<void> send(const std::string& text);
  [[nodiscard]] Result<PrologValue> receive(Patience& patience);
  /// Ends the process, unless it has ended. @returns how it ended, or why it was made to.
  [[nodiscard]] Error end(const std::string& why);

  pid_t pid_;  ///< 0: it is over
  int line_;
  PrologLimits limits_;
  std::string read_;  ///< that no value has been made of
};

}  // namespace docent::task_control
