#include "docent/simulator/sensing/camera/things/marks.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <cmath>
#include <memory>

#include "docent/base/check.h"

namespace docent::simulator {
namespace {

constexpr double kCellsAcross = 10.0;  // of the paper: white, black, six of the code, black, white
constexpr double kCellsOfSize = 8.0;   // of the black square
constexpr float kThick = 0.004F;       // [m] before what it sticks on

struct TagFreed {
  void operator()(apriltag_family_t* family) const { tag36h11_destroy(family); }
  void operator()(image_u8_t* image) const { image_u8_destroy(image); }
};

}  // namespace

pictures::Image picture_of_tag(int tag) {
  const std::unique_ptr<apriltag_family_t, TagFreed> family{tag36h11_create()};
  DOCENT_CHECK(tag >= 0 && tag < static_cast<int>(family->ncodes));
  const std::unique_ptr<image_u8_t, TagFreed> cells{apriltag_to_image(family.get(), tag)};
  pictures::Image image{cells->width, cells->height};
  for (int y = 0; y < cells->height; ++y)
    for (int x = 0; x < cells->width; ++x) {
      const std::uint8_t shade = cells->buf[y * cells->stride + x] > 127 ? 235 : 30;  // paper and toner
      image.set(x, y, {shade, shade, shade});
    }
  return image;
}

void add_mark(Mesh& mesh, const Mark& mark, std::int16_t poster) {
  const auto c = [](double a) { return static_cast<float>(std::cos(a)); };
  const auto s = [](double a) { return static_cast<float>(std::sin(a)); };
  const double h = mark.heading.radians(), t = mark.tilt;
  const Vec3 out{c(h) * c(t), s(h) * c(t), s(t)}, up{-c(h) * s(t), -s(h) * s(t), c(t)};
  const auto half = static_cast<float>(0.5 * mark.size * kCellsAcross / kCellsOfSize);
  const Vec3 right = half * cross(up, out), upwards = half * up;
  const Vec3 middle = lifted(mark.position, mark.height) + kThick * out;
  add_quad(mesh,
           {middle - right + upwards, middle - right - upwards, middle + right - upwards, middle + right + upwards},
           {{1.0F, 1.0F, 1.0F}, Finish::poster, poster});
}

}  // namespace docent::simulator
