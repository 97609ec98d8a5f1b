#include "docent/task_control/golex/decomposition.h"

#include <algorithm>
#include <set>

#include "docent/base/check.h"
#include "docent/base/files.h"
#include "docent/base/suggestion.h"
#include "docent/base/yaml.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/task_control/golex/actions_file.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {
namespace {

constexpr double kMostWait = 600.0;  // [s] for one item: whoever waits longer has another action in mind
constexpr std::size_t kMostItems = 100;

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_speech(DirectiveKind kind) { return kind == DirectiveKind::say || kind == DirectiveKind::announce; }

bool is_wait(const std::string& text) {
  if (text == "linger") return true;
  char* end = nullptr;
  const double wait_s = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && wait_s >= 0.0 && wait_s <= kMostWait;
}

/// What is wrong with the argument; empty: nothing.
std::string fault_of(DirectiveKind kind, const std::string& argument) {
  switch (kind) {
    case DirectiveKind::look:
      return parse<LookFor>(argument) ? "" : "place, visitors, way, nobody or company";
    case DirectiveKind::music:
      return is_one_of(argument, {"play", "stop"}) ? "" : "play or stop";
    case DirectiveKind::drive:
      return is_one_of(argument, {"place", "charger"}) ? "" : "place or charger";
    case DirectiveKind::dock:
      return argument == "charger" ? "" : "charger";
    case DirectiveKind::relocalize:
      return argument == "here" ? "" : "here";
    case DirectiveKind::ask:
      return argument == "more" ? "" : "more";
    case DirectiveKind::wait:
      return is_wait(argument) ? "" : "linger or seconds, 0 to 600";
    case DirectiveKind::horn:
      return argument.empty() ? "a reason" : "";
    case DirectiveKind::say:
    case DirectiveKind::announce:
      return is_one_of(argument, {"short", "long", "attraction"}) || interaction::find_sentence(argument)
                 ? ""
                 : "short, long, attraction, the key of a sentence, or a text in each language";
  }
  return "";
}

/// What an item may hold.
std::vector<std::string> keys_of_items() {
  std::vector<std::string> keys{"if", "mood"};
  for (const char* kind : words_of(DirectiveKind{})) keys.emplace_back(kind);
  return keys;
}

class ActionsReader {
 public:
  explicit ActionsReader(const YamlFile& file) : file_{file} {}

  void read(Decomposition& decomposition) const {
    if (!file_.root().IsMap()) throw YamlFault{file_.fault(file_.root(), "expected actions, each a list of items")};
    std::set<std::string> seen;
    for (const auto& entry : file_.root()) {
      const auto kind = entry.first.as<std::string>();
      if (!seen.insert(kind).second) throw YamlFault{file_.fault(entry.first, "the action '" + kind + "' comes twice")};
      decomposition.actions[kind] = action(entry.second, kind);
    }
  }

 private:
  [[nodiscard]] std::vector<ActionItem> action(const YAML::Node& node, const std::string& kind) const {
    if (!node.IsSequence() || node.size() > kMostItems)
      throw YamlFault{file_.fault(node, "the action '" + kind + "' must be a list of at most 100 items")};
    std::vector<ActionItem> items;
    std::map<std::string, int> uses;
    for (const auto& entry : node) {
      ActionItem& item = items.emplace_back(this->item(entry));
      for (Directive& directive : item.together) {
        directive.name = base_name(directive);
        directive.use = ++uses[directive.name];
        if (directive.use > 1) directive.name += "-" + std::to_string(directive.use);
      }
    }
    return items;
  }

  /// The names of ids as they always were: of a spoken text its key, of anything else its kind.
  static std::string base_name(const Directive& directive) {
    const bool is_named = is_speech(directive.kind) && directive.texts.empty();
    return is_named || directive.kind == DirectiveKind::ask ? directive.argument : docent::to_text(directive.kind);
  }

  [[nodiscard]] ActionItem item(const YAML::Node& node) const {
    if (!node.IsMap()) throw YamlFault{file_.fault(node, "an item must have directives, such as 'drive: place'")};
    ActionItem item;
    std::set<std::string> seen;
    for (const auto& entry : node) {
      const auto key = entry.first.as<std::string>();
      if (!seen.insert(key).second) throw YamlFault{file_.fault(entry.first, "'" + key + "' comes twice in one item")};
      if (key == "if") {
        const auto condition = parse<Condition>(scalar(entry.second, key));
        if (!condition)
          throw YamlFault{file_.fault(entry.second, "'if' must be more, broken_off, moved or tour_begins")};
        item.condition = *condition;
        continue;
      }
      if (key == "mood") {
        const auto mood = parse<Mood>(scalar(entry.second, key));
        if (!mood) throw YamlFault{file_.fault(entry.second, "'mood' must be neutral, happy, sad or angry")};
        item.mood = *mood;
        continue;
      }
      const auto kind = parse<DirectiveKind>(key);
      if (!kind)
        throw YamlFault{
            file_.fault(entry.first, "unknown directive '" + key + "'" + did_you_mean(key, keys_of_items()))};
      item.together.push_back(directive(*kind, entry.second));
    }
    return item;
  }

  [[nodiscard]] Directive directive(DirectiveKind kind, const YAML::Node& node) const {
    Directive directive{kind, "", {}, ""};
    if (is_speech(kind) && node.IsMap()) {
      for (const auto& text : node)
        directive.texts[text.first.as<std::string>()] = scalar(text.second, docent::to_text(kind));
      return directive;
    }
    directive.argument = scalar(node, docent::to_text(kind));
    if (const std::string wanted = fault_of(kind, directive.argument); !wanted.empty())
      throw YamlFault{file_.fault(node, std::string{"'"} + docent::to_text(kind) + "' must be " + wanted)};
    return directive;
  }

  [[nodiscard]] std::string scalar(const YAML::Node& node, const std::string& key) const {
    if (!node.IsScalar()) throw YamlFault{file_.fault(node, "'" + key + "' must be a word or a text")};
    return node.as<std::string>();
  }

  const YamlFile& file_;
};

}  // namespace

const std::vector<ActionItem>* Decomposition::find(const std::string& kind) const {
  const auto found = actions.find(kind);
  return found == actions.end() ? nullptr : &found->second;
}

bool holds_up(DirectiveKind kind) {
  return kind == DirectiveKind::drive || kind == DirectiveKind::relocalize || kind == DirectiveKind::dock ||
         kind == DirectiveKind::say || kind == DirectiveKind::ask || kind == DirectiveKind::wait;
}

bool leads_somewhere(const std::vector<ActionItem>& action, std::size_t first) {
  for (std::size_t i = first; i < action.size(); ++i) {
    for (const Directive& directive : action[i].together) {
      if (directive.kind == DirectiveKind::drive || directive.kind == DirectiveKind::relocalize) return true;
    }
  }
  return false;
}

const Directive* last_drive(const std::vector<ActionItem>& action, std::size_t count) {
  const Directive* last = nullptr;
  for (std::size_t i = 0; i < std::min(count, action.size()); ++i) {
    for (const Directive& directive : action[i].together) {
      if (directive.kind == DirectiveKind::drive) last = &directive;
    }
  }
  return last;
}

const Decomposition& default_decomposition() {
  static const Decomposition kDefault = [] {
    auto read = parse_decomposition(actions_file(), "actions.yaml", {});
    DOCENT_CHECK(read.has_value());  // decomposition_test reads it
    return std::move(*read);
  }();
  return kDefault;
}

Result<Decomposition> parse_decomposition(const std::string& text, const std::string& name, Decomposition base) {
  const auto file = YamlFile::parse(text, name);
  if (!file) return tl::unexpected<Error>(file.error());
  try {
    ActionsReader{*file}.read(base);
    return base;
  } catch (const YamlFault& fault) {
    return tl::unexpected<Error>(fault.error);
  } catch (const YAML::Exception& why) {
    return fail(name + ":" + std::to_string(why.mark.line + 1) + ": " + why.msg);
  }
}

Result<Decomposition> load_decomposition(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "golex.yaml";
  if (folder.empty() || !std::filesystem::exists(file)) return default_decomposition();
  const auto text = read_file(file);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse_decomposition(*text, file.string(), default_decomposition());
}

}  // namespace docent::task_control
