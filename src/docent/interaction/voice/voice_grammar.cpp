#include "docent/interaction/voice/voice_grammar.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <utility>

namespace docent::interaction {
namespace {

/// Said or not, they change nothing.
constexpr std::array<std::string_view, 4> kFillers{"please", "the", "a", "an"};

bool is_filler(const std::string& word) { return std::find(kFillers.begin(), kFillers.end(), word) != kFillers.end(); }

std::string key_of(const std::vector<std::string>& words) {
  std::string key;
  for (const std::string& word : words)
    if (!is_filler(word)) key += (key.empty() ? "" : " ") + word;
  return key;
}

std::string joined(const std::vector<std::string>& words, const std::map<std::string, std::string>& token_of) {
  std::string text;
  for (const std::string& word : words) {
    const auto token = token_of.find(word);
    text += (text.empty() ? "" : " ") + (token == token_of.end() ? word : token->second);
  }
  return text;
}

}  // namespace

const char* to_text(VoiceCommand::Kind kind) {
  constexpr std::array<const char*, 9> kWords{"exhibit",  "tour",    "room", "more",   "next",
                                              "end_tour", "deliver", "tidy", "confirm"};
  return kWords.at(static_cast<std::size_t>(kind));
}

std::vector<std::string> said_words(std::string_view title) {
  std::vector<std::string> words;
  std::string word;
  const auto end = [&] {
    if (!word.empty()) words.push_back(std::exchange(word, {}));
  };
  for (std::size_t i = 0; i < title.size(); ++i) {
    const auto letter = static_cast<unsigned char>(title[i]);
    const bool is_within = letter == '\'' && !word.empty() && i + 1 < title.size() &&
                           std::isalpha(static_cast<unsigned char>(title[i + 1])) != 0;  // "Zuse's"
    if (letter >= 0x80 || std::isalnum(letter) != 0 || is_within) {
      word += static_cast<char>(letter < 0x80 ? std::tolower(letter) : letter);
    } else {
      end();
    }
  }
  end();
  return words;
}

void VoiceGrammar::add(const std::vector<std::string>& beginnings, const std::string& name, VoiceCommand command) {
  Spoken spoken{{}, said_words(name), std::move(command)};
  while (!spoken.name.empty() && is_filler(spoken.name.front())) spoken.name.erase(spoken.name.begin());
  for (const std::string& beginning : beginnings) {
    spoken.beginnings.push_back(said_words(beginning));
    std::vector<std::string> all = spoken.beginnings.back();
    all.insert(all.end(), spoken.name.begin(), spoken.name.end());
    if (all.empty() || !meanings_.try_emplace(key_of(all), spoken.command).second) spoken.beginnings.pop_back();
  }
  if (!spoken.beginnings.empty()) commands_.push_back(std::move(spoken));
}

VoiceGrammar::VoiceGrammar(const museum::Museum& museum, bool has_orders) {
  using Kind = VoiceCommand::Kind;
  constexpr const char* kLanguage = "en";
  const std::vector<std::string> to{"take me to", "show me", "go to", "drive to", "I would like to see"};
  const std::vector<std::string> on_tour{"start the tour", "give me the tour", "show me the tour", "take the tour"};
  const std::vector<std::string> bring{"bring this to", "deliver this to"};
  add({"tell me more", "more"}, "", {Kind::more, ""});
  add({"go on", "next"}, "", {Kind::next, ""});
  add({"end the tour", "stop the tour"}, "", {Kind::end_tour, ""});
  if (has_orders) {
    add({"tidy up", "clean up"}, "", {Kind::tidy, ""});
    add({"it is done", "that is done"}, "", {Kind::confirm, ""});
  }
  for (const museum::Exhibit& exhibit : museum.exhibits)
    if (!exhibit.web_only) add(to, museum::translated(exhibit.title, kLanguage), {Kind::exhibit, exhibit.id});
  for (const museum::Tour& tour : museum.tours)
    add(on_tour, museum::translated(tour.title, kLanguage), {Kind::tour, tour.id});
  for (const museum::Room& room : museum.rooms) {
    add(to, museum::translated(room.name, kLanguage), {Kind::room, room.id});
    if (has_orders) add(bring, museum::translated(room.name, kLanguage), {Kind::deliver, room.id});
  }
}

std::vector<std::string> VoiceGrammar::words() const {
  std::set<std::string> words{kFillers.begin(), kFillers.end()};
  for (const Spoken& spoken : commands_) {
    words.insert(spoken.name.begin(), spoken.name.end());
    for (const auto& beginning : spoken.beginnings) words.insert(beginning.begin(), beginning.end());
  }
  return {words.begin(), words.end()};
}

std::string VoiceGrammar::jsgf(const std::map<std::string, std::string>& token_of) const {
  std::string text = "#JSGF V1.0;\ngrammar docent;\npublic <command> = [please] (";
  std::string rules;
  for (std::size_t i = 0; i < commands_.size(); ++i) {
    const std::string rule = "<c" + std::to_string(i) + ">";
    text += (i > 0 ? " | " : "") + rule;
    std::string beginnings;
    for (const auto& beginning : commands_[i].beginnings)
      beginnings += (beginnings.empty() ? "" : " | ") + joined(beginning, token_of);
    rules += rule + " = (" + beginnings + ")";
    if (!commands_[i].name.empty()) rules += " [the] " + joined(commands_[i].name, token_of);
    rules += ";\n";
  }
  return text + ");\n" + rules;
}

std::optional<VoiceCommand> VoiceGrammar::command_of(const std::vector<std::string>& said) const {
  const auto meaning = meanings_.find(key_of(said));
  return meaning == meanings_.end() ? std::nullopt : std::optional{meaning->second};
}

}  // namespace docent::interaction
