#pragma once

#include <SWI-Prolog.h>

#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/task_control/golog/golog_term.h"

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

/// The Prolog of this process with prolog/host.pl. SWI-Prolog exists once in a process and cannot be ended for good:
/// hence the only object of Docent that lives as long as the process.
class PrologHost {
 public:
  /// Starts Prolog when it is first called: quiet, without signal handlers, terminal, init file and threads of its own.
  /// Error: the library of SWI-Prolog or host.pl cannot be loaded.
  [[nodiscard]] static Result<PrologHost*> instance();

  /// A name for a module that nobody uses.
  [[nodiscard]] std::string new_domain();

 private:
  friend class PrologTurn;
  PrologHost() = default;
  [[nodiscard]] Result<void> start();

  std::mutex mutex_;
  bool has_started_ = false;
  int domains_ = 0;
};

/// As long as it lives, its thread has Prolog to itself, and foreign predicates answer by its questions. Terms that are
/// made meanwhile end with it.
class PrologTurn {
 public:
  PrologTurn(PrologHost& host, const PrologQuestions& questions);
  ~PrologTurn();
  PrologTurn(const PrologTurn&) = delete;
  PrologTurn& operator=(const PrologTurn&) = delete;

  /// Calls golog_host:NAME(arguments...) once. Error: it has thrown (out of memory). False: it failed.
  [[nodiscard]] Result<bool> call(const char* name, int arity, term_t arguments);

 private:
  std::unique_lock<std::mutex> lock_;
  bool is_guest_ = false;  ///< the thread has a Prolog engine for this turn only
  fid_t frame_ = 0;
};

// Terms, during a turn. put_…: false when Prolog has no memory left.
[[nodiscard]] bool put_text(term_t term, const std::string& text);  ///< as a string
[[nodiscard]] bool put_word(term_t term, const std::string& text);  ///< as an atom
[[nodiscard]] bool put_term(term_t term, const GologTerm& value);
[[nodiscard]] bool put_words(term_t term, std::span<const std::string> words);
[[nodiscard]] bool put_terms(term_t term, std::span<const GologTerm> values);
/// An atom, string or number as text; nullopt for anything else.
[[nodiscard]] std::optional<std::string> text_of(term_t term);
[[nodiscard]] std::optional<std::vector<std::string>> texts_of(term_t list);
/// Error: an argument is neither an atom nor a number.
[[nodiscard]] Result<GologTerm> term_of(term_t term);
[[nodiscard]] Result<std::vector<GologTerm>> terms_of(term_t list);

}  // namespace docent::task_control
