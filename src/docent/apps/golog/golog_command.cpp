#include "docent/apps/golog/golog_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "docent/apps/golog/golog_trace.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/map_note.h"
#include "docent/apps/shared/tour_check.h"
#include "docent/base/files.h"
#include "docent/base/suggestion.h"
#include "docent/museum/museum.h"
#include "docent/planning/value_iteration/route.h"
#include "docent/task_control/golog/golog_program.h"
#include "docent/task_control/travel_times/travel.h"

namespace docent::apps::golog_command {
namespace {

struct Options {
  std::string museum;
  std::string program;  ///< empty: the museum's own
  std::string main;     ///< empty: the program's own
  std::vector<std::string> requests;
  std::string events;
  double most_s = 3600.0;  ///< [s]
};

std::filesystem::path file_of(const Options& options) {
  return options.program.empty() ? task_control::golog_file(options.museum) : std::filesystem::path{options.program};
}

task_control::GologProgram program_of(const Options& options, const museum::Museum& museum) {
  const planning::RoutePlanner planner{museum.map, museum.hazard_polygons(), museum.area, planning::RouteParams{}};
  return value_or_fail(task_control::GologProgram::load({}, file_of(options), programme_of(museum),
                                                        task_control::travel_on_map(planner), options.main));
}

std::vector<task_control::GologTerm> requests_of(const Options& options, const museum::Museum& museum) {
  std::vector<task_control::GologTerm> events;
  for (const std::string& id : options.requests) {
    if (museum.find_exhibit(id) == nullptr) {
      std::vector<std::string> known;
      for (const museum::Exhibit& exhibit : museum.exhibits) known.push_back(exhibit.id);
      throw CommandFailed{"--request " + id + ": there is no such exhibit" + did_you_mean(id, known), 2};
    }
    events.push_back({"requested", {id}});
  }
  return events;
}

void check(const Options& options) {
  const museum::Museum museum = load_museum_and_say(options.museum);
  const auto file = file_of(options);
  const TourFindings found = check_tour(file, museum);
  for (const std::string& note : found.notes) std::printf("%s\n", note.c_str());
  for (const Error& fault : found.faults) std::fprintf(stderr, "%s\n", fault.message.c_str());
  if (!found.faults.empty()) {
    throw CommandFailed{file.string() + ": " + std::to_string(found.faults.size()) +
                        (found.faults.size() == 1 ? " fault" : " faults")};
  }
  const bool is_shipped = options.program.empty() && file != std::filesystem::path{options.museum} / "tour.pl";
  std::printf("%s: fine, for the %zu exhibits of %s%s\n", file.string().c_str(), museum.exhibits.size(),
              options.museum.c_str(), is_shipped ? ", which has no tour.pl of its own" : "");
}

void plan(const Options& options) {
  const museum::Museum museum = load_museum_and_say(options.museum);
  task_control::GologProgram program = program_of(options, museum);
  const Point2 home{museum.home.x, museum.home.y};
  const auto requests = requests_of(options, museum);
  const task_control::GologStep first = value_or_fail(program.step(Time{}, home, requests));
  if (first.kind == task_control::GologStep::Kind::begin) {
    std::printf("%s\n", to_text(first.action).c_str());
    value_or_fail(program.outcome(first.action, {}));
  }
  const task_control::GologForesight foresight = value_or_fail(program.foresee(home));
  for (const task_control::GologTerm& action : foresight.actions) std::printf("%s\n", to_text(action).c_str());
  if (foresight.end == task_control::GologStep::Kind::waits) std::printf("(waits)\n");
  if (foresight.end == task_control::GologStep::Kind::begin) std::printf("(and so on)\n");
}

void trace(const Options& options) {
  const museum::Museum museum = load_museum_and_say(options.museum);
  std::vector<TraceEvent> events;
  for (const task_control::GologTerm& request : requests_of(options, museum)) {
    events.push_back({0.0, TraceEvent::Kind::event, request});
  }
  if (!options.events.empty()) {
    const auto text = value_or_fail(read_file(options.events));
    for (TraceEvent& event : value_or_fail(parse_trace_events(text, options.events)))
      events.push_back(std::move(event));
  }
  task_control::GologProgram program = program_of(options, museum);
  value_or_fail(play_trace(program, programme_of(museum), events, options.events, options.most_s,
                           [](const std::string& line) { std::printf("%s\n", line.c_str()); }));
}

CLI::App* add(CLI::App& parent, const char* name, const char* meaning, const std::shared_ptr<Options>& options,
              void (*run)(const Options&)) {
  CLI::App* command = parent.add_subcommand(name, meaning);
  command->add_option("museum", options->museum, "folder with a museum.yaml")->required();
  command->add_option("--program", options->program, "its tour program; without it MUSEUM/tour.pl, or the shipped one");
  command->callback([options, run] { run(*options); });
  return command;
}

}  // namespace

void add_golog_command(CLI::App& app) {
  CLI::App* golog = app.add_subcommand("golog", "Check a museum's tour program, show its plan, try it on events");
  golog->require_subcommand(1);
  auto options = std::make_shared<Options>();
  add(*golog, "check", "Every fault of the program and of golex.yaml, with file and line", options, check);
  CLI::App* planned = add(*golog, "plan", "What the program would do about some requests", options, plan);
  CLI::App* traced = add(*golog, "trace", "Play events to the program and print each step", options, trace);
  for (CLI::App* command : {planned, traced}) {
    command->add_option("--request", options->requests, "id of an exhibit; may be given again")
        ->allow_extra_args(false);
    command->add_option("--main", options->main, "procedure to run instead of the program's main");
  }
  traced->add_option("--events", options->events,
                     "file with lines \"SECONDS EVENT ARGUMENT...\", such as \"20 requested zuse\" or \"30 lost\",\n"
                     "\"40 failed drive zuse\", \"50 sensed ask_more zuse more\"");
  traced->add_option("--seconds", options->most_s, "to play at most [s]")->capture_default_str();
}

}  // namespace docent::apps::golog_command
