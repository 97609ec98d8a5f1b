#include "docent/task_control/golex/checkpoint.h"

#include <nlohmann/json.hpp>

#include "docent/base/files.h"

namespace docent::task_control {

using Json = nlohmann::json;

Result<void> save_checkpoint(const std::filesystem::path& path, const ExecutiveMemory& memory, const std::string& map,
                             Survives survives) {
  const TaskOrder& order = memory.task.order;
  const Pose2& pose = order.map_from_base;
  const Json json{{"map", map},
                  {"phase", docent::to_text(memory.phase)},
                  {"item", memory.item},
                  {"finished", memory.finished},
                  {"item_began", memory.item_began.nanoseconds},
                  {"drive_began", memory.drive_began.nanoseconds},
                  {"reason", memory.reason.text()},
                  {"took_long", memory.took_long},
                  {"moved", memory.moved},
                  {"look", memory.look},
                  {"tour", memory.tour},
                  {"tour_begins", memory.tour_begins},
                  {"title", memory.task.title},
                  {"short", memory.task.short_text},
                  {"long", memory.task.long_text},
                  {"wait_s", memory.task.wait_s},
                  {"style", memory.task.style ? interaction::index_of(*memory.task.style) : -1},
                  {"order",
                   {{"id", order.id},
                    {"kind", order.kind.text()},
                    {"exhibit", order.exhibit_id},
                    {"pose", {pose.x, pose.y, pose.theta.radians()}},
                    {"language", order.language},
                    {"offer_more", order.offer_more},
                    {"tour", order.tour_id}}}};
  // Texts come from files of people: what is not UTF-8 is replaced, not fatal.
  return write_file_atomically(path, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n", survives);
}

Result<ExecutiveMemory> load_checkpoint(const std::filesystem::path& path, const std::string& map) {
  if (!std::filesystem::exists(path)) return ExecutiveMemory{};
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  try {
    const Json json = Json::parse(*text);
    if (json.at("map").get<std::string>() != map) return ExecutiveMemory{};
    ExecutiveMemory memory;
    const auto phase = parse<Phase>(json.at("phase").get<std::string>());
    if (!phase) return fail(path.string() + ": unknown phase");
    memory.phase = *phase;
    memory.item = json.at("item").get<int>();
    memory.finished = json.at("finished").get<std::vector<std::string>>();
    memory.item_began = {json.at("item_began").get<std::int64_t>()};
    memory.drive_began = {json.at("drive_began").get<std::int64_t>()};
    memory.reason = Reason::from_text(json.at("reason").get<std::string>());
    memory.took_long = json.at("took_long").get<bool>();
    memory.moved = json.at("moved").get<bool>();
    memory.look = json.at("look").get<std::string>();
    memory.tour = json.value("tour", "");
    memory.tour_begins = json.value("tour_begins", false);
    memory.task.title = json.at("title").get<std::string>();
    memory.task.short_text = json.at("short").get<std::string>();
    memory.task.long_text = json.at("long").get<std::string>();
    memory.task.wait_s = json.value("wait_s", 0.0);
    if (const int style = json.value("style", -1); style >= 0 && style < interaction::kAttractionActions)
      memory.task.style = interaction::attraction_action(style);
    const Json& order = json.at("order");
    const Json& pose = order.at("pose");
    memory.task.order = {order.at("id").get<std::string>(),
                         Word<TaskKind>{order.at("kind").get<std::string>()},
                         order.at("exhibit").get<std::string>(),
                         {pose.at(0).get<double>(), pose.at(1).get<double>(), Angle::radians(pose.at(2).get<double>())},
                         order.at("language").get<std::string>(),
                         order.at("offer_more").get<bool>(),
                         order.at("tour").get<std::string>()};
    return memory;
  } catch (const Json::exception& why) {
    return fail(path.string() + ": " + why.what());
  }
}

}  // namespace docent::task_control
