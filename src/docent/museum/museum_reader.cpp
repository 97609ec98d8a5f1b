#include "docent/museum/museum_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>

#include "docent/base/suggestion.h"
#include "docent/museum/day_plan.h"
#include "docent/museum/languages.h"
#include "docent/museum/museum_fields.h"
#include "docent/museum/scene_camera_yaml.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::museum {
namespace {

constexpr std::size_t kLongestText = std::size_t{16} * 1024;  // [bytes]; about 20 minutes of speech
constexpr std::size_t kLongestUrl = 2000;

class MuseumYamlReader : MuseumFields {
 public:
  MuseumYamlReader(const YamlFile& file, const ReadText& read_text, MuseumSource& source)
      : MuseumFields{file}, read_text_{read_text}, source_{source}, museum_{source.museum} {}

  void read() {
    guarded([&] {
      YamlReader reader{file(), file().root()};
      const YAML::Node name = reader.node("name");
      const YAML::Node languages = reader.node("languages");
      const YAML::Node area = reader.node("area");
      const YAML::Node hazards = reader.node("hazards");
      const YAML::Node home = reader.node("home");
      const YAML::Node charger = reader.node("charger");
      const YAML::Node exhibits = reader.node("exhibits");
      const YAML::Node modes = reader.node("modes");
      const YAML::Node tours = reader.node("tours");
      const YAML::Node rooms = reader.node("rooms");
      const YAML::Node sound = reader.node("sound");
      guarded([&] {
        read_languages(languages);
        knows_languages_ = true;
      });
      guarded([&] { museum_.name = translations(required(file().root(), name, "name"), "name"); });
      std::string map;
      guarded([&] {
        reader.required("map", map);
        museum_.map_path = inside_folder(reader.node("map"), map);
      });
      guarded([&] { museum_.area = polygon(required(file().root(), area, "area")); });
      read_hazards(hazards);
      guarded([&] { museum_.home = pose(required(file().root(), home, "home")); });
      if (charger.IsDefined()) guarded([&] { museum_.charger = pose(charger); });
      guarded([&] { read_exhibits(required(file().root(), exhibits, "exhibits")); });
      const std::size_t before = source_.faults.size();
      read_modes(modes);
      knows_hours_ = source_.faults.size() == before;
      read_list(tours, "tours", &MuseumYamlReader::read_tour);
      read_list(rooms, "rooms", &MuseumYamlReader::read_room);
      guarded([&] { museum_.scene_camera = read_scene_camera(file(), reader); });
      if (sound.IsDefined()) guarded([&] { read_sound(sound); });
      std::optional<std::string> simulation;
      guarded([&] {
        reader("simulation", simulation);
        if (simulation) museum_.simulation_path = inside_folder(reader.node("simulation"), *simulation);
      });
      guarded([&] { reader.finish(); });
      missing_.tell(file(), languages, source_);
    });
  }

 private:
  template <class F>
  void guarded(F&& f) {
    try {
      f();
    } catch (const YamlFault& fault) {
      source_.faults.push_back(fault.error);
    } catch (const YAML::Exception& exception) {
      source_.faults.push_back(
          Error{file().name() + ":" + std::to_string(exception.mark.line + 1) + ": " + exception.msg});
    }
  }
  void report(const YAML::Node& at, const std::string& what) { source_.faults.push_back(file().fault(at, what)); }
  void read_languages(const YAML::Node& node) {
    for (const auto& entry : list(required(file().root(), node, "languages"), "languages")) {
      const std::string language = text(entry, "a language");
      if (!is_language(language)) {
        throw fault(entry, "unknown language '" + language + "' (two letters of ISO 639-1, such as en, de)");
      }
      if (knows(language)) throw fault(entry, "language '" + language + "' stands twice");
      museum_.languages.push_back(language);
    }
    if (museum_.languages.empty()) throw fault(node, "needs at least one language");
  }
  [[nodiscard]] bool knows(const std::string& language) const {
    return std::find(museum_.languages.begin(), museum_.languages.end(), language) != museum_.languages.end();
  }

  /// Why `value` cannot be the text in `language` beside those in `others`; empty when it can.
  [[nodiscard]] std::string text_fault(const Translations& others, const std::string& language,
                                       const std::string& value) const {
    if (knows_languages_ && !knows(language)) return "language '" + language + "' is not one of the museum's";
    if (others.contains(language)) return "language '" + language + "' stands twice";
    if (value.empty()) return "empty in language '" + language + "'";
    if (!is_utf8(value)) return "not valid UTF-8";
    return {};
  }

  /// One text in each of the museum's languages.
  [[nodiscard]] Translations translations(const YAML::Node& node, const std::string& what) {
    if (!node.IsMap()) throw fault(node, what + ": expected one text a language, such as {en: \"…\"}");
    Translations result;
    for (const auto& entry : node) {
      const std::string language = text(entry.first, "a language");
      const std::string value = text(entry.second, "a text");
      const std::string why = text_fault(result, language, value);
      if (!why.empty()) throw about(entry.first, what, why);
      result[language] = value;
    }
    missing_.count();
    for (const auto& language : museum_.languages) {
      if (knows_languages_ && !result.contains(language))
        missing_.add(language, about(node, what, "language '" + language + "' is missing").error, source_);
    }
    return result;
  }

  /// Why the file's content cannot be spoken; empty when it can.
  [[nodiscard]] static std::string content_fault(const std::string& name, const Result<std::string>& content) {
    if (!content) return content.error().message;
    if (content->find_first_not_of(" \t\r\n") == std::string::npos) return name + " is empty";
    if (content->size() > kLongestText) return name + " is longer than " + std::to_string(kLongestText) + " bytes";
    if (!is_utf8(*content)) return name + " is not valid UTF-8";
    return {};
  }

  /// The content of one file a language.
  [[nodiscard]] Translations texts(const YAML::Node& node, const std::string& what) {
    Translations result;
    for (const auto& [language, name] : translations(node, what)) {
      const YAML::Node& parent = node;
      const YAML::Node at = parent[language];
      auto content = read_text_(inside_folder(at, name));
      const std::string why = content_fault(name, content);
      if (why.empty()) {
        result[language] = std::move(*content);
      } else {
        source_.faults.push_back(about(at, what, why).error);
      }
    }
    return result;
  }

  void read_hazards(const YAML::Node& node) {
    if (!node.IsDefined() || node.IsNull()) return;
    std::set<std::string> seen;
    guarded([&] {
      for (const auto& entry : list(node, "hazards")) {
        guarded([&] {
          YamlReader reader{file(), entry};
          Hazard hazard;
          hazard.id = id(entry, reader.node("id"), seen, "hazard");
          std::string kind;
          reader.required("kind", kind);
          hazard.polygon = polygon(required(entry, reader.node("polygon"), "polygon"));
          reader.finish();
          const auto named = parse<HazardKind>(kind);
          if (!named) {
            throw fault(reader.node("kind"),
                        "hazard '" + hazard.id + "': unknown kind '" + kind + "' (glass, plate, stairs, other)");
          }
          hazard.kind = *named;
          museum_.hazards.push_back(std::move(hazard));
          source_.hazards.push_back(entry);
        });
      }
    });
  }

  /// A key that may be absent; its entries have ids that differ.
  void read_list(const YAML::Node& node, const char* what,
                 void (MuseumYamlReader::*read_one)(const YAML::Node&, std::set<std::string>&)) {
    if (!node.IsDefined() || node.IsNull()) return;
    std::set<std::string> seen;
    guarded([&] {
      for (const auto& entry : list(node, what)) guarded([&] { (this->*read_one)(entry, seen); });
    });
  }

  void read_exhibits(const YAML::Node& node) {
    std::set<std::string> seen;
    const auto entries = list(node, "exhibits");
    knows_exhibits_ = true;
    for (const auto& entry : entries) guarded([&] { read_exhibit(entry, seen); });
    for (std::size_t i = 0; i < museum_.exhibits.size(); ++i) {
      const Exhibit& exhibit = museum_.exhibits[i];
      const YAML::Node& entry = source_.exhibits[i];
      for (std::size_t k = 0; k < exhibit.next.size(); ++k) {
        const YAML::Node at = entry["next"][k];
        if (exhibit.next[k] == exhibit.id) report(at, "exhibit '" + exhibit.id + "' follows itself");
        if (!seen.contains(exhibit.next[k])) {
          report(at, "exhibit '" + exhibit.id + "': next names the unknown exhibit '" + exhibit.next[k] + "'");
        }
      }
    }
  }

  /// A file of a kind that browsers show.
  [[nodiscard]] std::filesystem::path picture(const YAML::Node& node, const std::string& who) const {
    constexpr std::array<std::string_view, 4> kKinds{".png", ".jpg", ".webp", ".svg"};
    auto file = inside_folder(node, text(node, "a file"));
    if (std::find(kKinds.begin(), kKinds.end(), file.extension().string()) == kKinds.end())
      throw fault(node, who + ": picture must be a .png, .jpg, .webp or .svg");
    return file;
  }

  [[nodiscard]] Link link(const YAML::Node& node, const std::string& who) {
    YamlReader reader{file(), node};
    const YAML::Node title = reader.node("title");
    Link link;
    reader.required("url", link.url);
    reader.finish();
    link.title = translations(required(node, title, "title"), who + ", links, title");
    const bool is_address = link.url.starts_with("http://") || link.url.starts_with("https://");
    const bool is_plain = std::all_of(link.url.begin(), link.url.end(), [](char c) { return c > ' ' && c < 127; });
    if (!is_address || !is_plain || link.url.size() > kLongestUrl)
      throw fault(reader.node("url"), who + ": a link's url must begin with http:// or https://");
    return link;
  }

  void read_exhibit(const YAML::Node& entry, std::set<std::string>& seen) {
    YamlReader reader{file(), entry};
    Exhibit exhibit;
    exhibit.id = id(entry, reader.node("id"), seen, "exhibit");
    const std::string who = "exhibit '" + exhibit.id + "'";
    const YAML::Node title = reader.node("title");
    const YAML::Node pose_node = reader.node("pose");
    const YAML::Node look_at = reader.node("look_at");
    const YAML::Node viewpoints = reader.node("viewpoints");
    const YAML::Node short_text = reader.node("short");
    const YAML::Node long_text = reader.node("long");
    reader("topics", exhibit.topics);
    reader("web_only", exhibit.web_only);
    const YAML::Node picture_node = reader.node("picture");
    const YAML::Node links = reader.node("links");
    reader("next", exhibit.next);
    reader.finish();
    exhibit.title = translations(required(entry, title, "title"), who + ", title");
    exhibit.pose = pose(required(entry, pose_node, "pose"));
    const auto target = structure<PointYaml>(required(entry, look_at, "look_at"));
    exhibit.look_at = {target.x, target.y};
    if (distance(exhibit.look_at, exhibit.pose.position()) < 0.05) {
      throw fault(look_at, who + ": look_at is where the robot stands");
    }
    if (viewpoints.IsDefined()) {
      for (const auto& viewpoint : list(viewpoints, "poses")) exhibit.viewpoints.push_back(pose(viewpoint));
    }
    exhibit.short_text = texts(required(entry, short_text, "short"), who + ", short");
    if (long_text.IsDefined()) exhibit.long_text = texts(long_text, who + ", long");
    if (picture_node.IsDefined()) exhibit.picture = picture(picture_node, who);
    if (links.IsDefined()) {
      for (const auto& one : list(links, "links")) exhibit.links.push_back(link(one, who));
    }
    museum_.exhibits.push_back(std::move(exhibit));
    source_.exhibits.push_back(entry);
  }

  void read_modes(const YAML::Node& node) {
    museum_.modes = {{"open", {0.7, 0.0, {}}}, {"web", {0.4, 30.0, {}}}, {"closed", {1.63, 0.0, {}}}};
    if (!node.IsDefined() || node.IsNull()) return;
    guarded([&] {
      if (!node.IsMap()) throw fault(node, "expected modes (open, web, closed)");
      for (const auto& entry : node) {
        guarded([&] {
          const std::string name = text(entry.first, "a mode");
          if (!museum_.modes.contains(name)) {
            throw fault(entry.first, "unknown mode '" + name + "'" + did_you_mean(name, {"open", "web", "closed"}) +
                                         " (open, web, closed)");
          }
          museum_.modes[name] = mode(name, entry.second);
        });
      }
    });
  }

  [[nodiscard]] Mode mode(const std::string& name, const YAML::Node& node) const {
    YamlReader reader{file(), node};
    Mode mode = museum_.modes.at(name);
    reader("max_speed", mode.max_speed);
    reader("wait_s", mode.wait_s);
    reader("hours", mode.hours);
    reader.finish();
    if (!(mode.max_speed > 0.0 && mode.max_speed <= 3.0)) {
      throw fault(node, "mode '" + name + "': max_speed must be > 0 and at most 3 m/s");
    }
    constexpr double kLongestWait = 600.0;  // [s] nothing else is done meanwhile
    if (!(mode.wait_s >= 0.0 && mode.wait_s <= kLongestWait))
      throw fault(node, "mode '" + name + "': wait_s must be 0..600 s");
    check_hours(reader_child(node, "hours"), mode.hours, "mode '" + name + "'");
    return mode;
  }
  void check_hours(const YAML::Node& node, const std::vector<std::string>& all, const std::string& who) const {
    for (const auto& hours : all) {
      if (auto parsed = parse_hours(hours); !parsed) throw about(node, who, parsed.error().message);
    }
  }

  void read_sound(const YAML::Node& node) {
    YamlReader reader{file(), node};
    MuseumSound sound;
    std::optional<std::string> music;
    reader("music", music);
    reader("quiet_hours", sound.quiet_hours);
    reader("quiet_volume", sound.quiet_volume);
    reader.finish();
    if (music) sound.music = inside_folder(reader.node("music"), *music);
    check_hours(reader.node("quiet_hours"), sound.quiet_hours, "quiet_hours");
    if (!(sound.quiet_volume >= 0.0 && sound.quiet_volume <= 1.0))
      throw fault(reader.node("quiet_volume"), "quiet_volume must be 0 to 1");
    museum_.sound = std::move(sound);
  }
  [[nodiscard]] static YAML::Node reader_child(const YAML::Node& node, const char* key) { return node[key]; }

  void read_room(const YAML::Node& entry, std::set<std::string>& seen) {
    YamlReader reader{file(), entry};
    Room room;
    room.id = id(entry, reader.node("id"), seen, "room");
    const std::string who = "room '" + room.id + "'";
    const YAML::Node name = reader.node("name");
    const YAML::Node at = reader.node("at");
    reader.finish();
    if (room.id == kNextRoom) throw fault(entry, "no room can be called 'next'");
    if (museum_.find_exhibit(room.id) != nullptr) throw fault(entry, who + ": an exhibit has the same id");
    room.name = translations(required(entry, name, "name"), who + ", name");
    const auto place = structure<PointYaml>(required(entry, at, "at"));
    room.at = {place.x, place.y};
    museum_.rooms.push_back(std::move(room));
    source_.rooms.push_back(entry);
  }

  std::vector<int> times_of_day(const YAML::Node& node, const std::vector<std::string>& texts, const std::string& who) {
    std::vector<int> times;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const auto time = parse_clock(texts[i]);
      if (!time) throw fault(node[i], who + ": " + time.error().message);
      times.push_back(*time);
    }
    std::sort(times.begin(), times.end());
    const auto twice = std::adjacent_find(times.begin(), times.end());
    if (twice != times.end()) throw fault(node, who + ": " + clock_text(*twice) + " stands twice");
    return times;
  }

  void read_tour(const YAML::Node& entry, std::set<std::string>& seen) {
    YamlReader reader{file(), entry};
    Tour tour;
    tour.id = id(entry, reader.node("id"), seen, "tour");
    const std::string who = "tour '" + tour.id + "'";
    const YAML::Node title = reader.node("title");
    reader("exhibits", tour.exhibits);
    reader("minutes", tour.minutes);
    std::vector<std::string> daily;
    reader("daily", daily);
    reader.finish();
    tour.title = translations(required(entry, title, "title"), who + ", title");
    tour.daily = times_of_day(reader.node("daily"), daily, who + ", daily");
    for (const int minute : tour.daily) {
      const std::string mode = mode_at(museum_, minute);
      if (knows_hours_ && mode != "open")
        report(reader.node("daily"), who + ": the museum's hours say " + mode + " at " + clock_text(minute));
      for (const Tour& other : museum_.tours)
        if (std::find(other.daily.begin(), other.daily.end(), minute) != other.daily.end())
          report(reader.node("daily"), who + ": tour '" + other.id + "' begins at " + clock_text(minute) + ", too");
    }
    const YAML::Node exhibits = reader.node("exhibits");
    if (tour.exhibits.empty() == !tour.minutes) throw fault(entry, who + ": needs either exhibits or minutes");
    if (tour.minutes && !(*tour.minutes > 0.0 && *tour.minutes <= 240.0)) {
      throw fault(reader.node("minutes"), who + ": minutes must be > 0 and at most 240");
    }
    for (std::size_t i = 0; i < tour.exhibits.size(); ++i) {
      const Exhibit* exhibit = museum_.find_exhibit(tour.exhibits[i]);
      // An exhibit with a fault of its own is not known here: name that fault only.
      if (exhibit == nullptr && knows_exhibits_ && !named(tour.exhibits[i])) {
        if (source_.exhibits.empty()) source_.of_no_exhibits.push_back(source_.faults.size());
        report(exhibits[i], who + ": unknown exhibit '" + tour.exhibits[i] + "'");
      } else if (exhibit != nullptr && exhibit->web_only) {
        report(exhibits[i], who + ": '" + tour.exhibits[i] + "' is for the Web only");
      }
      if (std::find(tour.exhibits.begin(), tour.exhibits.begin() + static_cast<std::ptrdiff_t>(i), tour.exhibits[i]) !=
          tour.exhibits.begin() + static_cast<std::ptrdiff_t>(i)) {
        report(exhibits[i], who + ": exhibit '" + tour.exhibits[i] + "' stands twice");
      }
    }
    museum_.tours.push_back(std::move(tour));
    source_.tours.push_back(entry);
  }

  [[nodiscard]] bool named(const std::string& exhibit) const {
    const YAML::Node& root = file().root();
    const YAML::Node exhibits = root["exhibits"];
    if (!exhibits.IsSequence()) return false;
    return std::any_of(exhibits.begin(), exhibits.end(), [&](const YAML::Node& entry) {
      if (!entry.IsMap()) return false;
      const YAML::Node name = entry["id"];
      return name.IsDefined() && name.IsScalar() && name.Scalar() == exhibit;
    });
  }

  const ReadText& read_text_;
  MuseumSource& source_;
  Museum& museum_;
  // What else could be told follows from the fault of what is not known.
  bool knows_languages_ = false, knows_exhibits_ = false, knows_hours_ = false;
  MissingTexts missing_;
};

}  // namespace

MuseumSource read_museum(const YamlFile& file, const ReadText& read_text) {
  MuseumSource source;
  MuseumYamlReader{file, read_text, source}.read();
  return source;
}

}  // namespace docent::museum
