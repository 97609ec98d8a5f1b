#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "docent/base/result.h"

namespace docent::interaction {

/// The phonemes of the International Phonetic Alphabet, as espeak-ng writes them for American English, in those of the
/// CMU dictionary: "mjuːzˈiəm" is "M Y UW Z IY AH M". What is none of both alphabets is left out.
[[nodiscard]] std::string cmu_phonemes(std::string_view ipa);

/// How words sound, in phonemes of the CMU dictionary, by espeak-ng. [words], each as many phonemes as it has. Error:
/// espeak-ng does not run, or says nothing. O(words), some milliseconds each.
[[nodiscard]] Result<std::vector<std::string>> pronounce(const std::vector<std::string>& words);

}  // namespace docent::interaction
