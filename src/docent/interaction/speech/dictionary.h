#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "docent/base/result.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// The ways to put a sentence.
struct Phrasing {
  std::array<std::vector<std::string>, words_of(Mood{}).size()> by_mood;  ///< [moods][variants], with {} for the title
  [[nodiscard]] const std::vector<std::string>& of(Mood mood) const {
    return by_mood.at(static_cast<std::size_t>(mood));
  }
};

/// What the robot must know of a language to speak of itself in it: a file languages/CODE.yaml. The build takes all
/// files of that folder into the program.
struct Dictionary {
  /// With which a title may begin; inside a sentence they are written small.
  std::vector<std::string> articles;
  // How long espeak-ng speaks at 175 words a minute: least squares over short and long texts.
  double per_character = 0.0;  ///< [s] > 0
  double per_sentence = 0.0;   ///< [s] >= 0
  /// In the file a text, which is its only, neutral form, or a list of texts for each mood that has words of its own:
  /// `neutral`, `happy`, `sad`, `angry`.
  std::array<Phrasing, kSentences> sentences;
};

/// Error: "NAME:LINE: why"; each sentence must be there, and have its {} in all its forms or in none.
[[nodiscard]] Result<Dictionary> parse_dictionary(const std::string& text, const std::string& name);

/// All dictionaries, by the code of their language.
[[nodiscard]] const std::map<std::string, Dictionary, std::less<>>& dictionaries();

/// The dictionary of the language; where there is none, the English one.
[[nodiscard]] const Dictionary& dictionary_of(std::string_view language);

}  // namespace docent::interaction
