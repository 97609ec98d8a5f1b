#include "docent/simulator/museum_folder/museum_folder.h"

#include <array>
#include <cstdio>

#include "docent/base/files.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/simulator/museum_folder/made_files.h"
#include "docent/simulator/pedestrians/tracks_file.h"

namespace docent::simulator {
namespace {

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f", value);
  return text.data();
}

std::string point(Point2 p) { return "{x: " + number(p.x) + ", y: " + number(p.y) + "}"; }

std::string pose(const Pose2& p) {
  return "{x: " + number(p.x) + ", y: " + number(p.y) + ", heading: " + number(p.theta.degrees()) + "}";
}

std::string corners(const std::vector<Point2>& points) {
  std::string text = "[";
  for (const Point2 p : points) text += (text.size() > 1 ? ", [" : "[") + number(p.x) + ", " + number(p.y) + "]";
  return text + "]";
}

std::string list(const std::vector<std::string>& words) {
  std::string text = "[";
  for (const std::string& word : words) text += (text.size() > 1 ? ", " : "") + word;
  return text + "]";
}

/// A text as YAML's double quotes hold it, whatever is in it.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + "\"";
}

/// "{en: "…", de: "…"}"; where nothing is said, `otherwise` in each language.
std::string in_languages(const std::vector<std::string>& languages, const std::map<std::string, std::string>& said,
                         const std::string& otherwise) {
  std::string text = "{";
  for (const std::string& language : languages) {
    const auto found = said.find(language);
    text += (text.size() > 1 ? ", " : "") + language + ": " + quoted(found == said.end() ? otherwise : found->second);
  }
  return text + "}";
}

std::string content_file(const Stop& stop, const std::string& language) {
  return "content/" + stop.id + ".short." + language + ".md";
}

std::string museum_yaml(const MuseumPlan& plan, const Survey& survey) {
  std::string text = "# " + plan.made_of + "; metres and degrees in the map's frame.\n";
  text += "name: " + in_languages(plan.languages, {}, plan.title) + "\nlanguages: " + list(plan.languages) +
          "\nmap: map.yaml\n";
  text += "area: " + corners(plan.world.operating_area) + "\n";
  text += survey.hazards.empty() ? "hazards: []\n" : to_yaml(survey.hazards);
  text += "home: " + pose(plan.home) + "\n";
  if (plan.charger) text += "charger: " + pose(*plan.charger) + "\n";
  text += "exhibits:\n";
  for (const Stop& stop : plan.stops) {
    std::string files;
    for (const std::string& language : plan.languages)
      files += (files.empty() ? "" : ", ") + language + ": " + content_file(stop, language);
    text += "  - id: " + stop.id + "\n    title: " + in_languages(plan.languages, stop.title, stop.id) +
            "\n    pose: " + pose(stop.pose) + "\n    look_at: " + point(stop.look_at) + "\n    short: {" + files +
            "}\n    topics: [" + plan.topic + "]\n";
  }
  text += "tours:\n";
  for (const Round& round : plan.rounds)
    text += "  - {id: " + round.id + ", title: " + in_languages(plan.languages, {}, round.title) +
            ", exhibits: " + list(round.stops) + "}\n";
  return text + "simulation: simulation.yaml\n";
}

/// What the file says of ceilings and marks; nothing where nothing was said.
std::string overhead(const World& world) {
  std::string text;
  if (!world.ceiling.empty()) text += "ceiling:\n";
  for (const CeilingPart& part : world.ceiling)
    text += "  - {height: " + number(part.height) + ", polygon: " + corners(part.polygon) + "}\n";
  const CeilingStyle& style = world.ceiling_style;
  if (style.kind != CeilingKind::various || style.seed)
    text += std::string{"ceiling_style: {kind: "} + to_string(style.kind) +
            (style.seed ? ", seed: " + std::to_string(*style.seed) : "") + "}\n";
  if (!world.marks.empty()) text += "marks:\n";
  for (const Mark& mark : world.marks)
    text += "  - {id: " + mark.id + ", tag: " + std::to_string(mark.tag) + ", x: " + number(mark.position.x) +
            ", y: " + number(mark.position.y) + ", height: " + number(mark.height) +
            ", heading: " + number(mark.heading.degrees()) + ", tilt: " + number(Angle::radians(mark.tilt).degrees()) +
            ", size: " + number(mark.size) + "}\n";
  return text;
}

}  // namespace

std::string to_yaml(const World& world) {
  std::string text = "ceiling_height: " + number(world.ceiling_height) + "\nfloor: " + corners(world.floor) +
                     "\noperating_area: " + corners(world.operating_area) + "\nentrances: " + corners(world.entrances) +
                     "\nhome: " + point(world.home) + "\nvisitors_per_hour: " + number(world.visitors_per_hour) +
                     "\nexhibits: " + list(world.exhibits) + "\ntours: " + list(world.tours) + "\nsolids:\n";
  for (const Solid& solid : world.solids) {
    text += "  - {id: " + solid.id + ", kind: " + kind_name(solid) + ", bottom: " + number(solid.bottom) +
            ", top: " + number(solid.top) + (solid.movable ? ", movable: true" : "") +
            ", polygon: " + corners(solid.polygon) + "}\n";
  }
  text += world.attractions.empty() ? "attractions: []\n" : "attractions:\n";
  for (const Attraction& a : world.attractions) {
    text += "  - {id: " + a.id + ", centre: " + point(a.centre) + ", radius: " + number(a.radius) +
            ", weight: " + number(a.weight) + "}\n";
  }
  if (world.scene_camera)
    text += "scene_camera: {x: " + number(world.scene_camera->position.x) +
            ", y: " + number(world.scene_camera->position.y) + ", height: " + number(world.scene_camera->height) +
            "}\n";
  text += overhead(world);
  if (!world.pedestrians_file.empty()) text += "pedestrians: " + world.pedestrians_file + "\n";
  return text;
}

Result<void> write_museum(const MuseumPlan& plan, const Survey& survey, const std::filesystem::path& folder) {
  std::map<std::string, std::string> texts;
  for (const Stop& stop : plan.stops) {
    for (const std::string& language : plan.languages) {
      const auto found = stop.text.find(language);
      texts[content_file(stop, language)] =
          found == stop.text.end() ? "This is " + stop.id + " of the building.\n" : found->second + "\n";
    }
  }
  if (!plan.world.pedestrians_file.empty()) texts[plan.world.pedestrians_file] = to_text(plan.world.pedestrians);
  texts["simulation.yaml"] = to_yaml(plan.world);
  texts["museum.yaml"] = museum_yaml(plan, survey);
  std::vector<std::string> names{"map.yaml", "map.pgm"};
  for (const auto& [name, text] : texts) names.push_back(name);

  const auto made = MadeFiles::in(folder);
  if (!made) return tl::unexpected<Error>(made.error());
  if (auto checked = made->check(names); !checked) return checked;
  std::error_code code;
  std::filesystem::create_directories(folder / "content", code);
  if (code) return fail(folder.string() + ": cannot be made: " + code.message());
  if (auto saved = save_map(survey.map, folder / "map"); !saved) return saved;
  for (const auto& [name, text] : texts) {
    if (auto written = write_file_atomically(folder / name, text); !written) return written;
  }
  return made->note(names);
}

}  // namespace docent::simulator
