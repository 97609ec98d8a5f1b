#include "docent/interaction/speech/dictionary.h"

#include <utility>

#include "docent/base/check.h"
#include "docent/base/yaml.h"
#include "docent/interaction/speech/dictionary_files.h"

namespace docent::interaction {
namespace {

/// As the values of Sentence.
constexpr std::array<const char*, kSentences> kKeys{
    "waking",         "relocalizing", "idle",       "waiting",     "driving",    "blocked",
    "explaining",     "asking",       "going_home", "battery_low", "charging",   "announcement",
    "let_me_through", "offer_more",   "home_again", "must_charge", "at_charger", "help",
};

struct Sentences {
  std::array<std::string, kSentences>& texts;
  template <class V>
  void visit(V& v) {
    for (std::size_t i = 0; i < texts.size(); ++i) v.required(kKeys.at(i), texts.at(i));
  }
};

std::map<std::string, Dictionary, std::less<>> load_all() {
  std::map<std::string, Dictionary, std::less<>> all;
  for (const auto& [language, text] : dictionary_files()) {
    auto dictionary = parse_dictionary(std::string{text}, std::string{language} + ".yaml");
    DOCENT_CHECK(dictionary.has_value());  // dictionary_test reads every file
    all.emplace(language, std::move(*dictionary));
  }
  return all;
}

}  // namespace

Result<Dictionary> parse_dictionary(const std::string& text, const std::string& name) {
  const auto file = YamlFile::parse(text, name);
  if (!file) return tl::unexpected<Error>(file.error());
  try {
    Dictionary dictionary;
    YamlReader reader{*file, file->root()};
    reader.required("articles", dictionary.articles);
    reader.required("per_character", dictionary.per_character);
    reader.required("per_sentence", dictionary.per_sentence);
    Sentences sentences{dictionary.sentences};
    reader.required("sentences", sentences);
    reader.finish();
    if (!(dictionary.per_character > 0.0)) return fail(name + ": per_character must be > 0");
    if (!(dictionary.per_sentence >= 0.0)) return fail(name + ": per_sentence must be >= 0");
    return dictionary;
  } catch (const YamlFault& fault) {
    return tl::unexpected<Error>(fault.error);
  }
}

const std::map<std::string, Dictionary, std::less<>>& dictionaries() {
  static const auto kAll = load_all();
  return kAll;
}

const Dictionary& dictionary_of(std::string_view language) {
  const auto& all = dictionaries();
  const auto found = all.find(language);
  return found != all.end() ? found->second : all.at("en");
}

}  // namespace docent::interaction
