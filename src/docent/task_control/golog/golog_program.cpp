#include "docent/task_control/golog/golog_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "docent/base/shipped_files.h"
#include "docent/task_control/golog/prolog_host.h"
#include "docent/task_control/tour_scheduler/route.h"

namespace docent::task_control {
namespace {

/// The last argument of every predicate of host.pl: what was wrong.
Result<void> no_fault(const Result<bool>& is_true, term_t fault) {
  if (!is_true) return tl::unexpected(is_true.error());
  if (!*is_true) return fail("Prolog: a predicate of host.pl fails");
  const std::string text = text_of(fault).value_or("");
  if (!text.empty()) return fail(text);
  return {};
}

Error out_of_memory() { return {"Prolog: no memory is left"}; }

Result<GologStep::Kind> kind_of(const std::string& word) {
  constexpr std::array<std::pair<const char*, GologStep::Kind>, 5> kKinds{{{"begin", GologStep::Kind::begin},
                                                                           {"more", GologStep::Kind::begin},
                                                                           {"stop", GologStep::Kind::stop},
                                                                           {"waits", GologStep::Kind::waits},
                                                                           {"finished", GologStep::Kind::finished}}};
  for (const auto& [name, kind] : kKinds) {
    if (word == name) return kind;
  }
  return fail("Prolog: '" + word + "' is no result of a step");
}

}  // namespace

/// One question to a program: Prolog, and what the program asks back.
class ProgramTurn {
 public:
  explicit ProgramTurn(const GologProgram& program)
      : questions_{[&program](const std::string& from, const std::string& to) { return travel(program, from, to); },
                   [&program](const std::string& from, const std::vector<std::string>& places) {
                     return order(program, from, places);
                   }},
        turn_{*PrologHost::instance().value(), questions_} {}

  [[nodiscard]] Result<bool> call(const char* name, int arity, term_t arguments) {
    return turn_.call(name, arity, arguments);
  }

 private:
  static std::optional<double> travel(const GologProgram& program, const std::string& from, const std::string& to) {
    const auto start = program.place(from);
    const auto end = program.place(to);
    if (!start || !end) return std::nullopt;
    const double metres = program.travel_(*start, *end);
    if (!std::isfinite(metres)) return std::nullopt;  // as good as out of reach
    return metres;
  }
  static std::optional<std::vector<std::string>> order(const GologProgram& program, const std::string& from,
                                                       const std::vector<std::string>& places) {
    const auto start = program.place(from);
    std::vector<StopPlaces> stops;
    for (const std::string& name : places) {
      const auto point = program.place(name);
      if (!point) return std::nullopt;
      stops.push_back({*point});
    }
    if (!start) return std::nullopt;
    std::vector<std::string> ordered;
    for (const RouteStop& next : shortest_route(*start, stops, program.travel_)) ordered.push_back(places[next.stop]);
    return ordered;
  }

  PrologQuestions questions_;
  PrologTurn turn_;
};

/// Kept by C++: a clause that is replaced at every step would leave Prolog its old ones to look through.
struct GologProgram::Agent {
  explicit Agent(term_t term) : record{PL_record(term)} {}
  ~Agent() { PL_erase(record); }
  Agent(const Agent&) = delete;
  Agent& operator=(const Agent&) = delete;

  record_t record;
};

Result<void> GologParams::validate() const {
  if (most_inferences <= 0) return fail("golog.most_inferences must be > 0");
  return {};
}

std::filesystem::path golog_file(const std::filesystem::path& museum_folder) {
  const auto own = museum_folder / "tour.pl";
  std::error_code error;
  return std::filesystem::exists(own, error) ? own : shipped_path("prolog/tour_guide.pl");
}

GologProgram::GologProgram(const GologParams& params, Programme programme, TravelDistance travel)
    : params_{params},
      programme_{std::move(programme)},
      travel_{std::move(travel)},
      robot_{programme_.home.x, programme_.home.y} {}

GologProgram::GologProgram(GologProgram&& other) noexcept
    : params_{other.params_},
      programme_{std::move(other.programme_)},
      travel_{std::move(other.travel_)},
      robot_{other.robot_},
      domain_{std::exchange(other.domain_, {})},
      agent_{std::move(other.agent_)} {}

GologProgram::~GologProgram() {
  if (domain_.empty()) return;
  ProgramTurn turn{*this};
  agent_.reset();
  const term_t domain = PL_new_term_ref();
  if (put_word(domain, domain_)) static_cast<void>(turn.call("host_unload", 1, domain));
}

std::vector<Error> GologProgram::faults(const std::filesystem::path& file, const Programme& programme) {
  GologProgram program{{}, programme, straight_distance()};
  return program.read(file, {});
}

Result<GologProgram> GologProgram::load(const GologParams& params, const std::filesystem::path& file,
                                        Programme programme, TravelDistance travel, const std::string& main) {
  GologProgram program{params, std::move(programme), std::move(travel)};
  if (const auto faults = program.read(file, main); !faults.empty()) return tl::unexpected(faults.front());
  return program;
}

std::vector<Error> GologProgram::read(const std::filesystem::path& file, const std::string& main) {
  const auto host = PrologHost::instance();
  if (!host) return {host.error()};
  domain_ = (*host)->new_domain();
  const std::array<std::string, 2> files{file.string(), shipped_path("prolog/museum.pl").string()};
  std::vector<std::string> exhibits;
  for (const ProgrammeExhibit& exhibit : programme_.exhibits) exhibits.push_back(exhibit.id);

  ProgramTurn turn{*this};
  const term_t arguments = PL_new_term_refs(8);
  if (!put_word(arguments, domain_) || !put_words(arguments + 1, files) || !put_words(arguments + 2, exhibits) ||
      !put_word(arguments + 3, programme_.charger ? "true" : "false") || !put_word(arguments + 4, main)) {
    return {out_of_memory()};
  }
  if (auto fine = no_fault(turn.call("host_load", 8, arguments), arguments + 7); !fine) return {fine.error()};
  std::vector<Error> faults;
  for (std::string& text : texts_of(arguments + 6).value_or(std::vector<std::string>{})) {
    faults.push_back({std::move(text)});
  }
  if (faults.empty()) agent_ = std::make_unique<Agent>(arguments + 5);
  return faults;
}

std::optional<Point2> GologProgram::place(const std::string& name) const {
  if (name == "home") return Point2{programme_.home.x, programme_.home.y};
  if (name == "somewhere") return robot_;
  if (name == "charger" && programme_.charger) return Point2{programme_.charger->x, programme_.charger->y};
  const ProgrammeExhibit* exhibit = programme_.find_exhibit(name);
  if (exhibit == nullptr) return std::nullopt;
  return Point2{exhibit->pose.x, exhibit->pose.y};
}

Result<GologStep> GologProgram::step(Time now, Point2 robot, std::span<const GologTerm> events) {
  robot_ = robot;
  ProgramTurn turn{*this};
  const term_t arguments = PL_new_term_refs(8);
  if (PL_recorded(agent_->record, arguments) == 0 || PL_put_float(arguments + 1, to_seconds(now)) == 0 ||
      !put_terms(arguments + 2, events) || PL_put_int64(arguments + 3, params_.most_inferences) == 0) {
    return tl::unexpected(out_of_memory());
  }
  if (auto fine = no_fault(turn.call("host_step", 8, arguments), arguments + 7); !fine) {
    return tl::unexpected(fine.error());
  }
  auto kind = kind_of(text_of(arguments + 4).value_or(""));
  if (!kind) return tl::unexpected(kind.error());
  agent_ = std::make_unique<Agent>(arguments + 6);
  if (*kind == GologStep::Kind::waits || *kind == GologStep::Kind::finished) return GologStep{*kind};
  auto action = term_of(arguments + 5);
  if (!action) return tl::unexpected(action.error());
  return GologStep{*kind, std::move(*action)};
}

Result<void> GologProgram::outcome(const GologTerm& action, const GologOutcome& outcome) {
  ProgramTurn turn{*this};
  GologTerm how{outcome.kind == GologOutcome::Kind::failed ? "failed" : "done"};
  if (outcome.kind == GologOutcome::Kind::sensed) how = {"value", {outcome.value}};
  const term_t arguments = PL_new_term_refs(5);
  if (PL_recorded(agent_->record, arguments) == 0 || !put_term(arguments + 1, action) ||
      !put_term(arguments + 2, how)) {
    return tl::unexpected(out_of_memory());
  }
  auto fine = no_fault(turn.call("host_outcome", 5, arguments), arguments + 4);
  if (fine) agent_ = std::make_unique<Agent>(arguments + 3);
  return fine;
}

Result<std::vector<GologAction>> GologProgram::actions() {
  ProgramTurn turn{*this};
  const term_t arguments = PL_new_term_refs(4);
  if (PL_recorded(agent_->record, arguments) == 0) return tl::unexpected(out_of_memory());
  if (auto fine = no_fault(turn.call("host_actions", 4, arguments), arguments + 3); !fine)
    return tl::unexpected(fine.error());
  const auto names = texts_of(arguments + 1).value_or(std::vector<std::string>{});
  const auto places = texts_of(arguments + 2).value_or(std::vector<std::string>{});
  std::vector<GologAction> actions;
  for (std::size_t i = 0; i < std::min(names.size(), places.size()); ++i) actions.push_back({names[i], places[i]});
  return actions;
}

Result<void> GologProgram::check_event(const GologTerm& event) {
  ProgramTurn turn{*this};
  const term_t arguments = PL_new_term_refs(3);
  if (PL_recorded(agent_->record, arguments) == 0 || !put_term(arguments + 1, event))
    return tl::unexpected(out_of_memory());
  return no_fault(turn.call("host_check_event", 3, arguments), arguments + 2);
}

Result<std::vector<GologTerm>> GologProgram::impossible() {
  ProgramTurn turn{*this};
  const term_t arguments = PL_new_term_refs(3);
  if (PL_recorded(agent_->record, arguments) == 0) return tl::unexpected(out_of_memory());
  if (auto fine = no_fault(turn.call("host_impossible", 3, arguments), arguments + 2); !fine)
    return tl::unexpected(fine.error());
  return terms_of(arguments + 1);
}

Result<void> GologProgram::begin_again() {
  ProgramTurn turn{*this};
  const term_t arguments = PL_new_term_refs(3);
  if (PL_recorded(agent_->record, arguments) == 0) return tl::unexpected(out_of_memory());
  auto fine = no_fault(turn.call("host_begin_again", 3, arguments), arguments + 2);
  if (fine) agent_ = std::make_unique<Agent>(arguments + 1);
  return fine;
}

Result<GologForesight> GologProgram::foresee(Point2 robot, int most_actions) {
  robot_ = robot;
  ProgramTurn turn{*this};
  const term_t arguments = PL_new_term_refs(6);
  if (PL_recorded(agent_->record, arguments) == 0 || PL_put_integer(arguments + 1, most_actions) == 0 ||
      PL_put_int64(arguments + 2, params_.most_inferences) == 0) {
    return tl::unexpected(out_of_memory());
  }
  if (auto fine = no_fault(turn.call("host_foresee", 6, arguments), arguments + 5); !fine) {
    return tl::unexpected(fine.error());
  }
  auto end = kind_of(text_of(arguments + 4).value_or(""));
  if (!end) return tl::unexpected(end.error());
  auto actions = terms_of(arguments + 3);
  if (!actions) return tl::unexpected(actions.error());
  return GologForesight{std::move(*actions), *end};
}

std::optional<double> GologProgram::expected_s(Point2 robot, const GologTerm& action) {
  robot_ = robot;
  ProgramTurn turn{*this};
  const term_t arguments = PL_new_term_refs(3);
  double expected = 0.0;
  if (PL_recorded(agent_->record, arguments) == 0 || !put_term(arguments + 1, action)) return std::nullopt;
  const auto is_true = turn.call("host_duration", 3, arguments);
  if (!is_true || !*is_true || PL_get_float(arguments + 2, &expected) == 0) return std::nullopt;
  return expected;
}

Result<std::string> GologProgram::snapshot() {
  ProgramTurn turn{*this};
  const term_t arguments = PL_new_term_refs(3);
  if (PL_recorded(agent_->record, arguments) == 0) return tl::unexpected(out_of_memory());
  if (auto fine = no_fault(turn.call("host_snapshot", 3, arguments), arguments + 2); !fine) {
    return tl::unexpected(fine.error());
  }
  return text_of(arguments + 1).value_or("");
}

Result<void> GologProgram::restore(const std::string& snapshot) {
  ProgramTurn turn{*this};
  const term_t arguments = PL_new_term_refs(4);
  if (PL_recorded(agent_->record, arguments) == 0 || !put_text(arguments + 1, snapshot))
    return tl::unexpected(out_of_memory());
  auto fine = no_fault(turn.call("host_restore", 4, arguments), arguments + 3);
  if (fine) agent_ = std::make_unique<Agent>(arguments + 2);
  return fine;
}

}  // namespace docent::task_control
