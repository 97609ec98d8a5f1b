#include "docent/museum/editing/museum_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "docent/base/yaml.h"
#include "docent/museum/day_plan.h"
#include "docent/museum/editing/yaml_lines.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::museum {
namespace {

using Lines = std::vector<std::string>;
using museum::yaml_of;  // beside those of this file

/// To the last of `digits`, without zeros at its end.
std::string number(double value, int digits) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, value);
  std::string text = buffer.data();
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}
std::string metres(double value) { return number(value, 3); }

std::string quoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

std::string yaml_of(Point2 point) { return "{x: " + metres(point.x) + ", y: " + metres(point.y) + "}"; }

/// [a, b, c]
template <class List, class Write>
std::string in_brackets(const List& list, Write write) {
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ", ") + write(item);
  return "[" + text + "]";
}
std::string yaml_of(const std::vector<std::string>& words) { return in_brackets(words, quoted); }

/// An id stands as it is: no letter of it means anything to YAML.
std::string list_of_ids(const std::vector<std::string>& ids) {
  return in_brackets(ids, [](const std::string& id) { return id; });
}
std::string yaml_of(const Link& link) { return "{title: " + yaml_of(link.title) + ", url: " + quoted(link.url) + "}"; }

/// Values that are written below a key: the rest of its line, and further lines, which are indented more.
Lines value_of(std::string text) { return {" " + std::move(text)}; }
Lines value_of(const std::vector<Pose2>& poses) {
  Lines lines{""};
  for (const Pose2& pose : poses) lines.push_back("  - " + yaml_of(pose));
  return lines;
}

/// key: value, of a map whose keys begin behind `indentation`.
Lines with_key(const std::string& prefix, const std::string& key, const Lines& value) {
  Lines lines{prefix + key + ":" + value.front()};
  const std::string indentation(prefix.size(), ' ');
  for (std::size_t i = 1; i < value.size(); ++i) lines.push_back(indentation + value[i]);
  return lines;
}

/// The names of the files for a text of an exhibit: those that it has, and new ones.
std::map<std::string, std::string> text_files(const Exhibit& exhibit, const char* which, const Translations& texts,
                                              const YAML::Node& named) {
  std::map<std::string, std::string> names;
  for (const auto& [language, text] : texts) {
    const YAML::Node known =
        named.IsDefined() && named.IsMap() ? named[language] : YAML::Node{YAML::NodeType::Undefined};
    names[language] = known.IsDefined() && known.IsScalar()
                          ? known.Scalar()
                          : "content/" + exhibit.id + "." + which + "." + language + ".md";
  }
  return names;
}

/// A key of an exhibit, and its value; none: the exhibit shall not have it.
struct Field {
  const char* key;
  Lines value;
  bool is_changed;
};

class Editor {
 public:
  Editor(const YamlFile& file, const MuseumSource& source, const MuseumDraft& draft)
      : root_{file.root()}, source_{source}, draft_{draft} {}

  /// Line by line. Empty: museum.yaml is not written so that this could be done.
  std::string in_lines(const std::string& yaml) {
    if (!root_.IsMap() || !YamlLines::is_in_lines(root_)) return {};
    YamlLines lines{yaml};
    const Museum& museum = source_.museum;
    if (!is_same(museum.area, draft_.area)) set(lines, root_, lines.all(), "area", value_of(yaml_of(draft_.area)));
    if (!is_same(museum.home, draft_.home)) set(lines, root_, lines.all(), "home", value_of(yaml_of(draft_.home)));
    const bool has_charger = museum.charger.has_value();
    if (has_charger && !draft_.charger) set(lines, root_, lines.all(), "charger", {});
    if (draft_.charger && (!has_charger || !is_same(*museum.charger, *draft_.charger)))
      set(lines, root_, lines.all(), "charger", value_of(yaml_of(*draft_.charger)));
    edit_list(lines, "hazards", museum.hazards, source_.hazards, draft_.hazards);
    edit_list(lines, "exhibits", museum.exhibits, source_.exhibits, draft_.exhibits);
    edit_list(lines, "tours", museum.tours, source_.tours, draft_.tours);
    edit_list(lines, "rooms", museum.rooms, source_.rooms, draft_.rooms);
    if (!is_same(draft_of(museum).hours, draft_.hours)) edit_hours(lines);
    return lines.text();
  }

  /// All anew, from what was understood of it.
  std::string anew() {
    YAML::Node root = YAML::Clone(root_);
    root["area"] = YAML::Load(yaml_of(draft_.area));
    root["home"] = YAML::Load(yaml_of(draft_.home));
    root.remove("charger");
    if (draft_.charger) root["charger"] = YAML::Load(yaml_of(*draft_.charger));
    YAML::Node hazards{YAML::NodeType::Sequence};
    for (const Hazard& hazard : draft_.hazards) hazards.push_back(YAML::Load(yaml_of(hazard)));
    root["hazards"] = hazards;
    YAML::Node exhibits{YAML::NodeType::Sequence};
    for (const Exhibit& exhibit : draft_.exhibits) {
      const std::size_t known = index_of(source_.museum.exhibits, exhibit.id);
      YAML::Node node{YAML::NodeType::Map};
      if (known < source_.exhibits.size()) node = YAML::Clone(source_.exhibits[known]);
      node["id"] = exhibit.id;
      for (const Field& field : fields_of(exhibit, known)) {
        node.remove(field.key);
        if (!field.value.empty()) node[field.key] = YAML::Load(joined(field.value));
      }
      exhibits.push_back(node);
    }
    root["exhibits"] = exhibits;
    YAML::Node tours{YAML::NodeType::Sequence};
    for (const Tour& tour : draft_.tours) tours.push_back(YAML::Load(yaml_of(tour)));
    root["tours"] = tours;
    YAML::Node rooms{YAML::NodeType::Sequence};
    for (const Room& room : draft_.rooms) rooms.push_back(YAML::Load(yaml_of(room)));
    root.remove("rooms");
    if (!draft_.rooms.empty()) root["rooms"] = rooms;
    if (!is_same(draft_of(source_.museum).hours, draft_.hours)) {
      for (const auto& [mode, text] : modes()) root["modes"][mode] = YAML::Load(text);
    }
    YAML::Emitter emitter;
    emitter << root;
    return std::string{emitter.c_str()} + "\n";
  }

  /// The texts that are new, or say something new.
  FolderFiles texts() {
    FolderFiles files;
    for (const Exhibit& exhibit : draft_.exhibits) {
      const std::size_t known = index_of(source_.museum.exhibits, exhibit.id);
      const Exhibit* before = known < source_.museum.exhibits.size() ? &source_.museum.exhibits[known] : nullptr;
      add_texts(files, exhibit, "short", exhibit.short_text, before ? before->short_text : Translations{},
                node_of(known, "short"));
      add_texts(files, exhibit, "long", exhibit.long_text, before ? before->long_text : Translations{},
                node_of(known, "long"));
    }
    return files;
  }

 private:
  template <class T>
  static std::size_t index_of(const std::vector<T>& all, const std::string& id) {
    return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), [&](const T& item) { return item.id == id; }) -
                                    all.begin());
  }
  static std::string joined(const Lines& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + '\n';
    return text;
  }
  [[nodiscard]] YAML::Node node_of(std::size_t exhibit, const char* key) const {
    if (exhibit >= source_.exhibits.size()) return YAML::Node{YAML::NodeType::Undefined};
    const YAML::Node& node = source_.exhibits[exhibit];
    return node[key];
  }
  static void add_texts(FolderFiles& files, const Exhibit& exhibit, const char* which, const Translations& texts,
                        const Translations& before, const YAML::Node& named) {
    for (const auto& [language, name] : text_files(exhibit, which, texts, named)) {
      const std::string& text = texts.at(language);
      const auto known = before.find(language);
      if (known != before.end() && is_same(Translations{*known}, Translations{{language, text}})) continue;
      files[std::filesystem::path{name}.lexically_normal()] = text.ends_with('\n') ? text : text + '\n';
    }
  }

  /// Sets a key of a map, adds it, or takes it away where `value` is empty.
  static void set(YamlLines& lines, const YAML::Node& map, YamlLines::Range of_map, const char* key,
                  const Lines& value) {
    for (const auto& entry : map) {
      if (entry.first.Scalar() != key) continue;
      const YamlLines::Range range = lines.of_key(map, of_map, key);
      const std::string prefix = lines.prefix(range, static_cast<std::size_t>(entry.first.Mark().column));
      return lines.replace(range, value.empty() ? Lines{} : with_key(prefix, key, value));
    }
    if (value.empty()) return;
    const YAML::Node first = map.begin()->first;
    const std::string indentation(static_cast<std::size_t>(first.Mark().column), ' ');
    std::size_t end = 0;
    for (const auto& entry : map) end = std::max(end, lines.of_key(map, of_map, entry.first.Scalar()).end);
    lines.insert(end, with_key(indentation, key, value));
  }

  [[nodiscard]] std::vector<Field> fields_of(const Exhibit& exhibit, std::size_t known) const {
    const auto& all = source_.museum.exhibits;
    const Exhibit* before = known < all.size() ? &all[known] : nullptr;
    const auto names = [&](const char* which, const Translations& texts) {
      return texts.empty() ? Lines{}
                           : value_of(yaml_of(Translations{text_files(exhibit, which, texts, node_of(known, which))}));
    };
    const auto has_same_languages = [](const Translations& one, const Translations& other) {
      return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                        [](const auto& a, const auto& b) { return a.first == b.first; });
    };
    return {
        {"title", value_of(yaml_of(exhibit.title)), !before || !is_same(before->title, exhibit.title)},
        {"pose", value_of(yaml_of(exhibit.pose)), !before || !is_same(before->pose, exhibit.pose)},
        {"look_at", value_of(yaml_of(exhibit.look_at)),
         !before || !is_same(Polygon{before->look_at}, Polygon{exhibit.look_at})},
        {"viewpoints", exhibit.viewpoints.empty() ? Lines{} : value_of(exhibit.viewpoints),
         !before || !is_same(before->viewpoints, exhibit.viewpoints)},
        {"short", names("short", exhibit.short_text),
         !before || !has_same_languages(before->short_text, exhibit.short_text)},
        {"long", names("long", exhibit.long_text),
         !before || !has_same_languages(before->long_text, exhibit.long_text)},
        {"topics", exhibit.topics.empty() ? Lines{} : value_of(yaml_of(exhibit.topics)),
         !before || before->topics != exhibit.topics},
        {"web_only", exhibit.web_only ? value_of("true") : Lines{}, !before || before->web_only != exhibit.web_only},
        {"picture", exhibit.picture.empty() ? Lines{} : value_of(quoted(exhibit.picture.generic_string())),
         !before || before->picture != exhibit.picture},
        {"links",
         exhibit.links.empty() ? Lines{}
                               : value_of(in_brackets(exhibit.links, [](const Link& link) { return yaml_of(link); })),
         !before || !is_same(before->links, exhibit.links)},
    };
  }

  Lines new_item(const Hazard& hazard) const { return {yaml_of(hazard)}; }
  Lines new_item(const Tour& tour) const { return {yaml_of(tour)}; }
  Lines new_item(const Room& room) const { return {yaml_of(room)}; }
  Lines new_item(const Exhibit& exhibit) const {
    Lines lines{"id: " + exhibit.id};
    for (const Field& field : fields_of(exhibit, source_.museum.exhibits.size())) {
      if (field.value.empty()) continue;
      const Lines more = with_key("", field.key, field.value);
      lines.insert(lines.end(), more.begin(), more.end());
    }
    return lines;
  }
  static Lines indented(const std::string& prefix, Lines item) {
    const std::string indentation(prefix.size(), ' ');
    for (std::size_t i = 0; i < item.size(); ++i) item[i] = (i == 0 ? prefix : indentation) + item[i];
    return item;
  }

  /// A hazard, a tour or a room, which stands on one line.
  template <class T>
  void change_item(YamlLines& lines, YamlLines::Range range, const YAML::Node& node, const T& item,
                   std::size_t /*known*/) {
    const std::string prefix = lines.prefix(range, static_cast<std::size_t>(node.Mark().column));
    lines.replace(range, {prefix + yaml_of(item)});
  }
  void change_item(YamlLines& lines, YamlLines::Range range, const YAML::Node& node, const Exhibit& exhibit,
                   std::size_t known) {
    for (const Field& field : fields_of(exhibit, known)) {
      if (field.is_changed) set(lines, node, range, field.key, field.value);
    }
  }

  template <class T>
  void edit_list(YamlLines& lines, const char* key, const std::vector<T>& before, const std::vector<YAML::Node>& nodes,
                 const std::vector<T>& after) {
    const YAML::Node list = std::as_const(root_)[key];
    if (!list.IsDefined() || !YamlLines::is_in_lines(list) || after.empty()) {
      if (before.empty() && after.empty()) return;
      Lines value = after.empty() ? value_of("[]") : Lines{""};
      for (const T& item : after) {
        const Lines more = indented("  - ", new_item(item));
        value.insert(value.end(), more.begin(), more.end());
      }
      return set(lines, root_, lines.all(), key, value);
    }
    const auto ranges = lines.of_items(list, lines.of_key(root_, lines.all(), key));
    if (ranges.size() != before.size()) return;  // some could not be read: all is written anew
    for (std::size_t i = 0; i < before.size(); ++i) {
      const std::size_t now = index_of(after, before[i].id);
      if (now == after.size()) {
        lines.replace(ranges[i], {});
      } else if (!is_same(before[i], after[now])) {
        change_item(lines, ranges[i], nodes[i], after[now], i);
      }
    }
    const std::string prefix = lines.prefix(ranges.back(), static_cast<std::size_t>(nodes.back().Mark().column));
    for (const T& item : after) {
      if (index_of(before, item.id) == before.size()) lines.insert(ranges.back().end, indented(prefix, new_item(item)));
    }
  }

  /// What each mode says then: its hours as the draft has them, all else as it is written. Modes of which nothing is
  /// said are left out.
  [[nodiscard]] std::map<std::string, std::string> modes() const {
    std::map<std::string, std::string> texts;
    const YAML::Node written = root_["modes"];
    for (const char* mode : kModes) {
      const YAML::Node before =
          written.IsDefined() && written.IsMap() ? written[mode] : YAML::Node{YAML::NodeType::Undefined};
      const auto hours = draft_.hours.find(mode);
      const bool has_hours = hours != draft_.hours.end() && !hours->second.empty();
      if (!before.IsDefined() && !has_hours) continue;
      std::vector<std::string> fields;
      for (const char* key : {"max_speed", "wait_s"}) {
        const YAML::Node value =
            before.IsDefined() && before.IsMap() ? before[key] : YAML::Node{YAML::NodeType::Undefined};
        if (value.IsDefined() && value.IsScalar()) fields.push_back(std::string{key} + ": " + value.Scalar());
      }
      if (has_hours) fields.push_back("hours: " + yaml_of(hours->second));
      std::string text;
      for (const std::string& field : fields) text += (text.empty() ? "" : ", ") + field;
      texts[mode] = "{" + text + "}";
    }
    return texts;
  }
  void edit_hours(YamlLines& lines) const {
    const YAML::Node written = root_["modes"];
    if (!written.IsDefined() || !written.IsMap() || written.size() == 0 || !YamlLines::is_in_lines(written)) {
      Lines value{""};
      for (const auto& [mode, text] : modes()) value.push_back("  " + mode + ": " + text);
      return set(lines, root_, lines.all(), "modes", value);
    }
    const ModeHours before = draft_of(source_.museum).hours;
    for (const auto& [mode, text] : modes()) {
      const auto hours = draft_.hours.find(mode);
      const bool has_same =
          (hours == draft_.hours.end() ? std::vector<std::string>{} : hours->second) == before.at(mode);
      if (!has_same) set(lines, written, lines.of_key(root_, lines.all(), "modes"), mode.c_str(), value_of(text));
    }
  }

  const YAML::Node& root_;
  const MuseumSource& source_;
  const MuseumDraft& draft_;
};

/// museum.yaml as `yaml` would be read, with its texts as they would be written.
Result<MuseumSource> read_back(const std::string& yaml, const FolderFiles& texts, const ReadText& read_text) {
  auto file = YamlFile::parse(yaml, kMuseumFile);
  if (!file) return tl::unexpected<Error>(file.error());
  return read_museum(*file, [&](const std::filesystem::path& relative) -> Result<std::string> {
    const auto written = texts.find(relative.lexically_normal());
    return written == texts.end() ? read_text(relative) : Result<std::string>{written->second};
  });
}

}  // namespace

std::string yaml_of(const Pose2& pose) {
  return "{x: " + metres(pose.x) + ", y: " + metres(pose.y) + ", heading: " + number(pose.theta.degrees(), 1) + "}";
}

std::string yaml_of(const Polygon& polygon) {
  return in_brackets(polygon, [](Point2 corner) { return "[" + metres(corner.x) + ", " + metres(corner.y) + "]"; });
}

std::string yaml_of(const Hazard& hazard) {
  return "{id: " + hazard.id + ", kind: " + to_text(hazard.kind) + ", polygon: " + yaml_of(hazard.polygon) + "}";
}

std::string yaml_of(const Tour& tour) {
  std::string text = "{id: " + tour.id + ", title: " + yaml_of(tour.title);
  if (!tour.exhibits.empty()) text += ", exhibits: " + list_of_ids(tour.exhibits);
  if (tour.minutes) text += ", minutes: " + number(*tour.minutes, 3);
  if (!tour.daily.empty())
    text += ", daily: " + in_brackets(tour.daily, [](int minute) { return quoted(clock_text(minute)); });
  return text + "}";
}

std::string yaml_of(const Room& room) {
  return "{id: " + room.id + ", name: " + yaml_of(room.name) + ", at: " + yaml_of(room.at) + "}";
}

std::string yaml_of(const Translations& texts) {
  std::string text;
  for (const auto& [language, words] : texts) text += (text.empty() ? "" : ", ") + language + ": " + quoted(words);
  return "{" + text + "}";
}

Result<EditedMuseum> edit_museum(const std::string& yaml, const ReadText& read_text, const MuseumDraft& draft) {
  const auto file = YamlFile::parse(yaml, kMuseumFile);
  if (!file) return tl::unexpected<Error>(file.error());
  const MuseumSource source = read_museum(*file, read_text);
  EditedMuseum edited;
  try {
    Editor editor{*file, source, draft};
    edited.files = editor.texts();
    for (const std::string& text : {editor.in_lines(yaml), editor.anew()}) {
      auto back = read_back(text, edited.files, read_text);
      if (!back) continue;
      edited.faults = std::move(back->faults);
      if (edited.faults.empty() && is_same(draft_of(back->museum), draft)) {
        if (text != yaml) edited.files[kMuseumFile] = text;
        return edited;
      }
    }
  } catch (const YAML::Exception& exception) {
    return fail(std::string{kMuseumFile} + ": " + exception.what());
  }
  if (edited.faults.empty()) return fail(std::string{kMuseumFile} + ": cannot be changed so");
  return edited;
}

}  // namespace docent::museum
