#include "docent/modules/shared/stop_keeper.h"

#include <system_error>
#include <utility>

#include "docent/base/files.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"

namespace docent::modules {
namespace {

constexpr Duration kTick = std::chrono::milliseconds{100};
/// All keepers speak on one topic, and answer one another within a millisecond: a reader that keeps the newest word
/// alone, as that of any other state does, would lose what one said when the next one speaks, and the stop would wait
/// for the next repetition.
constexpr Topic<docent_msgs::Stop> kWords{topics::kStop.name, topics::kStop.qos, 32};

StopRegister::Word word_of(const docent_msgs::Stop& stop) {
  return {{stop.number, stop.is_stopped, stop.by}, stop.is_sure};
}

/// Where the file cannot be read, the robot is taken for stopped: somebody has to look anyway.
StopState read_kept(const std::filesystem::path& file, std::string& fault) {
  std::error_code none;
  if (file.empty() || !std::filesystem::exists(file, none)) return {};
  const auto line = read_file(file);
  const auto state = line ? stop_state_of(*line) : tl::unexpected<Error>(line.error());
  if (state) return *state;
  fault = (line ? file.string() + ": " : std::string{}) + state.error().message + "; the robot stays stopped";
  return {0, true, file.filename().string()};
}

/// Empty: nothing is kept.
std::filesystem::path file_of(const std::filesystem::path& state, const std::string& name) {
  if (state.empty()) return {};
  std::error_code none;  // where there can be no folder, the writer says so
  std::filesystem::create_directories(state / "stops", none);
  return state / "stops" / name.substr(0, name.find('/'));
}

}  // namespace

StopKeeper::StopKeeper(const ModuleContext& context, std::string name, std::function<void()> changed)
    : bus_{context.bus},
      file_{file_of(context.state, name)},
      register_{std::move(name), read_kept(file_, read_fault_), bus_.now()},
      kept_{register_.state()},
      changed_{std::move(changed)},
      says_{bus_.publisher(kWords)} {
  bus_.subscribe<docent_msgs::Stop>(kWords, [this](const docent_msgs::Stop& stop) { hear(stop); });
  bus_.every(kTick, [this] { tell(); });
  tell();
}

void StopKeeper::hear(const docent_msgs::Stop& stop) {
  register_.hear(stop.keeper, word_of(stop), bus_.now());
  tell();  // what it has heard is told at once: somebody waits until enough keepers hold it
}

void StopKeeper::tell() {
  const Time now = bus_.now();
  if (const auto word = register_.say(now))
    says_.publish({{to_message(now), ""},
                   word->state.is_stopped,
                   word->state.by,
                   word->state.number,
                   word->is_sure,
                   register_.name()});
  keep();
  if (std::exchange(held_, holds()) != held_ && changed_) changed_();
}

void StopKeeper::keep() {
  if (register_.state() == kept_) return;
  kept_ = register_.state();
  if (!file_.empty()) writer_.write(file_, to_line(kept_));
}

ModuleHealth StopKeeper::health() const {
  if (!register_.is_sure(bus_.now())) return {"starting", "asks whether the robot is stopped"};
  if (!read_fault_.empty()) return {"degraded", read_fault_};
  if (auto fault = writer_.fault(); !fault.empty()) return {"degraded", std::move(fault)};
  return {};
}

bool StopView::see(const docent_msgs::Stop& stop) {
  const StopState state = word_of(stop).state;
  if (overrules(state, state_)) state_ = state;
  return state_.is_stopped;
}

}  // namespace docent::modules
