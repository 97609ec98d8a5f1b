#include "docent/museum/editing/museum_setup.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "docent/base/files.h"
#include "docent/base/yaml.h"
#include "docent/museum/editing/museum_founding.h"
#include "docent/museum/editing/museum_text.h"
#include "docent/museum/editing/museum_workshop.h"
#include "docent/museum/place_yaml.h"

namespace docent::museum {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgressFile = "setup.yaml";

Result<void> write_progress(const fs::path& folder, const MuseumSetup::Progress& progress) {
  return write_file_atomically(folder / kProgressFile,
                               std::string{"# How far docent setup has come; it goes on here.\n"} +
                                   "step: " + to_text(progress.step) + "\nstart: " + yaml_of(progress.start) + "\n");
}

std::string name_of(const Museum& museum) { return translated(museum.name, museum.languages.front()); }

}  // namespace

MuseumSetup::MuseumSetup(fs::path folder, const fs::path& state, const CheckedRobot& robot)
    : folder_{std::move(folder)},
      explored_{state / "explored"},
      explorers_pose_{state / "explore.yaml"},
      robot_{robot} {}

Result<MuseumSetup::Progress> MuseumSetup::begin(const fs::path& folder, const Pose2& start) {
  std::error_code error;
  if (fs::exists(folder / kProgressFile, error)) return read(folder);
  if (fs::exists(folder / kMuseumFile, error))
    return fail(folder.string() + ": this museum is there already; docent up opens it, and its page /operate edits it");
  if (fs::exists(folder, error) && !fs::is_empty(folder, error))
    return fail(folder.string() + ": is neither empty nor a museum that docent setup has begun");
  if (auto founded = found_museum(folder, {folder.filename().string(), {"en"}, start, {}, {}}); !founded)
    return tl::unexpected<Error>(founded.error());
  const Progress progress{SetupStep::name, start};
  if (auto written = write_progress(folder, progress); !written) return tl::unexpected<Error>(written.error());
  return progress;
}

Result<MuseumSetup::Progress> MuseumSetup::read(const fs::path& folder) {
  const auto file = YamlFile::load(folder / kProgressFile);
  if (!file) return tl::unexpected<Error>(file.error());
  try {
    YamlReader reader{*file, file->root()};
    std::string step;
    reader.required("step", step);
    const YAML::Node start = reader.node("start");
    reader.finish();
    const auto known = parse<SetupStep>(step);
    if (!known) return tl::unexpected<Error>(file->fault(file->root()["step"], "unknown step '" + step + "'"));
    if (!start.IsDefined()) return tl::unexpected<Error>(file->fault(file->root(), "missing key 'start'"));
    PoseYaml pose;
    YamlReader start_reader{*file, start};
    pose.visit(start_reader);
    start_reader.finish();
    return Progress{*known, pose.pose()};
  } catch (const YamlFault& fault) {
    return tl::unexpected<Error>(fault.error);
  } catch (const YAML::Exception& exception) {
    return fail((folder / kProgressFile).string() + ": " + exception.what());
  }
}

Result<void> MuseumSetup::write(const Progress& progress) const { return write_progress(folder_, progress); }

Result<void> MuseumSetup::name(const std::string& name, const std::vector<std::string>& languages) const {
  auto progress = read();
  if (!progress) return tl::unexpected<Error>(progress.error());
  if (work_of(progress->step) != SetupWork::map) return fail("the museum has a map already");
  if (auto founded = found_museum(folder_, {name, languages, progress->start, {}, {}}); !founded) return founded;
  progress->step = SetupStep::map;
  return write(*progress);
}

Result<void> MuseumSetup::keep_map() const {
  auto progress = read();
  if (!progress) return tl::unexpected<Error>(progress.error());
  if (progress->step != SetupStep::map) return fail("no map is being made");
  auto map = load_map(explored_ / "map.yaml");
  if (!map) return fail("the robot has not made a map yet: " + map.error().message);
  const auto museum = load_museum(folder_, Stage::being_set_up);
  if (!museum) return tl::unexpected<Error>(museum.error());
  const Founding founding{name_of(*museum), museum->languages, progress->start, museum->hazards, std::move(*map)};
  if (auto founded = found_museum(folder_, founding); !founded) return founded;
  progress->step = SetupStep::hazards;
  return write(*progress);
}

bool MuseumSetup::has_explored() const {
  std::error_code ignored;
  return fs::is_regular_file(explored_ / "map.yaml", ignored);
}

Result<void> MuseumSetup::map_again(std::optional<Pose2> start) const {
  auto progress = read();
  if (!progress) return tl::unexpected<Error>(progress.error());
  const auto museum = load_museum(folder_, Stage::being_set_up);
  if (!museum) return tl::unexpected<Error>(museum.error());
  std::error_code ignored;
  if (!start && work_of(progress->step) == SetupWork::map) {
    start = progress->start;
  } else {
    fs::remove(explorers_pose_, ignored);  // another frame begins
  }
  const Pose2 begin = start.value_or(Pose2{});
  if (auto founded = found_museum(folder_, {name_of(*museum), museum->languages, begin, {}, {}}); !founded)
    return founded;
  fs::remove_all(explored_, ignored);  // what lies there is of the time before
  return write({std::min(progress->step, SetupStep::map), begin});
}

Result<std::vector<std::string>> MuseumSetup::go(SetupStep step) const {
  auto progress = read();
  if (!progress) return tl::unexpected<Error>(progress.error());
  const bool has_map = work_of(progress->step) != SetupWork::map;
  const bool wants_map = work_of(step) != SetupWork::map;
  if (has_map && !wants_map) return std::vector<std::string>{"another map forgets hazards and exhibits: ask for it"};
  if (!has_map && wants_map) return std::vector<std::string>{"the museum has no map yet"};
  if (step == SetupStep::done && progress->step < SetupStep::tour)
    return std::vector<std::string>{"the robot has not given its first tour yet"};
  if (step >= SetupStep::tour) {
    auto faults = sentences_of(check_museum(folder_, robot_));
    if (!faults.empty()) return faults;
  }
  progress->step = step;
  if (auto written = write(*progress); !written) return tl::unexpected<Error>(written.error());
  return std::vector<std::string>{};
}

}  // namespace docent::museum
