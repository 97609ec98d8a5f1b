#include "docent/interaction/speech/sentences.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "docent/interaction/speech/dictionary.h"

namespace docent::interaction {
namespace {

const std::vector<std::string>& variants_of(const Dictionary& dictionary, Sentence which, Mood mood) {
  const Phrasing& phrasing = dictionary.sentences.at(static_cast<std::size_t>(which));
  const auto& wanted = phrasing.of(mood);
  if (!wanted.empty()) return wanted;
  if (!phrasing.of(Mood::neutral).empty()) return phrasing.of(Mood::neutral);
  return *std::find_if(phrasing.by_mood.begin(), phrasing.by_mood.end(),
                       [](const auto& variants) { return !variants.empty(); });  // parse_dictionary saw one
}

}  // namespace

std::optional<Sentence> sentence_of(SpeechAct act) {
  switch (act) {
    case SpeechAct::invite:
      return Sentence::attract_invitation;
    case SpeechAct::ask:
      return Sentence::attract_question;
    case SpeechAct::demand:
      return Sentence::attract_demand;
    case SpeechAct::complain:
      return Sentence::attract_complaint;
    case SpeechAct::silence:
      break;
  }
  return std::nullopt;
}

std::string sentence(Sentence which, std::string_view language, Mood mood, int variant, std::string_view title) {
  const Dictionary& dictionary = dictionary_of(language);
  const auto& variants = variants_of(dictionary, which, mood);
  std::string text = variants.at(static_cast<std::size_t>(variant) % variants.size());
  const std::size_t place = text.find("{}");
  if (place == std::string::npos) return text;
  std::string name{title};
  const bool has_article = std::any_of(dictionary.articles.begin(), dictionary.articles.end(),
                                       [&](const std::string& article) { return name.starts_with(article + " "); });
  if (has_article) name.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
  return text.replace(place, 2, name);
}

int count_variants(Sentence which, std::string_view language, Mood mood) {
  return static_cast<int>(variants_of(dictionary_of(language), which, mood).size());
}

}  // namespace docent::interaction
