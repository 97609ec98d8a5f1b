#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "actor.h"
#include "docent/base/files.h"
#include "docent/interaction/sound/horn.h"
#include "docent/interaction/sound/melody.h"
#include "docent/modules/guide/buttons_module.h"
#include "docent/modules/web/web_module.h"
#include "docent/transport/virtual_time_bus.h"

// docent_web_stage MUSEUM_DIR STATE_DIR PORT [lost=S] [people=N] [busy] [speed=V] [talk=F] [ask=S] [horn=S]
// [buttons=PIPE] [seconds=S] [set=SECTION.KEY=VALUE …] The web module of the robot, in real time, among invented
// messages; with `buttons` also the module that reads the four buttons. Ends on SIGTERM or after `seconds`.

namespace {

volatile std::sig_atomic_t is_ended = 0;

/// A second of a soft tone, so that there is something to hear.
std::string tone() {
  constexpr std::uint32_t kRate = 8000;
  std::string samples;
  for (std::uint32_t i = 0; i < 2 * kRate; ++i) {
    const auto value = static_cast<std::int16_t>(6000.0 * std::sin(i * 0.35) * std::exp(-4.0 * (i % 4000) / 4000.0));
    samples.append(reinterpret_cast<const char*>(&value), 2);
  }
  const auto number = [](std::uint32_t value, std::size_t bytes) {
    return std::string{reinterpret_cast<const char*>(&value), bytes};
  };
  const auto size = static_cast<std::uint32_t>(samples.size());
  return "RIFF" + number(36 + size, 4) + "WAVEfmt " + number(16, 4) + number(1, 2) + number(1, 2) + number(kRate, 4) +
         number(2 * kRate, 4) + number(2, 2) + number(16, 2) + "data" + number(size, 4) + samples;
}

struct Words {
  docent::stage::Actor::Options actor;
  int people = 25;
  double end_s = 1e9;
  std::string buttons;
  std::vector<std::string> settings;  ///< over the defaults of robot.yaml
};

Words read_words(const std::vector<std::string>& given) {
  Words words;
  for (const std::string& word : given) {
    const auto value = [&word](const char* key) {
      return word.starts_with(key) ? word.substr(std::strlen(key)) : std::string{};
    };
    if (const auto text = value("lost="); !text.empty()) words.actor.lost_s = std::stod(text);
    if (const auto text = value("people="); !text.empty()) words.people = std::stoi(text);
    if (const auto text = value("speed="); !text.empty()) words.actor.speed = std::stod(text);
    if (const auto text = value("seconds="); !text.empty()) words.end_s = std::stod(text);
    if (const auto text = value("talk="); !text.empty()) words.actor.talk = std::stod(text);
    if (const auto text = value("ask="); !text.empty()) words.actor.ask_s = std::stod(text);
    if (const auto text = value("horn="); !text.empty()) words.actor.horn_s = std::stod(text);
    if (const auto text = value("buttons="); !text.empty()) words.buttons = text;
    if (const auto text = value("set="); !text.empty()) words.settings.push_back(text);
    if (word == "busy") words.actor.is_busy = true;
  }
  return words;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace docent;
  if (argc < 4) {
    std::fprintf(stderr,
                 "usage: %s MUSEUM_DIR STATE_DIR PORT [lost=S] [people=N] [busy] [speed=V] [talk=F] [ask=S] [horn=S] "
                 "[buttons=PIPE] [seconds=S] [set=SECTION.KEY=VALUE …]\n",
                 argv[0]);
    return 2;
  }
  Words words = read_words({argv + 4, argv + argc});
  const auto museum = museum::load_museum(argv[1]);
  if (!museum) return std::fprintf(stderr, "%s\n", museum.error().message.c_str()), 2;
  const std::filesystem::path state = argv[2];
  std::filesystem::create_directories(state / "audio");
  if (!write_file_atomically(state / "audio/5a5a5a5a.wav", tone())) return 2;
  if (!interaction::write_shared(interaction::horn_sound(), state / "audio")) return 2;
  const interaction::SharedSound music = interaction::shared_sound(interaction::melody_clip());
  if (!interaction::write_shared(music, state / "audio")) return 2;
  words.actor.music = music.file;
  robot::RobotConfig config;
  words.settings.push_back(std::string{"web.port="} + argv[3]);
  for (const std::string& setting : words.settings)
    if (const auto set = config.set(setting); !set) return std::fprintf(stderr, "%s\n", set.error().message.c_str()), 2;

  transport::VirtualTimeHub hub;
  Rng rng{4};
  stage::Scenery scenery{*museum, words.people, rng.stream("scenery")};
  const auto actor_bus = hub.connect("actor");
  const stage::Actor actor{*actor_bus, *museum, scenery, rng.stream("actor"), words.actor};
  const auto web_bus = hub.connect("web");
  const modules::ModuleContext context{*web_bus, *museum, config, state, 1, true};
  auto web = modules::make_web(context);
  if (!web) return std::fprintf(stderr, "%s\n", web.error().message.c_str()), 2;
  if (const auto set = config.set("buttons.device=" + words.buttons); !set) return 2;
  const auto buttons_bus = hub.connect("buttons");
  const auto pressed = modules::make_buttons({*buttons_bus, *museum, config, state, 1, false});
  if (!pressed) return std::fprintf(stderr, "%s\n", pressed.error().message.c_str()), 2;
  std::signal(SIGTERM, [](int) { is_ended = 1; });
  std::signal(SIGINT, [](int) { is_ended = 1; });
  std::printf("http://127.0.0.1:%s/\n", argv[3]);
  std::fflush(stdout);

  const auto start = std::chrono::steady_clock::now();
  while (is_ended == 0) {
    const auto now = std::chrono::steady_clock::now() - start;
    if (std::chrono::duration<double>(now).count() > words.end_s) break;
    hub.run_until(Time{std::chrono::duration_cast<std::chrono::nanoseconds>(now).count()});
    std::this_thread::sleep_for(std::chrono::milliseconds{10});
  }
  return 0;
}
