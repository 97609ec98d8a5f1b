#include "docent/interaction/speech/speaker.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "docent/base/check.h"
#include "docent/base/files.h"

namespace docent::interaction {

using Json = nlohmann::json;

Speaker::Speaker(SpeakerMemory memory, Time now) : memory_{std::move(memory)} {
  if (memory_.present.is_speaking && memory_.present.start > now) memory_.present.is_speaking = false;
  finish_if_over(now);
}

Speaker::Verdict Speaker::judge(const Say& say) const {
  if (expected_ && expected_->id == say.id) return Verdict::under_way;
  if (memory_.present.id == say.id) return memory_.present.is_speaking ? Verdict::under_way : Verdict::finished;
  const auto& finished = memory_.finished;
  return std::find(finished.begin(), finished.end(), say.id) != finished.end() ? Verdict::finished : Verdict::fresh;
}

void Speaker::expect(const Say& say) { expected_ = say; }

void Speaker::begin(double duration_s, const std::string& audio, Time now) {
  DOCENT_CHECK(expected_.has_value());
  retire();
  const Say say = *std::exchange(expected_, std::nullopt);
  memory_.present = {say.id, say.text, say.language, say.mood, true, now, duration_s, audio};
}

bool Speaker::finish_if_over(Time now) {
  Speech& present = memory_.present;
  if (!present.is_speaking || now < present.start + seconds(present.duration_s)) return false;
  present.is_speaking = false;
  return true;
}

void Speaker::retire() {
  if (memory_.present.id.empty()) return;
  memory_.finished.push_back(memory_.present.id);
  if (memory_.finished.size() > kRemembered) memory_.finished.pop_front();
}

Result<void> save_checkpoint(const std::filesystem::path& path, const SpeakerMemory& memory, Survives survives) {
  const Speech& present = memory.present;
  const Json json{{"id", present.id},
                  {"text", present.text},
                  {"language", present.language},
                  {"mood", to_text(present.mood)},
                  {"is_speaking", present.is_speaking},
                  {"start", present.start.nanoseconds},
                  {"duration_s", present.duration_s},
                  {"audio", present.audio},
                  {"finished", memory.finished}};
  return write_file_atomically(path, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n", survives);
}

Result<SpeakerMemory> load_speaker_checkpoint(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return SpeakerMemory{};
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  try {
    const Json json = Json::parse(*text);
    SpeakerMemory memory;
    memory.present = {
        json.at("id").get<std::string>(),       json.at("text").get<std::string>(),
        json.at("language").get<std::string>(), parse<Mood>(json.at("mood").get<std::string>()).value_or(Mood::neutral),
        json.at("is_speaking").get<bool>(),     {json.at("start").get<std::int64_t>()},
        json.at("duration_s").get<double>(),    json.at("audio").get<std::string>()};
    memory.finished = json.at("finished").get<std::deque<std::string>>();
    return memory;
  } catch (const Json::exception& why) {
    return fail(path.string() + ": " + why.what());
  }
}

}  // namespace docent::interaction
