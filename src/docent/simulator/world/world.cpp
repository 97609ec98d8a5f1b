#include "docent/simulator/world/world.h"

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "docent/base/files.h"
#include "docent/base/yaml.h"
#include "docent/simulator/pedestrians/tracks_file.h"

namespace docent::simulator {
namespace {

constexpr double kFarthest = 10'000.0;  // [m]; coordinates beyond it are a slip of the pen

struct NamedKind {
  const char* name;
  SolidKind kind;
  double top;  // [m], where the file says nothing
  SolidForm form = SolidForm::prism;
};
constexpr std::array kKinds{NamedKind{"wall", SolidKind::wall, 3.0},
                            NamedKind{"furniture", SolidKind::furniture, 1.0},
                            NamedKind{"glass", SolidKind::glass, 2.0},
                            NamedKind{"plate", SolidKind::plate, 0.02},
                            NamedKind{"stairs", SolidKind::stairs, 0.0},
                            NamedKind{"can", SolidKind::furniture, 0.12, SolidForm::can},
                            NamedKind{"wad", SolidKind::furniture, 0.06, SolidForm::wad},
                            NamedKind{"bin", SolidKind::furniture, 0.45, SolidForm::bin}};
constexpr std::array<std::pair<const char*, CeilingKind>, 3> kCeilings{
    {{"various", CeilingKind::various}, {"periodic", CeilingKind::periodic}, {"plain", CeilingKind::plain}}};
constexpr int kTags = 587;  // of the family 36h11

struct PointYaml {
  double x = 0.0;
  double y = 0.0;
  template <class V>
  void visit(V& v) {
    v.required("x", x);
    v.required("y", y);
  }
};

struct BoxYaml {
  double x = 0.0;
  double y = 0.0;
  double length = 0.0;
  double width = 0.0;
  double heading = 0.0;
  template <class V>
  void visit(V& v) {
    v.required("x", x);
    v.required("y", y);
    v.required("length", length);
    v.required("width", width);
    v("heading", heading);
  }
};

struct CircleYaml {
  double x = 0.0;
  double y = 0.0;
  double radius = 0.0;
  template <class V>
  void visit(V& v) {
    v.required("x", x);
    v.required("y", y);
    v.required("radius", radius);
  }
};

using Corners = std::vector<std::vector<double>>;

struct SolidYaml {
  std::string id;
  std::string kind;
  std::optional<Corners> polygon;
  std::optional<Corners> line;
  std::optional<BoxYaml> box;
  std::optional<CircleYaml> circle;
  double thickness = 0.2;
  bool closed = false;
  double bottom = 0.0;
  std::optional<double> top;
  bool movable = false;
  template <class V>
  void visit(V& v) {
    v.required("id", id);
    v.required("kind", kind);
    v("polygon", polygon);
    v("line", line);
    v("box", box);
    v("circle", circle);
    v("thickness", thickness);
    v("closed", closed);
    v("bottom", bottom);
    v("top", top);
    v("movable", movable);
  }
};

struct AttractionYaml {
  std::string id;
  PointYaml centre;
  double radius = 1.5;
  double weight = 1.0;
  template <class V>
  void visit(V& v) {
    v.required("id", id);
    v.required("centre", centre);
    v("radius", radius);
    v("weight", weight);
  }
};

struct CeilingYaml {
  Corners polygon;
  double height = 0.0;
  template <class V>
  void visit(V& v) {
    v.required("polygon", polygon);
    v.required("height", height);
  }
};

struct CeilingStyleYaml {
  std::string kind = "various";
  std::optional<std::uint64_t> seed;
  template <class V>
  void visit(V& v) {
    v("kind", kind);
    v("seed", seed);
  }
};

struct MarkYaml {
  std::string id;
  int tag = 0;
  double x = 0.0;
  double y = 0.0;
  double height = 0.0;
  double heading = 0.0;
  double tilt = 0.0;
  double size = 0.16;
  template <class V>
  void visit(V& v) {
    v.required("id", id);
    v.required("tag", tag);
    v.required("x", x);
    v.required("y", y);
    v.required("height", height);
    v("heading", heading);
    v("tilt", tilt);
    v("size", size);
  }
};

struct CameraYaml {
  double x = 0.0;
  double y = 0.0;
  double height = 2.7;
  template <class V>
  void visit(V& v) {
    v.required("x", x);
    v.required("y", y);
    v("height", height);
  }
};

class WorldParser {
 public:
  explicit WorldParser(const YamlFile& file) : file_{file}, root_{file.root()} {}

  World parse() {
    YamlReader reader{file_, root_};
    Corners floor;
    Corners area;
    Corners entrances;
    PointYaml home;
    World world;
    std::vector<SolidYaml> solids;
    std::vector<AttractionYaml> attractions;
    std::vector<CeilingYaml> ceiling;
    std::optional<CameraYaml> camera;
    CeilingStyleYaml style;
    std::vector<MarkYaml> marks;
    reader.required("floor", floor);
    reader.required("operating_area", area);
    reader.required("solids", solids);
    reader("attractions", attractions);
    reader.required("entrances", entrances);
    reader.required("home", home);
    reader("visitors_per_hour", world.visitors_per_hour);
    reader("exhibits", world.exhibits);
    reader("tours", world.tours);
    reader("ceiling_height", world.ceiling_height);
    reader("ceiling", ceiling);
    reader("ceiling_style", style);
    reader("marks", marks);
    (void)reader.node("contacts");  // of load_contacts
    reader("pedestrians", world.pedestrians_file);
    reader("scene_camera", camera);
    reader.finish();
    world.floor = polygon(root_["floor"], floor);
    world.operating_area = polygon(root_["operating_area"], area);
    world.entrances = points(root_["entrances"], entrances);
    if (world.entrances.empty()) throw fault(root_["entrances"], "no entrance");
    for (const Point2 entrance : world.entrances) {
      if (!contains(world.floor, entrance)) throw fault(root_["entrances"], "an entrance lies outside the floor");
    }
    world.home = {home.x, home.y};
    if (!contains(world.operating_area, world.home)) throw fault(root_["home"], "home lies outside operating_area");
    if (!(world.visitors_per_hour >= 0.0)) throw fault(root_["visitors_per_hour"], "must be >= 0");
    if (!(world.ceiling_height > 0.0)) throw fault(root_["ceiling_height"], "must be > 0");
    add_ceiling(ceiling, world);
    world.ceiling_style = {ceiling_kind(style.kind), style.seed};
    for (std::size_t i = 0; i < marks.size(); ++i) world.marks.push_back(mark(root_["marks"][i], marks[i]));
    if (camera) {
      if (!(camera->height > 0.5 && camera->height < 50.0))
        throw fault(root_["scene_camera"], "height must be 0.5 to 50");
      world.scene_camera = CameraPlace{{camera->x, camera->y}, camera->height};
    }
    for (std::size_t i = 0; i < solids.size(); ++i) add_solids(root_["solids"][i], solids[i], world.solids);
    for (std::size_t i = 0; i < attractions.size(); ++i) {
      const AttractionYaml& a = attractions[i];
      const YAML::Node node = root_["attractions"][i];
      if (!(a.radius > 0.0) || !(a.weight > 0.0)) throw fault(node, "radius and weight must be > 0");
      if (!attraction_ids_.insert(a.id).second) throw fault(node, "attraction '" + a.id + "' stands twice");
      world.attractions.push_back({a.id, {a.centre.x, a.centre.y}, a.radius, a.weight});
    }
    check_walls(world);
    return world;
  }

 private:
  YamlFault fault(const YAML::Node& node, const std::string& what) const { return YamlFault{file_.fault(node, what)}; }

  void add_ceiling(const std::vector<CeilingYaml>& ceiling, World& world) const {
    for (std::size_t i = 0; i < ceiling.size(); ++i) {
      const YAML::Node node = root_["ceiling"][i];
      if (!(ceiling[i].height > 0.0)) throw fault(node, "height must be > 0");
      world.ceiling.push_back({polygon(node["polygon"], ceiling[i].polygon), ceiling[i].height});
    }
  }

  CeilingKind ceiling_kind(const std::string& name) const {
    for (const auto& [known, kind] : kCeilings)
      if (name == known) return kind;
    throw fault(root_["ceiling_style"], "unknown kind '" + name + "' (various, periodic, plain)");
  }

  Mark mark(const YAML::Node& node, const MarkYaml& yaml) {
    if (!mark_ids_.insert(yaml.id).second) throw fault(node, "mark '" + yaml.id + "' stands twice");
    if (yaml.tag < 0 || yaml.tag >= kTags) throw fault(node, "tag must be 0 to 586, of the family 36h11");
    if (!(yaml.size > 0.0 && yaml.size < 5.0)) throw fault(node, "size must be above 0 and below 5");
    if (!(std::abs(yaml.tilt) <= 90.0)) throw fault(node, "tilt must be -90 to 90");
    if (std::abs(yaml.x) > kFarthest || std::abs(yaml.y) > kFarthest || !(std::abs(yaml.height) < kFarthest))
      throw fault(node, "too far away");
    return {yaml.id,
            yaml.tag,
            {yaml.x, yaml.y},
            yaml.height,
            Angle::degrees(yaml.heading),
            yaml.tilt * std::numbers::pi / 180.0,
            yaml.size};
  }

  std::vector<Point2> points(const YAML::Node& node, const Corners& corners) const {
    std::vector<Point2> result;
    for (const auto& corner : corners) {
      if (corner.size() != 2) throw fault(node, "expected corners [x, y]");
      if (std::abs(corner[0]) > kFarthest || std::abs(corner[1]) > kFarthest) throw fault(node, "too far away");
      result.push_back({corner[0], corner[1]});
    }
    return result;
  }

  Polygon polygon(const YAML::Node& node, const Corners& corners) const {
    Polygon result = points(node, corners);
    if (result.size() < 3) throw fault(node, "a polygon needs at least 3 corners");
    if (!is_simple(result)) throw fault(node, "the polygon crosses itself");
    if (std::abs(signed_area(result)) < 1e-6) throw fault(node, "the polygon has no area");
    return result;
  }

  void add_solids(const YAML::Node& node, const SolidYaml& yaml, std::vector<Solid>& solids) {
    Solid solid;
    solid.id = yaml.id;
    const NamedKind* kind = nullptr;
    for (const auto& candidate : kKinds) {
      if (yaml.kind == candidate.name) kind = &candidate;
    }
    if (kind == nullptr) {
      throw fault(node["kind"],
                  "unknown kind '" + yaml.kind + "' (wall, furniture, glass, plate, stairs, can, wad, bin)");
    }
    solid.kind = kind->kind;
    solid.form = kind->form;
    solid.bottom = yaml.bottom;
    solid.top = yaml.top.value_or(kind->top);
    solid.movable = yaml.movable;
    if (solid.kind != SolidKind::stairs && !(solid.top > solid.bottom)) throw fault(node, "top must be above bottom");
    const int outlines = int{yaml.polygon.has_value()} + int{yaml.line.has_value()} + int{yaml.box.has_value()} +
                         int{yaml.circle.has_value()};
    if (outlines != 1) throw fault(node, "needs exactly one of polygon, line, box, circle");
    if (yaml.line) {
      add_line(node, yaml, solid, solids);
      return;
    }
    if (yaml.polygon) solid.polygon = polygon(node["polygon"], *yaml.polygon);
    if (yaml.box) solid.polygon = box(node["box"], *yaml.box);
    if (yaml.circle) solid.polygon = circle(node["circle"], *yaml.circle);
    add(node, solid, solids);
  }

  void add(const YAML::Node& node, const Solid& solid, std::vector<Solid>& solids) {
    if (!solid_ids_.insert(solid.id).second) throw fault(node, "solid '" + solid.id + "' stands twice");
    solids.push_back(solid);
  }

  // Each piece reaches half a thickness beyond its ends, so that corners close.
  void add_line(const YAML::Node& node, const SolidYaml& yaml, Solid solid, std::vector<Solid>& solids) {
    std::vector<Point2> ends = points(node["line"], *yaml.line);
    if (ends.size() < 2) throw fault(node["line"], "a line needs at least 2 points");
    if (!(yaml.thickness > 0.0)) throw fault(node, "thickness must be > 0");
    if (yaml.closed) ends.push_back(ends.front());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double length = distance(ends[i], ends[i + 1]);
      if (length < 1e-6) throw fault(node["line"], "two points of the line are the same");
      const Point2 along = (0.5 * yaml.thickness / length) * (ends[i + 1] - ends[i]);
      const Point2 left{-along.y, along.x};
      const Point2 from = ends[i] - along;
      const Point2 to = ends[i + 1] + along;
      solid.id = ends.size() == 2 ? yaml.id : yaml.id + "-" + std::to_string(i + 1);
      solid.polygon = {from - left, to - left, to + left, from + left};
      add(node, solid, solids);
    }
  }

  Polygon box(const YAML::Node& node, const BoxYaml& yaml) const {
    if (!(yaml.length > 0.0) || !(yaml.width > 0.0)) throw fault(node, "length and width must be > 0");
    const Pose2 world_from_box{yaml.x, yaml.y, Angle::degrees(yaml.heading)};
    const double l = 0.5 * yaml.length;
    const double w = 0.5 * yaml.width;
    return {world_from_box * Point2{-l, -w}, world_from_box * Point2{l, -w}, world_from_box * Point2{l, w},
            world_from_box * Point2{-l, w}};
  }

  Polygon circle(const YAML::Node& node, const CircleYaml& yaml) const {
    constexpr int kCorners = 16;
    if (!(yaml.radius > 0.0)) throw fault(node, "radius must be > 0");
    Polygon result;
    for (int i = 0; i < kCorners; ++i) {
      const Point2 corner = unit(Angle::radians(2.0 * std::numbers::pi * i / kCorners));
      result.push_back(Point2{yaml.x, yaml.y} + yaml.radius * corner);
    }
    return result;
  }

  // Walls end at the ceiling above them.
  static void check_walls(World& world) {
    for (Solid& solid : world.solids) {
      if (solid.kind != SolidKind::wall || solid.top != kKinds[0].top) continue;
      for (const Point2 corner : solid.polygon) solid.top = std::max(solid.top, world.ceiling_at(corner));
    }
  }

  const YamlFile& file_;
  const YAML::Node root_;  // const: operator[] of a non-const node would insert
  std::set<std::string> solid_ids_;
  std::set<std::string> attraction_ids_;
  std::set<std::string> mark_ids_;
};

}  // namespace

double World::ceiling_at(Point2 in_world) const {
  double height = ceiling_height;
  for (const auto& part : ceiling) {
    if (contains(part.polygon, in_world)) height = part.height;
  }
  return height;
}

const char* to_string(SolidKind kind) {
  for (const auto& named : kKinds) {
    if (named.kind == kind) return named.name;
  }
  return "?";
}

const char* kind_name(const Solid& solid) {
  for (const auto& named : kKinds)
    if (named.kind == solid.kind && named.form == solid.form) return named.name;
  return "?";
}

const char* to_string(CeilingKind kind) {
  for (const auto& [name, known] : kCeilings)
    if (kind == known) return name;
  return "?";
}

bool is_seen_by_laser(const Solid& solid) {
  return (solid.kind == SolidKind::wall || solid.kind == SolidKind::furniture) && solid.bottom <= kLaserHeight &&
         solid.top > kLaserHeight;
}

Result<World> parse_world(const std::string& text, const std::string& name) {
  auto file = YamlFile::parse(text, name);
  if (!file) return tl::unexpected<Error>(file.error());
  try {
    return WorldParser{*file}.parse();
  } catch (const YamlFault& fault) {
    return tl::unexpected<Error>(fault.error);
  } catch (const YAML::Exception& exception) {
    return fail(name + ":" + std::to_string(exception.mark.line + 1) + ": " + exception.msg);
  }
}

Result<World> load_world(const std::filesystem::path& simulation_yaml) {
  auto text = read_file(simulation_yaml);
  if (!text) return tl::unexpected<Error>(text.error());
  auto world = parse_world(*text, simulation_yaml.string());
  if (!world || world->pedestrians_file.empty()) return world;
  auto pedestrians = load_tracks(simulation_yaml.parent_path() / world->pedestrians_file);
  if (!pedestrians) return tl::unexpected<Error>(pedestrians.error());
  world->pedestrians = std::move(*pedestrians);
  return world;
}

}  // namespace docent::simulator
