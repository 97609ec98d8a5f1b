#include "docent/simulator/scenario/eye_event.h"

#include <algorithm>
#include <array>
#include <string>

namespace docent::simulator {
namespace {

constexpr std::array<const char*, 3> kEyes{"depth", "ceiling", "front"};
constexpr std::array<const char*, 7> kEyeFaults{"gone", "frozen",   "black",    "upside_down",
                                                "late", "exposure", "lamps_off"};

template <class T, std::size_t N>
T chosen(const YamlFile& file, const YAML::Node& at, const std::string& name, const std::array<const char*, N>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<T>(found - names.begin());
  std::string known;
  for (const char* one : names) known += (known.empty() ? "" : ", ") + std::string{one};
  throw YamlFault{file.fault(at, "expected one of " + known + ", found '" + name + "'")};
}

}  // namespace

EyeFault read_eye_fault(const YamlFile& file, const YAML::Node& node) {
  constexpr double kLongestFault = 1e8, kLongestDelay = 60.0, kMostGain = 100.0;
  EyeFault event;
  std::string eye, kind;
  YamlReader reader{file, node};
  reader.required("eye", eye);
  reader.required("kind", kind);
  reader("for", event.duration);
  reader("delay", event.delay);
  reader("gain", event.gain);
  reader.finish();
  event.eye = chosen<EyeFault::Eye>(file, node["eye"], eye, kEyes);
  event.kind = chosen<EyeFault::Kind>(file, node["kind"], kind, kEyeFaults);
  if (!(event.duration >= 0.0 && event.duration <= kLongestFault))
    throw YamlFault{file.fault(node, "'for' must be from 0 to 1e8")};
  if (!(event.delay > 0.0 && event.delay <= kLongestDelay))
    throw YamlFault{file.fault(node, "'delay' must be above 0 and at most 60")};
  if (!(event.gain > 0.0 && event.gain <= kMostGain))
    throw YamlFault{file.fault(node, "'gain' must be above 0 and at most 100")};
  return event;
}

}  // namespace docent::simulator
