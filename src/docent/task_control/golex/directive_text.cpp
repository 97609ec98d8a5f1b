#include "docent/task_control/golex/directive_text.h"

#include "docent/base/random.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/interaction/speech/spoken_text.h"

namespace docent::task_control {

int variant_of(const Directive& directive, const ExecutiveTask& task) {
  return static_cast<int>(hash_of(task.order.id) % 1000) + directive.use;  // those of one action differ
}

std::string text_of(const Directive& directive, const ExecutiveTask& task, Mood mood) {
  const std::string& language = task.order.language;
  if (!directive.texts.empty()) {
    const auto text = directive.texts.find(language);
    return interaction::spoken_text((text != directive.texts.end() ? text : directive.texts.begin())->second);
  }
  if (directive.argument == "short") return interaction::introduction(task.title, task.short_text);
  if (directive.argument == "long") return task.long_text;
  const bool attracts = directive.argument == "attraction";
  if (attracts && !task.style) return "";
  const auto which =
      attracts ? interaction::sentence_of(task.style->speech) : interaction::find_sentence(directive.argument);
  return which ? interaction::sentence(*which, language, mood, variant_of(directive, task), task.title) : "";
}

std::string words_for_way(const ExecutiveTask& task, Mood mood, int count) {
  if (task.order.kind == TaskKind::relocalize)
    return interaction::sentence(interaction::Sentence::step_back, task.order.language, mood, count - 1);
  const bool leads_tour = task.order.kind != TaskKind::charge && !task.order.tour_id.empty();
  const auto which = leads_tour && count % 2 == 0 ? interaction::Sentence::stay_behind  //
                                                  : interaction::Sentence::let_me_through;
  return interaction::sentence(which, task.order.language, mood, leads_tour ? (count - 1) / 2 : count - 1);
}

}  // namespace docent::task_control
