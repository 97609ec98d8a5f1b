#include "docent/task_control/golog/golog_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "docent/base/shipped_files.h"
#include "docent/task_control/golog/prolog_process.h"
#include "docent/task_control/golog/prolog_text.h"
#include "docent/task_control/tour_scheduler/route.h"

namespace docent::task_control {
namespace {

Error not_understood() { return {"Prolog: an answer is not what was asked for"}; }

Result<GologStep::Kind> kind_of(const PrologValue* word) {
  constexpr std::array<std::pair<const char*, GologStep::Kind>, 5> kKinds{{{"begin", GologStep::Kind::begin},
                                                                           {"more", GologStep::Kind::begin},
                                                                           {"stop", GologStep::Kind::stop},
                                                                           {"waits", GologStep::Kind::waits},
                                                                           {"finished", GologStep::Kind::finished}}};
  if (word == nullptr || word->text() == nullptr) return tl::unexpected(not_understood());
  for (const auto& [name, kind] : kKinds) {
    if (*word->text() == name) return kind;
  }
  return fail("Prolog: '" + *word->text() + "' is no result of a step");
}

}  // namespace

Result<void> GologParams::validate() const {
  if (most_inferences <= 0) return fail("golog.most_inferences must be > 0");
  if (!(answer_s > 0.0)) return fail("golog.answer_s must be > 0");
  if (memory_mb < 256) return fail("golog.memory_mb must be >= 256");
  return {};
}

std::filesystem::path shipped_golog_file() { return shipped_path("prolog/tour_guide.pl"); }

std::filesystem::path golog_file(const std::filesystem::path& museum_folder) {
  const auto own = museum_folder / "tour.pl";
  std::error_code error;
  return std::filesystem::exists(own, error) ? own : shipped_golog_file();
}

GologProgram::GologProgram(const GologParams& params, Programme programme, TravelDistance travel, Source source)
    : params_{params},
      programme_{std::move(programme)},
      travel_{std::move(travel)},
      source_{std::move(source)},
      robot_{programme_.home.x, programme_.home.y} {}

GologProgram::GologProgram(GologProgram&& other) noexcept = default;

GologProgram::~GologProgram() = default;

std::vector<Error> GologProgram::faults(const std::filesystem::path& file, const Programme& programme) {
  GologProgram program{{}, programme, straight_distance(), {file, ""}};
  return program.read();
}

Result<GologProgram> GologProgram::load(const GologParams& params, const std::filesystem::path& file,
                                        Programme programme, TravelDistance travel, const std::string& main) {
  GologProgram program{params, std::move(programme), std::move(travel), {file, main}};
  if (const auto faults = program.read(); !faults.empty()) return tl::unexpected(faults.front());
  return program;
}

bool GologProgram::is_alive() const { return process_ != nullptr && process_->is_alive(); }

std::vector<Error> GologProgram::read() {
  auto process = PrologProcess::start({params_.answer_s, params_.memory_mb});
  if (!process) return {process.error()};
  process_ = std::move(*process);
  const std::array<std::string, 2> files{source_.file.string(), shipped_path("prolog/museum.pl").string()};
  std::vector<std::string> exhibits;
  for (const ProgrammeExhibit& exhibit : programme_.exhibits) exhibits.push_back(exhibit.id);
  const auto found = asked("load(" + prolog_atoms(files) + "," + prolog_atoms(exhibits) + "," +
                           (programme_.charger ? "true" : "false") + "," + prolog_atom(source_.main) + ")");
  if (!found) return {found.error()};
  std::vector<Error> faults;
  for (std::string& text : texts_of(*found)) faults.push_back({std::move(text)});
  return faults;
}

Result<PrologValue> GologProgram::asked(const std::string& question) {
  auto found = process_->ask(
      question,
      {[this](const std::string& from, const std::string& to) { return way(from, to); },
       [this](const std::string& from, const std::vector<std::string>& places) { return order(from, places); }});
  if (!found && !is_alive()) return fail(source_.file.string() + ": " + found.error().message);
  return found;
}

Result<PrologValue> GologProgram::ask(const std::string& question) {
  if (!is_alive()) {
    if (const auto faults = read(); !faults.empty()) return tl::unexpected(faults.front());
  }
  return asked(question);
}

std::optional<Point2> GologProgram::place(const std::string& name) const {
  if (name == "home") return Point2{programme_.home.x, programme_.home.y};
  if (name == "somewhere") return robot_;
  if (name == "charger" && programme_.charger) return Point2{programme_.charger->x, programme_.charger->y};
  const ProgrammeExhibit* exhibit = programme_.find_exhibit(name);
  if (exhibit == nullptr) return std::nullopt;
  return Point2{exhibit->pose.x, exhibit->pose.y};
}

std::optional<double> GologProgram::way(const std::string& from, const std::string& to) const {
  const auto start = place(from);
  const auto end = place(to);
  if (!start || !end) return std::nullopt;
  const double metres = travel_(*start, *end);
  if (!std::isfinite(metres)) return std::nullopt;  // as good as out of reach
  return metres;
}

std::optional<std::vector<std::string>> GologProgram::order(const std::string& from,
                                                            const std::vector<std::string>& places) const {
  const auto start = place(from);
  std::vector<StopPlaces> stops;
  for (const std::string& name : places) {
    const auto point = place(name);
    if (!point) return std::nullopt;
    stops.push_back({*point});
  }
  if (!start) return std::nullopt;
  std::vector<std::string> ordered;
  for (const RouteStop& next : shortest_route(*start, stops, travel_)) ordered.push_back(places[next.stop]);
  return ordered;
}

Result<GologStep> GologProgram::step(Time now, Point2 robot, std::span<const GologTerm> events) {
  robot_ = robot;
  const auto found = ask("step(" + prolog_number(to_seconds(now)) + "," + prolog_terms(events) + "," +
                         std::to_string(params_.most_inferences) + ")");
  if (!found) return tl::unexpected(found.error());
  const auto kind = kind_of(found->at(0));
  if (!kind) return tl::unexpected(kind.error());
  if (*kind == GologStep::Kind::waits || *kind == GologStep::Kind::finished) return GologStep{*kind};
  if (found->at(1) == nullptr) return tl::unexpected(not_understood());
  auto action = term_of(*found->at(1));
  if (!action) return tl::unexpected(action.error());
  return GologStep{*kind, std::move(*action)};
}

Result<void> GologProgram::outcome(const GologTerm& action, const GologOutcome& outcome) {
  GologTerm how{outcome.kind == GologOutcome::Kind::failed ? "failed" : "done"};
  if (outcome.kind == GologOutcome::Kind::sensed) how = {"value", {outcome.value}};
  const auto found = ask("outcome(" + prolog_term(action) + "," + prolog_term(how) + ")");
  if (!found) return tl::unexpected(found.error());
  return {};
}

Result<std::vector<GologAction>> GologProgram::actions() {
  const auto found = ask("actions");
  if (!found) return tl::unexpected(found.error());
  if (found->at(0) == nullptr || found->at(1) == nullptr) return tl::unexpected(not_understood());
  const auto names = texts_of(*found->at(0));
  const auto places = texts_of(*found->at(1));
  std::vector<GologAction> actions;
  for (std::size_t i = 0; i < std::min(names.size(), places.size()); ++i) actions.push_back({names[i], places[i]});
  return actions;
}

Result<void> GologProgram::check_event(const GologTerm& event) {
  const auto found = ask("check_event(" + prolog_term(event) + ")");
  if (!found) return tl::unexpected(found.error());
  return {};
}

Result<std::vector<GologTerm>> GologProgram::impossible() {
  const auto found = ask("impossible");
  if (!found) return tl::unexpected(found.error());
  return terms_of(*found);
}

Result<void> GologProgram::begin_again() {
  const auto found = ask("begin_again");
  if (!found) return tl::unexpected(found.error());
  return {};
}

Result<GologForesight> GologProgram::foresee(Point2 robot, int most_actions) {
  robot_ = robot;
  const auto found =
      ask("foresee(" + std::to_string(most_actions) + "," + std::to_string(params_.most_inferences) + ")");
  if (!found) return tl::unexpected(found.error());
  if (found->at(0) == nullptr) return tl::unexpected(not_understood());
  const auto end = kind_of(found->at(1));
  if (!end) return tl::unexpected(end.error());
  auto actions = terms_of(*found->at(0));
  if (!actions) return tl::unexpected(actions.error());
  return GologForesight{std::move(*actions), *end};
}

std::optional<double> GologProgram::expected_s(Point2 robot, const GologTerm& action) {
  robot_ = robot;
  const auto found = ask("duration(" + prolog_term(action) + ")");
  if (!found || found->at(0) == nullptr || found->at(0)->number() == nullptr) return std::nullopt;
  return *found->at(0)->number();
}

Result<std::string> GologProgram::snapshot() {
  const auto found = ask("snapshot");
  if (!found) return tl::unexpected(found.error());
  if (found->text() == nullptr) return tl::unexpected(not_understood());
  return *found->text();
}

Result<void> GologProgram::restore(const std::string& snapshot) {
  const auto found = ask("restore(" + prolog_string(snapshot) + ")");
  if (!found) return tl::unexpected(found.error());
  return {};
}

}  // namespace docent::task_control
