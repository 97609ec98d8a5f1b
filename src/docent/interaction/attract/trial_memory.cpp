#include "docent/interaction/attract/trial_memory.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace docent::interaction {
namespace {

using Json = nlohmann::json;

constexpr double kMostReward = 1e6;   // of any phase
constexpr double kMostDensity = 1e3;  // [1/m2] of any crowd
constexpr double kRounding = 1e-6;    // of chances that were written and read

struct Unfit {
  std::string what;
};

template <class E>
E word_of(const Json& json, const char* key) {
  const auto value = parse<E>(json.at(key).get_ref<const std::string&>());
  if (!value) throw Unfit{std::string{"no such "} + key};
  return *value;
}

double number_of(const Json& json, const char* key, double least, double most) {
  const double value = json.at(key).get<double>();
  if (!(value >= least && value <= most)) throw Unfit{std::string{key} + " is beyond its bounds"};
  return value;
}

AttractionTrial trial_of(const Json& json) {
  AttractionTrial trial;
  if (!json.at("begin").is_number_integer()) throw Unfit{"begin is no time"};
  trial.begin = {json.at("begin").get<std::int64_t>()};
  trial.density = number_of(json, "density", 0.0, kMostDensity);
  trial.action = {word_of<GazeStrategy>(json, "gaze"), word_of<Mood>(json, "face"), word_of<SpeechAct>(json, "speech")};
  trial.reward = number_of(json, "reward", -kMostReward, kMostReward);
  const Json& chances = json.at("chances");
  if (!chances.is_array() || chances.size() != trial.chances.size())
    throw Unfit{"chances are not those of five styles"};
  double sum = 0.0;
  for (std::size_t i = 0; i < trial.chances.size(); ++i) {
    trial.chances.at(i) = chances[i].get<double>();
    if (!(trial.chances.at(i) >= 0.0)) throw Unfit{"chances has one below 0"};
    sum += trial.chances.at(i);
  }
  if (!(std::abs(sum - 1.0) <= kRounding)) throw Unfit{"chances do not add up to 1"};
  if (!(trial.chances.at(static_cast<std::size_t>(style_of(trial.action))) > 0.0))
    throw Unfit{"the style had no chance to be drawn"};
  return trial;
}

}  // namespace

Result<void> save_trials(const std::filesystem::path& path, const TrialMemory& trials, Survives survives) {
  Json rows = Json::array();
  for (const AttractionTrial& trial : trials)
    rows.push_back({{"begin", trial.begin.nanoseconds},
                    {"density", trial.density},
                    {"gaze", to_text(trial.action.gaze)},
                    {"face", to_text(trial.action.face)},
                    {"speech", to_text(trial.action.speech)},
                    {"chances", trial.chances},
                    {"reward", trial.reward}});
  std::string text = "{\"trials\": [";
  for (std::size_t i = 0; i < rows.size(); ++i) text += (i == 0 ? "\n" : ",\n") + rows[i].dump();
  return write_file_atomically(path, text + "\n]}\n", survives);
}

Result<TrialMemory> parse_trials(const std::string& text, const std::string& name) {
  try {
    const Json json = Json::parse(text);
    const Json& rows = json.at("trials");
    if (!rows.is_array() || rows.size() > kMostTrials) throw Unfit{"trials is no list that a memory can have"};
    TrialMemory trials;
    trials.reserve(rows.size());
    for (const Json& row : rows) {
      try {
        trials.push_back(trial_of(row));
      } catch (const Unfit& unfit) {
        throw Unfit{"trial " + std::to_string(trials.size() + 1) + ": " + unfit.what};
      }
    }
    return trials;
  } catch (const Unfit& unfit) {
    return fail(name + ": " + unfit.what);
  } catch (const Json::exception& why) {
    return fail(name + ": " + why.what());
  }
}

Result<TrialMemory> load_trials(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return TrialMemory{};
  const auto text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse_trials(*text, path.string());
}

}  // namespace docent::interaction
