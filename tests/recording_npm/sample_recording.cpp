// docent_sample_recording FILE.mcap EXPECTED.json: every topic several times with random content, and beside it what a
// reader must find.

#include <cstdio>
#include <nlohmann/json.hpp>

#include "docent/base/files.h"
#include "docent/messages/random_message.h"
#include "docent/recording/recorder.h"

namespace docent {
namespace {

constexpr int kRounds = 30;

/// Any message as JSON; 64-bit integers as texts, because JavaScript's numbers end at 2^53.
struct JsonVisitor {
  nlohmann::ordered_json& json;
  template <class T>
  void operator()(const char* name, const T& field) {
    json[name] = value(field);
  }
  template <class T>
  static nlohmann::ordered_json value(const T& field) {
    if constexpr (Message<T>) {
      nlohmann::ordered_json inner = nlohmann::ordered_json::object();
      JsonVisitor visitor{inner};
      T::visit(field, visitor);
      return inner;
    } else if constexpr (std::is_same_v<T, std::int64_t> || std::is_same_v<T, std::uint64_t>) {
      return std::to_string(field);
    } else {
      return field;
    }
  }
  template <class T>
  static nlohmann::ordered_json value(const std::vector<T>& items) {
    return list(items);
  }
  template <class T, std::size_t N>
  static nlohmann::ordered_json value(const std::array<T, N>& items) {
    return list(items);
  }
  template <class List>
  static nlohmann::ordered_json list(const List& items) {
    nlohmann::ordered_json result = nlohmann::ordered_json::array();
    for (const auto& item : items) result.push_back(value(item));
    return result;
  }
};

int write_sample(const std::string& file, const std::string& expected_file) {
  recording::McapWriterOptions options;
  options.chunk_bytes = 50000;
  auto recorder = recording::Recorder::create(file, options);
  if (!recorder) return std::fprintf(stderr, "%s\n", recorder.error().message.c_str()), 1;
  nlohmann::ordered_json expected = nlohmann::ordered_json::array();
  std::int64_t time = 1'700'000'000'000'000'000;
  bool is_good = true;
  for (int round = 0; round < kRounds; ++round) {
    const auto write = [&]<class T>(const Topic<T>& topic) {
      T message = random_message<T>(static_cast<std::uint64_t>(time));
      // Sizes of real messages now and then, and what is easily broken: fractions, signs, letters beyond ASCII.
      if constexpr (std::is_same_v<T, sensor_msgs::LaserScan>) {
        message.ranges.assign(180, 3.7F);
        message.angle_min = -1.5707963F;
      }
      if constexpr (std::is_same_v<T, docent_msgs::Say>) message.text = "Größe: „über” 5 m — schön";
      time += 10'000'000;
      nlohmann::ordered_json json;
      JsonVisitor visitor{json};
      T::visit(std::as_const(message), visitor);
      expected.push_back({{"topic", std::string{"/"} + topic.name},
                          {"type", T::kType},
                          {"log_time", std::to_string(time)},
                          {"message", std::move(json)}});
      is_good =
          is_good && recorder->write(transport::topic_info(topic), Time{time}, std::make_shared<const T>(message));
    };
    for_each_robot_topic(write);
    for_each_truth_topic(write);
  }
  is_good = is_good && recorder->close() && write_file_atomically(expected_file, expected.dump());
  return is_good ? 0 : 1;
}

}  // namespace
}  // namespace docent

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: docent_sample_recording FILE.mcap EXPECTED.json\n"), 2;
  return docent::write_sample(argv[1], argv[2]);
}
