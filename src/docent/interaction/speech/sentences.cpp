#include "docent/interaction/speech/sentences.h"

#include <algorithm>
#include <cctype>

#include "docent/interaction/speech/dictionary.h"

namespace docent::interaction {

std::string sentence(Sentence which, std::string_view language, std::string_view title) {
  const Dictionary& dictionary = dictionary_of(language);
  std::string text = dictionary.sentences.at(static_cast<std::size_t>(which));
  const std::size_t place = text.find("{}");
  if (place == std::string::npos) return text;
  std::string name{title};
  const bool has_article = std::any_of(dictionary.articles.begin(), dictionary.articles.end(),
                                       [&](const std::string& article) { return name.starts_with(article + " "); });
  if (has_article) name.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
  return text.replace(place, 2, name);
}

}  // namespace docent::interaction
