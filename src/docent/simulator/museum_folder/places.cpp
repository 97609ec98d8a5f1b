#include "docent/simulator/museum_folder/places.h"

#include <algorithm>
#include <set>

#include "docent/base/yaml.h"

namespace docent::simulator {

namespace {

constexpr double kGlassTop = 1.9;   // [m]
constexpr double kPlateTop = 0.02;  // [m]
constexpr double kLowTop = 0.3;     // [m] too low for the lasers

/// A place as museum.yaml writes it.
struct PlaceText {
  double x = 0.0, y = 0.0;  ///< [m]
  double heading = 0.0;     ///< [deg]
};

class PlacesReader {
 public:
  explicit PlacesReader(const YamlFile& file) : file_{file} {}

  Places read() {
    YamlReader reader{file_, file_.root()};
    reader("languages", places_.languages);
    const YAML::Node home = reader.node("home");
    const YAML::Node charger = reader.node("charger");
    const YAML::Node exhibits = reader.node("exhibits");
    const YAML::Node hazards = reader.node("hazards");
    reader.finish();
    if (places_.languages.empty()) fault(file_.root(), "languages: name one at least");
    if (home.IsDefined()) places_.home = pose(home);
    if (charger.IsDefined()) places_.charger = pose(charger);
    if (!exhibits.IsDefined() || !exhibits.IsSequence() || exhibits.size() < 2)
      fault(exhibits.IsDefined() ? exhibits : file_.root(), "exhibits: expected a list of two or more");
    for (const auto& entry : exhibits) read_stop(entry);
    if (hazards.IsDefined() && !hazards.IsNull()) {
      if (!hazards.IsSequence()) fault(hazards, "hazards: expected a list");
      for (const auto& entry : hazards) read_hazard(entry);
    }
    return std::move(places_);
  }

 private:
  [[noreturn]] void fault(const YAML::Node& at, const std::string& what) const {
    throw YamlFault{file_.fault(at, what)};
  }

  PlaceText place(const YAML::Node& node, bool has_heading) const {
    PlaceText text;
    YamlReader reader{file_, node};
    reader.required("x", text.x);
    reader.required("y", text.y);
    if (has_heading) reader.required("heading", text.heading);
    reader.finish();
    return text;
  }
  Pose2 pose(const YAML::Node& node) const {
    const PlaceText text = place(node, true);
    return {text.x, text.y, Angle::degrees(text.heading)};
  }

  std::string read_id(const YAML::Node& at, const std::string& id) {
    const bool is_fit = !id.empty() && std::all_of(id.begin(), id.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    });
    if (!is_fit) fault(at, "id '" + id + "': expected small letters, digits and '-'");
    if (!ids_.insert(id).second) fault(at, "id '" + id + "' stands here twice");
    return id;
  }

  /// A text in every language of the file; empty where the key is absent.
  std::map<std::string, std::string> texts(const YAML::Node& entry, const YAML::Node& node,
                                           const std::string& key) const {
    std::map<std::string, std::string> result;
    if (!node.IsDefined()) return result;
    if (!node.IsMap()) fault(node, key + ": expected a text for each language, as {en: …}");
    for (const std::string& language : places_.languages) {
      if (!node[language].IsDefined()) fault(entry, key + ": nothing in '" + language + "'");
      result[language] = node[language].as<std::string>("");
    }
    if (node.size() != result.size()) fault(node, key + ": a language that is not among `languages`");
    return result;
  }

  void read_stop(const YAML::Node& entry) {
    Stop stop;
    std::string id;
    YamlReader reader{file_, entry};
    reader.required("id", id);
    const YAML::Node title = reader.node("title");
    const YAML::Node text = reader.node("text");
    const YAML::Node at = reader.node("pose");
    const YAML::Node look_at = reader.node("look_at");
    reader.finish();
    stop.id = read_id(entry, id);
    stop.title = texts(entry, title, "title");
    stop.text = texts(entry, text, "text");
    if (!at.IsDefined()) fault(entry, "exhibit '" + id + "': no pose");
    stop.pose = pose(at);
    stop.look_at = stop.pose * Point2{1.0, 0.0};
    if (look_at.IsDefined()) {
      const PlaceText there = place(look_at, false);
      stop.look_at = {there.x, there.y};
    }
    places_.stops.push_back(std::move(stop));
  }

  void read_hazard(const YAML::Node& entry) {
    Solid solid;
    std::string id;
    std::string kind;
    std::vector<std::vector<double>> corners;
    YamlReader reader{file_, entry};
    reader.required("id", id);
    reader.required("kind", kind);
    reader.required("polygon", corners);
    reader.finish();
    solid.id = read_id(entry, id);
    for (const auto& corner : corners) {
      if (corner.size() != 2) fault(entry, "hazard '" + id + "': a corner is [x, y]");
      solid.polygon.push_back({corner[0], corner[1]});
    }
    if (solid.polygon.size() < 3 || !is_simple(solid.polygon))
      fault(entry, "hazard '" + id + "': expected a polygon of three corners or more whose sides do not cross");
    if (signed_area(solid.polygon) < 0.0) std::reverse(solid.polygon.begin(), solid.polygon.end());
    if (kind == "glass") {
      solid.kind = SolidKind::glass;
      solid.top = kGlassTop;
    } else if (kind == "plate") {
      solid.kind = SolidKind::plate;
      solid.top = kPlateTop;
    } else if (kind == "stairs") {
      solid.kind = SolidKind::stairs;
      solid.top = 0.0;
    } else if (kind == "other") {
      solid.kind = SolidKind::furniture;
      solid.top = kLowTop;
    } else {
      fault(entry, "hazard '" + id + "': unknown kind '" + kind + "' (glass, plate, stairs, other)");
    }
    places_.hazards.push_back(std::move(solid));
  }

  const YamlFile& file_;
  Places places_;
  std::set<std::string> ids_;
};

}  // namespace

Result<Places> load_places(const std::filesystem::path& path) {
  auto file = YamlFile::load(path);
  if (!file) return tl::unexpected<Error>(file.error());
  try {
    return PlacesReader{*file}.read();
  } catch (const YamlFault& fault) {
    return tl::unexpected<Error>(fault.error);
  }
}

}  // namespace docent::simulator
