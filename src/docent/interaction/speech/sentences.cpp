#include "docent/interaction/speech/sentences.h"

#include <array>

namespace docent {
namespace {

struct Pair {
  const char* english;
  const char* german;
};

constexpr std::array<Pair, kSentences> kPairs{{
    {"Good morning! I am looking round to find out where I am.",
     "Guten Morgen! Ich schaue mich um und finde heraus, wo ich bin."},
    {"I have lost my way. One moment, I am looking round.",
     "Ich habe mich verlaufen. Einen Moment, ich schaue mich um."},
    {"I am at home and glad to show you something. Choose a tour or an exhibit!",
     "Ich bin zu Hause und zeige Ihnen gern etwas. Wählen Sie eine Führung oder ein Exponat!"},
    {"I am taking a short break. Choose a tour or an exhibit!",
     "Ich mache eine kurze Pause. Wählen Sie eine Führung oder ein Exponat!"},
    {"I am on my way to {}. Please follow me!", "Nächstes Ziel: {}. Bitte folgen Sie mir!"},
    {"I would like to go to {}, but someone is in my way.", "Nächstes Ziel: {}, aber jemand steht mir im Weg."},
    {"I am telling you about {}.", "Ich erkläre gerade: {}."},
    {"Shall I tell you more about {}, or shall we go on?", "{}: Soll ich mehr erzählen, oder gehen wir weiter?"},
    {"I am on my way home. See you soon!", "Ich fahre nach Hause. Bis bald!"},
    {"My battery is low. I need a rest.", "Meine Batterie ist fast leer. Ich brauche eine Pause."},
    {"I am charging my battery, for about {} more minutes. I keep your wishes in mind.",
     "Ich lade meine Batterie, noch etwa {} Minuten. Ihre Wünsche merke ich mir."},
    {"Please follow me to {}.", "Nächstes Ziel: {}. Bitte folgen Sie mir."},
    {"Please let me through.", "Bitte lassen Sie mich durch."},
    {"Would you like to hear more, or shall we go on?", "Möchten Sie mehr hören, oder gehen wir weiter?"},
    {"Here I am again. It was nice with you! Who would like to see something?",
     "Da bin ich wieder. Schön war es mit Ihnen! Wer möchte etwas sehen?"},
    {"I am sorry, my battery is low. I have to charge it now, and go on afterwards.",
     "Entschuldigung, meine Batterie ist fast leer. Ich muss sie jetzt laden und mache danach weiter."},
    {"Here is my charger. I am resting for a while. I keep your wishes in mind.",
     "Hier ist meine Ladestation. Ich ruhe mich eine Weile aus. Ihre Wünsche merke ich mir."},
}};

constexpr std::array<std::string_view, 2> kLanguages{"en", "de"};  // as the members of Pair

}  // namespace

std::span<const std::string_view> sentence_languages() { return kLanguages; }

std::string sentence(Sentence which, std::string_view language, std::string_view title) {
  const Pair& pair = kPairs[static_cast<std::size_t>(which)];
  std::string text = language == "de" ? pair.german : pair.english;
  const std::size_t place = text.find("{}");
  if (place == std::string::npos) return text;
  std::string name{title};
  const bool has_article = name.rfind("The ", 0) == 0 || name.rfind("A ", 0) == 0 || name.rfind("An ", 0) == 0;
  if (language != "de" && has_article) name.front() = name.front() == 'T' ? 't' : 'a';
  return text.replace(place, 2, name);
}

}  // namespace docent
