#include "docent/interaction/voice/pronunciation.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "docent/base/files.h"
#include "docent/interaction/speech/child_process.h"

namespace docent::interaction {
namespace {

using Phoneme = std::pair<std::string_view, std::string_view>;

/// The longest that fits counts: those that begin alike stand with the longer one first.
constexpr std::array<Phoneme, 66> kPhonemes{{
    {"aɪə", "AY AH"}, {"aɪɚ", "AY ER"}, {"aʊ", "AW"}, {"aɪ", "AY"},   {"ɑːɹ", "AA R"}, {"ɑː", "AA"},
    {"ɑ", "AA"},      {"æ", "AE"},      {"a", "AE"},  {"ʌ", "AH"},    {"əl", "AH L"},  {"ə", "AH"},
    {"ɐ", "AH"},      {"ɔːɹ", "AO R"},  {"ɔɪ", "OY"}, {"ɔː", "AO"},   {"ɔ", "AO"},     {"oːɹ", "AO R"},
    {"oʊ", "OW"},     {"oː", "OW"},     {"o", "OW"},  {"ɛɹ", "EH R"}, {"ɛ", "EH"},     {"eɪ", "EY"},
    {"e", "EH"},      {"ɜː", "ER"},     {"ɝ", "ER"},  {"ɚ", "ER"},    {"ɪɹ", "IH R"},  {"ɪ", "IH"},
    {"iə", "IY AH"},  {"iː", "IY"},     {"i", "IY"},  {"ᵻ", "IH"},    {"ʊɹ", "UH R"},  {"ʊ", "UH"},
    {"uː", "UW"},     {"u", "UW"},      {"tʃ", "CH"}, {"t", "T"},     {"dʒ", "JH"},    {"d", "D"},
    {"ð", "DH"},      {"θ", "TH"},      {"b", "B"},   {"f", "F"},     {"ɡ", "G"},      {"g", "G"},
    {"h", "HH"},      {"k", "K"},       {"x", "K"},   {"l", "L"},     {"ɬ", "L"},      {"m", "M"},
    {"n", "N"},       {"ŋ", "NG"},      {"p", "P"},   {"ɹ", "R"},     {"r", "R"},      {"s", "S"},
    {"ʃ", "SH"},      {"v", "V"},       {"w", "W"},   {"j", "Y"},     {"z", "Z"},      {"ʒ", "ZH"},
}};
constexpr std::array<Phoneme, 2> kMoreConsonants{{{"ɾ", "T"}, {"ʔ", "T"}}};

const Phoneme* phoneme_at(std::string_view ipa) {
  for (const Phoneme& phoneme : kPhonemes)
    if (ipa.starts_with(phoneme.first)) return &phoneme;
  for (const Phoneme& phoneme : kMoreConsonants)
    if (ipa.starts_with(phoneme.first)) return &phoneme;
  return nullptr;
}

/// A folder of its own that goes with it.
struct PhonemeFolder {
  PhonemeFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "docent-voice-XXXXXX").string();
    if (::mkdtemp(pattern.data()) != nullptr) path = pattern;
  }
  PhonemeFolder(const PhonemeFolder&) = delete;
  PhonemeFolder& operator=(const PhonemeFolder&) = delete;
  ~PhonemeFolder() {
    std::error_code ignored;
    if (!path.empty()) std::filesystem::remove_all(path, ignored);
  }
  std::filesystem::path path;
};

}  // namespace

std::string cmu_phonemes(std::string_view ipa) {
  std::string unstressed;
  for (std::size_t i = 0; i < ipa.size();) {
    if (ipa.substr(i).starts_with("ˈ") || ipa.substr(i).starts_with("ˌ")) {
      i += std::string_view{"ˈ"}.size();
    } else {
      unstressed += ipa[i++];
    }
  }
  std::string phonemes;
  for (std::string_view rest = unstressed; !rest.empty();) {
    const Phoneme* found = phoneme_at(rest);
    if (found != nullptr) phonemes += (phonemes.empty() ? "" : " ") + std::string{found->second};
    rest.remove_prefix(found != nullptr ? found->first.size() : 1);
  }
  return phonemes;
}

Result<std::vector<std::string>> pronounce(const std::vector<std::string>& words) {
  std::vector<std::string> result;
  const PhonemeFolder folder;
  if (folder.path.empty()) return fail("no temporary folder for what espeak-ng says");
  const std::filesystem::path file = folder.path / "phonemes.txt";
  for (const std::string& word : words) {
    const auto started =
        start_quietly({"espeak-ng", "-v", "en-us", "-q", "--ipa", "--phonout=" + file.string(), "--", word});
    if (!started) return tl::unexpected(started.error());
    int status = 0;
    while (waitpid(*started, &status, 0) < 0 && errno == EINTR) {
    }
    const auto ipa = read_file(file);
    std::string phonemes = ipa ? cmu_phonemes(*ipa) : std::string{};
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || phonemes.empty())
      return fail("espeak-ng does not say how '" + word + "' sounds");
    result.push_back(std::move(phonemes));
  }
  return result;
}

}  // namespace docent::interaction
