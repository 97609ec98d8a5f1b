#include "docent/simulator/sensing/camera/furnishing.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "docent/base/random.h"
#include "docent/pictures/canvas.h"
#include "docent/simulator/sensing/camera/ceiling/ceiling_design.h"
#include "docent/simulator/sensing/camera/ceiling/ceiling_mesh.h"
#include "docent/simulator/sensing/camera/mesh/level_parts.h"
#include "docent/simulator/sensing/camera/things/litter.h"
#include "docent/simulator/sensing/camera/things/marks.h"
#include "docent/simulator/sensing/camera/things/stairs.h"

namespace docent::simulator {
namespace {

constexpr Rgb kWall{0.74F, 0.72F, 0.67F};
constexpr Rgb kFloor{0.42F, 0.40F, 0.37F};
constexpr Rgb kFrame{0.20F, 0.22F, 0.24F};
constexpr Rgb kPlate{0.45F, 0.47F, 0.50F};
constexpr double kMargin = 3.0;  // [m] of floor and ceiling outside the outer walls

Rgb mixed(Rgb a, Rgb b, float share) { return (1.0F - share) * a + share * b; }

/// Something a person may read: "electron-microscope" is "Electron microscope".
std::string spelled(std::string id) {
  std::replace(id.begin(), id.end(), '-', ' ');
  if (!id.empty()) id.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(id.front())));
  return id;
}

std::uint8_t byte_of(float linear) {
  return static_cast<std::uint8_t>(std::lround(255.0F * std::pow(std::clamp(linear, 0.0F, 1.0F), 1.0F / 2.2F)));
}

/// The sign of an attraction: its name in white on its colour.
pictures::Image sign(const std::string& name) {
  constexpr int kWidth = 256, kHeight = 96;
  const Rgb color = color_of(name);
  const std::unique_ptr<cairo_surface_t, pictures::CairoDeleter> surface{
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, kWidth, kHeight)};
  const std::unique_ptr<cairo_t, pictures::CairoDeleter> context{cairo_create(surface.get())};
  pictures::Canvas canvas{context.get()};
  canvas.fill_rectangle({0, 0}, {kWidth, kHeight}, {byte_of(color.red), byte_of(color.green), byte_of(color.blue)});
  canvas.fill_rectangle({0, kHeight - 10}, {kWidth, kHeight}, pictures::colors::kWhite);
  const std::string text = spelled(name);
  pictures::TextStyle style{.size = 48.0, .color = pictures::colors::kWhite, .anchor = {0.5, 0.5}, .bold = true};
  style.size = std::min(style.size, style.size * (kWidth - 20.0) / std::max(1.0, pictures::text_size(text, style).x));
  canvas.draw_text({kWidth / 2.0, (kHeight - 10) / 2.0}, text, style);
  cairo_surface_flush(surface.get());
  pictures::Image image{kWidth, kHeight};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const unsigned char* pixel = pictures::pixel_of(surface.get(), x, y);  // blue, green, red, alpha
      image.set(x, y, {pixel[2], pixel[1], pixel[0]});
    }
  return image;
}

class Furnisher {
 public:
  explicit Furnisher(const World& world) : world_{world} {}

  Furnishing furnish() {
    add_floor_and_ceiling();
    for (const Solid& solid : world_.solids) add(solid);
    for (const Attraction& attraction : world_.attractions)
      if (is_exhibit(attraction.id)) add_sign(attraction);
    for (const Mark& mark : world_.marks) {
      add_mark(made_.mesh, mark, static_cast<std::int16_t>(made_.posters.size()));
      made_.posters.push_back(picture_of_tag(mark.tag));
    }
    return std::move(made_);
  }

 private:
  [[nodiscard]] bool is_exhibit(const std::string& id) const {
    return std::find(world_.exhibits.begin(), world_.exhibits.end(), id) != world_.exhibits.end();
  }

  void add_floor_and_ceiling() {
    Point2 low{1e9, 1e9}, high{-1e9, -1e9};
    for (const Point2 p : world_.floor) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    low = low - Point2{kMargin, kMargin};
    high = high + Point2{kMargin, kMargin};
    std::vector<Polygon> holes;
    for (const Solid& solid : world_.solids)
      if (solid.kind == SolidKind::stairs) holes.push_back(solid.polygon);
    for (const LevelParts::Piece& piece : level_parts(low, high, holes).pieces)
      if (piece.owner < 0)
        add_level(made_.mesh, {piece.corners.begin(), piece.corners.end()}, 0.0, true, {kFloor, Finish::tiles});
    made_.ceiling = design_ceiling(world_);
    made_.light = CeilingLight{made_.ceiling, low, high};
    add_ceiling(made_.mesh, made_.ceiling, low, high);
  }

  void add(const Solid& solid) {
    Mesh& mesh = made_.mesh;
    const Rgb own = color_of(solid.id);
    if (solid.form != SolidForm::prism) return add_litter(mesh, solid);
    switch (solid.kind) {
      case SolidKind::wall: {
        // Walls reach the ceiling wherever it is.
        const double top = std::max(solid.top, world_.ceiling_height);
        const Look surface{mixed(kWall, own, 0.18F), Finish::wall};
        return add_prism(mesh, solid.polygon, solid.bottom, top, surface, surface);
      }
      case SolidKind::furniture:
        return add_prism(mesh, solid.polygon, solid.bottom, solid.top, {own}, {mixed(own, {1.0F, 1.0F, 1.0F}, 0.3F)});
      case SolidKind::plate:
        return add_prism(mesh, solid.polygon, solid.bottom, solid.top, {kPlate}, {kPlate});
      case SolidKind::stairs:
        return add_stairs(mesh, solid, world_);
      case SolidKind::glass:
        return add_frame(solid);
    }
  }

  /// What one sees of a glass case: posts at its corners, a rim above, a plinth.
  void add_frame(const Solid& solid) {
    add_prism(made_.glass, solid.polygon, solid.bottom, solid.top, {}, {});
    constexpr double kBar = 0.02;                                                      // [m] thick
    const std::size_t step = solid.polygon.size() > 8 ? solid.polygon.size() / 8 : 1;  // few posts round a circle
    for (std::size_t i = 0; i < solid.polygon.size(); i += step)
      add_limb(made_.mesh, lifted(solid.polygon[i], solid.bottom), lifted(solid.polygon[i], solid.top), kBar, kBar,
               {kFrame}, 4);
    for (const auto& [a, b] : sides(solid.polygon)) {
      add_limb(made_.mesh, lifted(a, solid.top), lifted(b, solid.top), kBar, kBar, {kFrame}, 4);
      add_quad(made_.mesh,
               {lifted(a, solid.bottom + 0.12), lifted(a, solid.bottom), lifted(b, solid.bottom),
                lifted(b, solid.bottom + 0.12)},
               {kFrame});
    }
  }

  /// Four panels under the ceiling in a square, so that each side of the hall can read one.
  void add_sign(const Attraction& attraction) {
    constexpr double kHalf = 0.65, kTall = 0.49, kGap = 0.25;  // [m]
    const auto poster = static_cast<std::int16_t>(made_.posters.size());
    made_.posters.push_back(sign(attraction.id));
    const double ceiling = std::max(2.6, world_.ceiling_at(attraction.centre));
    const double top = std::min(ceiling - kGap, 2.9);
    for (int i = 0; i < 4; ++i) {
      const double angle = std::numbers::pi / 2.0 * i + 0.4;
      const Point2 out = unit(Angle::radians(angle));
      const Point2 along{-out.y, out.x};
      const Point2 middle = attraction.centre + kHalf * out;
      const Point2 left = middle - kHalf * along, right = middle + kHalf * along;
      add_quad(made_.mesh,
               {lifted(left, top), lifted(left, top - kTall), lifted(right, top - kTall), lifted(right, top)},
               {{1.0F, 1.0F, 1.0F}, Finish::poster, poster});
    }
  }

  const World& world_;
  Furnishing made_;
};

}  // namespace

Rgb color_of(const std::string& name) {
  constexpr std::array<Rgb, 12> kColors{{{0.50F, 0.06F, 0.05F},
                                         {0.05F, 0.18F, 0.48F},
                                         {0.06F, 0.32F, 0.14F},
                                         {0.62F, 0.30F, 0.03F},
                                         {0.30F, 0.08F, 0.36F},
                                         {0.04F, 0.33F, 0.36F},
                                         {0.46F, 0.36F, 0.06F},
                                         {0.48F, 0.10F, 0.24F},
                                         {0.16F, 0.20F, 0.26F},
                                         {0.24F, 0.14F, 0.08F},
                                         {0.20F, 0.38F, 0.06F},
                                         {0.10F, 0.10F, 0.42F}}};
  return kColors[hash_of(name) % kColors.size()];
}

Furnishing furnish(const World& world) { return Furnisher{world}.furnish(); }

}  // namespace docent::simulator
