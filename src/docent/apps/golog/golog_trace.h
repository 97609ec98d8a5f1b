#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/task_control/golog/golog_program.h"
#include "docent/task_control/tour_scheduler/programme.h"

namespace docent::apps::golog_command {

/// What a line of an events file says happens.
struct TraceEvent {
  enum class Kind { event, failed, sensed };
  double time_s = 0.0;
  Kind kind = Kind::event;
  task_control::GologTerm term;  ///< the event, or the action that ends so
  std::string value{};           ///< what it senses
  int line = 0;
};

/// Reads lines "SECONDS EVENT ARGUMENT...", "SECONDS failed ACTION ARGUMENT..." and
/// "SECONDS sensed ACTION ARGUMENT... VALUE"; # begins a comment. Error: the first fault, "FILE:LINE: ...".
[[nodiscard]] Result<std::vector<TraceEvent>> parse_trace_events(const std::string& text,
                                                                 const std::filesystem::path& file);

/// Plays the events to a program that begins at home, and prints each thing that comes in or goes out on a line.
/// Actions take as long as the domain expects and succeed, unless an event ends them. Ends when the program has
/// finished, when it waits and nothing more is to come for a minute (time-outs), or after `most_s` [s]; the last lines
/// say which, and which impossible actions it waits for. Error: a fault
/// of the program, or of an event ("FILE:LINE: ...").
[[nodiscard]] Result<void> play_trace(task_control::GologProgram& program, const task_control::Programme& programme,
                                      const std::vector<TraceEvent>& events, const std::filesystem::path& file,
                                      double most_s, const std::function<void(const std::string&)>& print);

}  // namespace docent::apps::golog_command
