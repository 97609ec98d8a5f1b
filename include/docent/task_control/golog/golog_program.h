#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/task_control/golog/golog_term.h"
#include "docent/task_control/tour_scheduler/programme.h"

namespace docent::task_control {

class PrologProcess;
struct PrologValue;

/// How far a program may go.
struct GologParams {
  /// [inferences] > 0 of one step; about 0.4 s. The next action for 13 exhibits takes 0.1 million.
  std::int64_t most_inferences = 10'000'000;
  double answer_s = 3.0;         ///< [s] > 0 of computing or sleeping for one answer: then its process is ended
  std::int64_t memory_mb = 512;  ///< [MB] >= 256 of addresses of its process; Prolog itself takes 150
  template <class V>
  void visit(V& v) {
    v("most_inferences", most_inferences);
    v("answer_s", answer_s);
    v("memory_mb", memory_mb);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// The program that comes with Docent, prolog/tour_guide.pl.
[[nodiscard]] std::filesystem::path shipped_golog_file();
/// The file of the museum's own program: FOLDER/tour.pl where it exists, else the shipped one.
[[nodiscard]] std::filesystem::path golog_file(const std::filesystem::path& museum_folder);

/// What a robot that carries out a program is told next.
struct GologStep {
  /// An action begins or stops; the program waits; it is over.
  enum class Kind { begin, stop, waits, finished };
  Kind kind = Kind::waits;  ///< what to do now
  GologTerm action{};       ///< of begin and stop
};

/// How an action went.
struct GologOutcome {
  /// How an action ended.
  enum class Kind { done, sensed, failed };
  Kind kind = Kind::done;  ///< how it ended
  std::string value{};     ///< what was sensed
};

/// An action that a program can speak of.
struct GologAction {
  std::string name;   ///< as the program has it
  std::string place;  ///< where it is declared, "FILE:LINE"
};

/// What a program would do next.
struct GologForesight {
  std::vector<GologTerm> actions;                ///< in their order
  GologStep::Kind end = GologStep::Kind::waits;  ///< begin: there is more than was asked for
};

/// A tour program in GOLOG [Rhino1999] 4.3, under way: events come in, primitive actions go out (`prolog/README.md`).
/// The program is the museum's file, its domain prolog/museum.pl; places are the ids of exhibits, `home`, `charger` and
/// `somewhere`, the robot's place between them. The order of more than six exhibits is `shortest_order`.
///
/// A program may call any Prolog, and runs in a process of its own. Faults name file and line, and a step that takes
/// more than `most_inferences` is cut; then nothing has changed. A program that gives no answer, takes all memory or
/// halts ends its process: that is an error, too, and with the next call the program begins anew, as it was loaded.
/// Deterministic but for that; knows no clock and no messages. Asked by one thread at a time.
class GologProgram {
 public:
  /// @returns every fault, "FILE:LINE: what is wrong"; none: the program may run.
  [[nodiscard]] static std::vector<Error> faults(const std::filesystem::path& file, const Programme& programme);
  /// @param travel  between places the same all along
  /// @param main  the procedure to run instead of the file's own `main`; empty: that one. Error: the first fault.
  [[nodiscard]] static Result<GologProgram> load(const GologParams& params, const std::filesystem::path& file,
                                                 Programme programme, TravelDistance travel,
                                                 const std::string& main = {});
  GologProgram(GologProgram&& other) noexcept;
  GologProgram& operator=(GologProgram&&) = delete;
  GologProgram(const GologProgram&) = delete;
  GologProgram& operator=(const GologProgram&) = delete;
  ~GologProgram();

  /// Takes in what has happened and goes on to the next thing that the robot must be told. To be called until nothing
  /// comes, and again after events, after outcomes, and about once a second, because of time-outs.
  /// @param robot  its place [m], map. Error: a fault of the program, an unknown event, or a Prolog time-out.
  [[nodiscard]] Result<GologStep> step(Time now, Point2 robot, std::span<const GologTerm> events = {});
  /// Of an action that was begun; of any other it changes nothing.
  [[nodiscard]] Result<void> outcome(const GologTerm& action, const GologOutcome& outcome);
  /// All actions that it can speak of, its own among them, each name once.
  [[nodiscard]] Result<std::vector<GologAction>> actions();
  /// Error: why it is no event of the program.
  [[nodiscard]] Result<void> check_event(const GologTerm& event);
  /// The actions that it would begin now if they were possible.
  [[nodiscard]] Result<std::vector<GologTerm>> impossible();
  /// Runs `main` from its beginning; what is true stays true.
  [[nodiscard]] Result<void> begin_again();
  /// What the program would begin from here if every action succeeded and nothing else happened.
  [[nodiscard]] Result<GologForesight> foresee(Point2 robot, int most_actions = 200);
  /// What the domain expects an action to take from here [s]; nullopt: it does not say.
  [[nodiscard]] std::optional<double> expected_s(Point2 robot, const GologTerm& action);

  /// All that must survive, one line: what is left of the program, and what is true now.
  [[nodiscard]] Result<std::string> snapshot();
  /// Error: no snapshot, or one of a program with other procedures or actions; then nothing has changed.
  [[nodiscard]] Result<void> restore(const std::string& snapshot);
  /// No: its process has ended, and with it what it knew; the next call begins it anew.
  [[nodiscard]] bool is_alive() const;

 private:
  struct Source {
    std::filesystem::path file;
    std::string main;
  };
  GologProgram(const GologParams& params, Programme programme, TravelDistance travel, Source source);
  /// Begins a process that reads the program. @returns its faults
  [[nodiscard]] std::vector<Error> read();
  [[nodiscard]] Result<PrologValue> asked(const std::string& question);
  /// The same; a process that has ended is begun anew before.
  [[nodiscard]] Result<PrologValue> ask(const std::string& question);
  [[nodiscard]] std::optional<Point2> place(const std::string& name) const;
  [[nodiscard]] std::optional<double> way(const std::string& from, const std::string& to) const;
  [[nodiscard]] std::optional<std::vector<std::string>> order(const std::string& from,
                                                              const std::vector<std::string>& places) const;

  GologParams params_;
  Programme programme_;
  TravelDistance travel_;
  Source source_;
  Point2 robot_;
  std::unique_ptr<PrologProcess> process_;
};

}  // namespace docent::task_control
