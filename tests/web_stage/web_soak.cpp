#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/web/web_module.h"
#include "docent/recording/recorder.h"
#include "docent/transport/virtual_time_bus.h"

// docent_web_soak RECORDING MUSEUM_DIR STATE_DIR PORT SPEED: the web module of the robot, on a recording that is played
// again and again, SPEED times faster than it was. Each second of wall time it prints the virtual time [h] and the
// memory of this program [kB]. Ends on SIGTERM.

namespace {

using docent::Duration;
using docent::Time;

volatile std::sig_atomic_t is_ended = 0;

/// What the web module publishes itself.
constexpr std::array kOurs{"docent/request", "docent/choice", "docent/votes",       "docent/steering",
                           "docent/stop",    "docent/limits", "docent/button_lamps"};

/// A message of the recording, published with its stamp moved.
class Player {
 public:
  explicit Player(docent::transport::Bus& bus) {
    docent::for_each_robot_topic([this, &bus]<class T>(const docent::Topic<T>& topic) {
      publish_[topic.name] = [publisher = bus.publisher(topic)](const std::shared_ptr<const void>& message,
                                                                Duration later) {
        T moved = *static_cast<const T*>(message.get());
        if constexpr (requires { moved.header.stamp; })
          moved.header.stamp = docent::to_message(docent::from_message(moved.header.stamp) + later);
        publisher.publish(std::move(moved));
      };
    });
  }
  void publish(const docent::recording::RecordedMessage& message, Duration later) const {
    const auto place = publish_.find(message.topic.name);
    if (place != publish_.end()) place->second(message.message, later);
  }

 private:
  std::map<std::string, std::function<void(const std::shared_ptr<const void>&, Duration)>, std::less<>> publish_;
};

long resident_kb() {
  std::ifstream status{"/proc/self/statm"};
  long whole = 0;
  long resident = 0;
  status >> whole >> resident;
  return resident * 4;
}

std::vector<docent::recording::RecordedMessage> messages_of(const std::string& path) {
  std::vector<docent::recording::RecordedMessage> messages;
  auto reader = docent::recording::McapReader::open(path);
  if (!reader) return messages;
  (void)docent::recording::read_recording(*reader, {}, [&](const docent::recording::RecordedMessage& message) {
    for (const std::string_view ours : kOurs)
      if (message.topic.name == ours) return true;
    messages.push_back(message);
    return true;
  });
  return messages;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace docent;
  if (argc != 6) {
    std::fprintf(stderr, "usage: %s RECORDING MUSEUM_DIR STATE_DIR PORT SPEED\n", argv[0]);
    return 2;
  }
  const auto messages = messages_of(argv[1]);
  if (messages.size() < 2) return std::fprintf(stderr, "%s: no recording\n", argv[1]), 2;
  const auto museum = museum::load_museum(argv[2]);
  if (!museum) return std::fprintf(stderr, "%s\n", museum.error().message.c_str()), 2;
  const std::filesystem::path state = argv[3];
  std::filesystem::create_directories(state / "audio");
  robot::RobotConfig config;
  if (!config.set(std::string{"web.port="} + argv[4])) return 2;
  const double speed = std::stod(argv[5]);

  transport::VirtualTimeHub hub;
  const auto bus = hub.connect("recording");
  const Player player{*bus};
  const auto web_bus = hub.connect("web");
  auto web = modules::make_web({*web_bus, *museum, config, state, 1, true});
  if (!web) return std::fprintf(stderr, "%s\n", web.error().message.c_str()), 2;
  std::signal(SIGTERM, [](int) { is_ended = 1; });
  std::signal(SIGINT, [](int) { is_ended = 1; });
  std::printf("http://127.0.0.1:%s/\n", argv[4]);
  std::fflush(stdout);

  const Duration length = messages.back().time - messages.front().time;
  Duration later = Time{} - messages.front().time + Duration{std::chrono::seconds{1}};
  const auto start = std::chrono::steady_clock::now();
  auto told = start;
  for (std::size_t i = 0; is_ended == 0;) {
    const auto now = std::chrono::steady_clock::now();
    const Time until = Time{} + seconds(speed * std::chrono::duration<double>(now - start).count());
    for (; messages[i].time + later <= until && is_ended == 0;) {
      hub.run_until(messages[i].time + later);
      player.publish(messages[i], later);
      if (++i < messages.size()) continue;
      i = 0;
      later = later + length + Duration{std::chrono::milliseconds{100}};
    }
    hub.run_until(until);
    if (now - told >= std::chrono::seconds{1}) {
      told = now;
      std::printf("%.3f %ld\n", to_seconds(hub.now()) / 3600.0, resident_kb());
      std::fflush(stdout);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds{1});
  }
  return 0;
}
