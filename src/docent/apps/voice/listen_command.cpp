#include "docent/apps/voice/listen_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/apps/shared/map_note.h"
#include "docent/interaction/sound/sound_file.h"
#include "docent/interaction/voice/voice_recognizer.h"
#include "docent/museum/museum.h"

namespace docent::apps::listen_command {
namespace {

struct Options {
  std::string museum = default_museum();
  std::vector<std::string> recordings;
  interaction::VoiceParams params;
};

std::string meant(const interaction::HeardVoice& heard) {
  if (heard.verdict == interaction::HeardVoice::Verdict::nothing) return "no command";
  std::string text = to_text(heard.command->kind);
  if (!heard.command->target.empty()) text += " " + heard.command->target;
  return heard.verdict == interaction::HeardVoice::Verdict::perhaps ? "perhaps " + text : text;
}

void listen(const Options& options) {
  const auto museum = load_museum_and_say(options.museum);
  auto recognizer =
      value_or_fail(interaction::VoiceRecognizer::create(interaction::VoiceGrammar{museum}, options.params));
  for (const std::string& recording : options.recordings) {
    const auto heard = value_or_fail(recognizer.hear(value_or_fail(interaction::read_clip(recording))));
    std::printf("%s: %s", recording.c_str(), meant(heard).c_str());
    if (!heard.words.empty()) std::printf(" (\"%s\", confidence %.1f)", heard.words.c_str(), heard.confidence);
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace

void add_listen_command(CLI::App& app) {
  auto* command = app.add_subcommand("listen", "Say what the robot would understand of recorded commands, in English");
  auto options = std::make_shared<Options>();
  command->add_option("recordings", options->recordings, "WAV, Ogg or FLAC files, of one utterance each")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--museum", options->museum, "Museum folder whose names may be said")->capture_default_str();
  command->add_option("--model", options->params.model, "Folder of the model of the language")->capture_default_str();
  command->add_option("--acts-above", options->params.acts_above, "Confidence above which a command is understood")
      ->capture_default_str();
  command
      ->add_option("--asks-above", options->params.asks_above,
                   "Confidence above which the robot asks back: \"perhaps\"")
      ->capture_default_str();
  command->callback([options] { listen(*options); });
}

}  // namespace docent::apps::listen_command
