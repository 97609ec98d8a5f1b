#include "docent/interaction/speech/dictionary.h"

#include <algorithm>
#include <utility>

#include "docent/base/check.h"
#include "docent/base/yaml.h"
#include "docent/interaction/speech/dictionary_files.h"

namespace docent::interaction {
namespace {

/// As the values of Sentence.
constexpr std::array<const char*, kSentences> kKeys{
    "waking",
    "relocalizing",
    "idle",
    "waiting",
    "tour_soon",
    "driving",
    "blocked",
    "to_point",
    "at_point",
    "at_room",
    "room",
    "hallway",
    "explaining",
    "asking",
    "going_home",
    "battery_low",
    "charging",
    "charger_occupied",
    "charger_no_current",
    "tour_announced",
    "announcement",
    "let_me_through",
    "offer_more",
    "home_again",
    "must_charge",
    "at_charger",
    "free_charger",
    "mend_charger",
    "stay_behind",
    "step_back",
    "greeting",
    "next_exhibit",
    "farewell",
    "help",
    "office_delivery",
    "office_put_in",
    "office_thanks",
    "office_empty",
    "office_tidy",
    "office_bin_full",
    "office_no_way",
    "voice_perhaps",
    "voice_not_understood",
    "attract_invitation",
    "attract_question",
    "attract_complaint",
    "attract_demand",
};

/// A sentence that has words for several moods.
struct ByMood {
  Phrasing& phrasing;
  template <class V>
  void visit(V& v) {
    const auto moods = words_of(Mood{});
    for (std::size_t i = 0; i < moods.size(); ++i) v(moods.at(i), phrasing.by_mood.at(i));
  }
};

bool has_place(const std::string& text) { return text.find("{}") != std::string::npos; }

Phrasing read_phrasing(const YamlFile& file, const YAML::Node& node, const std::string& key) {
  Phrasing phrasing;
  if (node.IsScalar()) {
    phrasing.by_mood.at(static_cast<std::size_t>(Mood::neutral)) = {node.Scalar()};
  } else {
    YamlReader reader{file, node};
    ByMood{phrasing}.visit(reader);
    reader.finish();
  }
  std::vector<std::string> all;
  for (const auto& variants : phrasing.by_mood) all.insert(all.end(), variants.begin(), variants.end());
  if (all.empty()) throw YamlFault{file.fault(node, key + " has no words")};
  for (const std::string& text : all) {
    if (text.empty()) throw YamlFault{file.fault(node, key + ": a text is empty")};
    if (has_place(text) != has_place(all.front()))
      throw YamlFault{file.fault(node, key + ": {} stands in some of its texts only")};
  }
  return phrasing;
}

void read_sentences(const YamlFile& file, const YAML::Node& node, std::array<Phrasing, kSentences>& sentences) {
  YamlReader reader{file, node};
  std::vector<YAML::Node> nodes;
  for (const char* key : kKeys) nodes.push_back(reader.node(key));
  reader.finish();
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    const YAML::Node& found = nodes.at(i);
    if (!found.IsDefined() || found.IsNull())
      throw YamlFault{file.fault(node, std::string{"missing key '"} + kKeys.at(i) + "'")};
    sentences.at(i) = read_phrasing(file, found, kKeys.at(i));
  }
}

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

const char* to_text(Sentence which) { return kKeys.at(static_cast<std::size_t>(which)); }

Result<Dictionary> parse_dictionary(const std::string& text, const std::string& name) {
  const auto file = YamlFile::parse(text, name);
  if (!file) return tl::unexpected<Error>(file.error());
  try {
    Dictionary dictionary;
    YamlReader reader{*file, file->root()};
    reader.required("articles", dictionary.articles);
    reader.required("per_character", dictionary.per_character);
    reader.required("per_sentence", dictionary.per_sentence);
    const YAML::Node sentences = reader.node("sentences");
    reader.finish();
    if (!sentences.IsDefined()) return tl::unexpected<Error>(file->fault(file->root(), "missing key 'sentences'"));
    read_sentences(*file, sentences, dictionary.sentences);
    if (!(dictionary.per_character > 0.0)) return fail(name + ": per_character must be > 0");
    if (!(dictionary.per_sentence >= 0.0)) return fail(name + ": per_sentence must be >= 0");
    return dictionary;
  } catch (const YamlFault& fault) {
    return tl::unexpected<Error>(fault.error);
  }
}

std::optional<Sentence> find_sentence(std::string_view key) {
  const auto* found = std::find(kKeys.begin(), kKeys.end(), key);
  if (found == kKeys.end()) return std::nullopt;
  return static_cast<Sentence>(found - kKeys.begin());
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
