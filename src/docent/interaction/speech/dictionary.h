#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "docent/base/result.h"
#include "docent/interaction/speech/sentences.h"

namespace docent::interaction {

/// What the robot must know of a language to speak of itself in it: a file languages/CODE.yaml. The build takes all
/// files of that folder into the program.
struct Dictionary {
  /// With which a title may begin; inside a sentence they are written small.
  std::vector<std::string> articles;
  // How long espeak-ng speaks at 175 words a minute: least squares over short and long texts.
  double per_character = 0.0;                     ///< [s] > 0
  double per_sentence = 0.0;                      ///< [s] >= 0
  std::array<std::string, kSentences> sentences;  ///< with {} where the title goes
};

/// Error: "NAME:LINE: why"; each sentence must be there.
[[nodiscard]] Result<Dictionary> parse_dictionary(const std::string& text, const std::string& name);

/// All dictionaries, by the code of their language.
[[nodiscard]] const std::map<std::string, Dictionary, std::less<>>& dictionaries();

/// The dictionary of the language; where there is none, the English one.
[[nodiscard]] const Dictionary& dictionary_of(std::string_view language);

}  // namespace docent::interaction
