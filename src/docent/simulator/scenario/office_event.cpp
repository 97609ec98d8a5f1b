#include "docent/simulator/scenario/office_event.h"

#include <algorithm>
#include <array>

namespace docent::simulator {
namespace {

constexpr std::array<const char*, 5> kOfficeEvents{"deliver", "tidy", "confirm", "stop", "helper"};

}  // namespace

const char* to_text(OfficeEvent::Kind kind) { return kOfficeEvents.at(static_cast<std::size_t>(kind)); }

OfficeEvent read_office_event(const YamlFile& file, const YAML::Node& node) {
  constexpr double kSlowest = 600.0;  // [s]
  OfficeEvent event;
  std::string kind;
  YamlReader reader{file, node};
  reader.required("kind", kind);
  reader("room", event.room);
  reader("after", event.after);
  reader.finish();
  const auto* const found = std::find(kOfficeEvents.begin(), kOfficeEvents.end(), kind);
  if (found == kOfficeEvents.end())
    throw YamlFault{
        file.fault(node["kind"], "expected one of deliver, tidy, confirm, stop, helper, found '" + kind + "'")};
  event.kind = static_cast<OfficeEvent::Kind>(found - kOfficeEvents.begin());
  if (event.kind == OfficeEvent::Kind::deliver && event.room.empty())
    throw YamlFault{file.fault(node, "'deliver' needs a room")};
  if (!(event.after > 0.0 && event.after <= kSlowest))
    throw YamlFault{file.fault(node, "'after' must be above 0 and at most 600")};
  return event;
}

}  // namespace docent::simulator
