#include "docent/task_control/golog/prolog_host.h"

#include "docent/base/check.h"
#include "docent/base/shipped_files.h"

namespace docent::task_control {
namespace {

constexpr const char* kModule = "golog_host";

/// Those of the turn under way; Prolog calls foreign predicates with nothing but their arguments.
const PrologQuestions*& questions_under_way() {
  static const PrologQuestions* questions = nullptr;
  return questions;
}

/// travel(+From, +To, -Metres)
foreign_t travel(term_t from, term_t to, term_t metres) {
  const PrologQuestions* questions = questions_under_way();
  const auto start = text_of(from);
  const auto end = text_of(to);
  if (questions == nullptr || !start || !end) return FALSE;
  const auto length = questions->travel(*start, *end);
  return length ? static_cast<foreign_t>(PL_unify_float(metres, *length)) : FALSE;
}

/// order(+From, +Places, -Order)
foreign_t order(term_t from, term_t places, term_t order) {
  const PrologQuestions* questions = questions_under_way();
  const auto start = text_of(from);
  const auto names = texts_of(places);
  if (questions == nullptr || !start || !names) return FALSE;
  const auto ordered = questions->order(*start, *names);
  const term_t answer = PL_new_term_ref();
  if (!ordered || !put_words(answer, *ordered)) return FALSE;
  return static_cast<foreign_t>(PL_unify(order, answer));
}

std::string exception_text() {
  const term_t exception = PL_exception(0);
  char* text = nullptr;
  std::string what = "an unknown fault";
  if (exception != 0 && PL_get_nchars(exception, nullptr, &text, CVT_WRITE | BUF_MALLOC | REP_UTF8) != 0) {
    what = text;
    PL_free(text);
  }
  PL_clear_exception();
  return what;
}

}  // namespace

Result<PrologHost*> PrologHost::instance() {
  static PrologHost host;
  const std::lock_guard lock{host.mutex_};
  if (!host.has_started_) {
    if (auto started = host.start(); !started) return tl::unexpected(started.error());
  }
  return &host;
}

Result<void> PrologHost::start() {
  if (PL_is_initialised(nullptr, nullptr) == 0) {
    // The strings live on: Prolog keeps pointers to them.
    static std::vector<std::string> words{"docent",     "-q",           "-f",   "none",     "-F",
                                          "none",       "-t",           "halt", "--no-tty", "--no-packs",
                                          "--no-debug", "--no-signals", "-g",   "true",     "--stack-limit=64m"};
    static std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (PL_initialise(static_cast<int>(words.size()), arguments.data()) == 0) return fail("SWI-Prolog does not start");
  }
  PL_register_foreign_in_module(kModule, "travel", 3, reinterpret_cast<pl_function_t>(travel), 0);
  PL_register_foreign_in_module(kModule, "order", 3, reinterpret_cast<pl_function_t>(order), 0);
  const std::string file = shipped_path("prolog/host.pl").string();
  const fid_t frame = PL_open_foreign_frame();
  const term_t name = PL_new_term_ref();
  const bool is_loaded = put_word(name, file) && PL_call_predicate(nullptr, PL_Q_NODEBUG | PL_Q_PASS_EXCEPTION,
                                                                   PL_predicate("use_module", 1, "system"), name) != 0;
  const std::string why = is_loaded ? "" : exception_text();
  PL_discard_foreign_frame(frame);
  if (!is_loaded) return fail(file + ": cannot be loaded: " + why);
  has_started_ = true;
  return {};
}

std::string PrologHost::new_domain() {
  const std::lock_guard lock{mutex_};
  return "tour_" + std::to_string(++domains_);
}

PrologTurn::PrologTurn(PrologHost& host, const PrologQuestions& questions) : lock_{host.mutex_} {
  if (PL_thread_self() < 0) is_guest_ = PL_thread_attach_engine(nullptr) >= 0;
  DOCENT_CHECK(PL_thread_self() >= 0);
  frame_ = PL_open_foreign_frame();
  questions_under_way() = &questions;
}

PrologTurn::~PrologTurn() {
  questions_under_way() = nullptr;
  PL_discard_foreign_frame(frame_);
  if (is_guest_) PL_thread_destroy_engine();
}

Result<bool> PrologTurn::call(const char* name, int arity, term_t arguments) {
  const qid_t query =
      PL_open_query(nullptr, PL_Q_NODEBUG | PL_Q_PASS_EXCEPTION, PL_predicate(name, arity, kModule), arguments);
  const bool is_true = PL_next_solution(query) != 0;
  const bool has_thrown = !is_true && PL_exception(query) != 0;
  PL_cut_query(query);
  if (has_thrown) return fail("Prolog: " + exception_text());
  return is_true;
}

bool put_text(term_t term, const std::string& text) {
  return PL_put_chars(term, PL_STRING | REP_UTF8, text.size(), text.c_str()) != 0;
}

bool put_word(term_t term, const std::string& text) {
  return PL_put_chars(term, PL_ATOM | REP_UTF8, text.size(), text.c_str()) != 0;
}

bool put_term(term_t term, const GologTerm& value) {
  if (value.arguments.empty()) return put_word(term, value.name);
  const auto count = value.arguments.size();
  const term_t arguments = PL_new_term_refs(static_cast<int>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto* word = std::get_if<std::string>(&value.arguments[i]);
    const bool is_put = word != nullptr ? put_word(arguments + i, *word)
                                        : PL_put_float(arguments + i, std::get<double>(value.arguments[i])) != 0;
    if (!is_put) return false;
  }
  const atom_t name = PL_new_atom_mbchars(REP_UTF8, value.name.size(), value.name.c_str());
  const bool is_made = PL_cons_functor_v(term, PL_new_functor(name, count), arguments) != 0;
  PL_unregister_atom(name);
  return is_made;
}

namespace {

template <class Values, class Put>
bool put_list(term_t list, const Values& values, const Put& put) {
  if (PL_put_nil(list) == 0) return false;
  const term_t item = PL_new_term_ref();
  for (auto value = values.rbegin(); value != values.rend(); ++value) {
    if (!put(item, *value) || PL_cons_list(list, item, list) == 0) return false;
  }
  return true;
}

}  // namespace

bool put_words(term_t term, std::span<const std::string> words) { return put_list(term, words, put_word); }

bool put_terms(term_t term, std::span<const GologTerm> values) { return put_list(term, values, put_term); }

std::optional<std::string> text_of(term_t term) {
  char* text = nullptr;
  std::size_t size = 0;
  if (PL_get_nchars(term, &size, &text, CVT_ATOMIC | BUF_MALLOC | REP_UTF8) == 0) return std::nullopt;
  std::string found{text, size};
  PL_free(text);
  return found;
}

std::optional<std::vector<std::string>> texts_of(term_t list) {
  std::vector<std::string> texts;
  const term_t rest = PL_copy_term_ref(list);
  const term_t head = PL_new_term_ref();
  while (PL_get_list(rest, head, rest) != 0) {
    auto text = text_of(head);
    if (!text) return std::nullopt;
    texts.push_back(std::move(*text));
  }
  return texts;
}

Result<GologTerm> term_of(term_t term) {
  atom_t name = 0;
  std::size_t arity = 0;
  GologTerm found;
  if (PL_get_name_arity(term, &name, &arity) == 0) return fail("an action has no name");
  const term_t argument = PL_new_term_ref();
  PL_put_atom(argument, name);
  found.name = text_of(argument).value_or("");
  for (std::size_t i = 1; i <= arity; ++i) {
    double number = 0.0;
    if (PL_get_arg(i, term, argument) == 0) return fail(found.name + " has no argument " + std::to_string(i));
    if (PL_is_number(argument) != 0 && PL_get_float(argument, &number) != 0) {
      found.arguments.emplace_back(number);
    } else if (auto text = text_of(argument)) {
      found.arguments.emplace_back(std::move(*text));
    } else {
      return fail(found.name + ": argument " + std::to_string(i) + " is neither a name nor a number");
    }
  }
  return found;
}

Result<std::vector<GologTerm>> terms_of(term_t list) {
  std::vector<GologTerm> terms;
  const term_t rest = PL_copy_term_ref(list);
  const term_t head = PL_new_term_ref();
  while (PL_get_list(rest, head, rest) != 0) {
    auto term = term_of(head);
    if (!term) return tl::unexpected(term.error());
    terms.push_back(std::move(*term));
  }
  return terms;
}

}  // namespace docent::task_control
