#include "docent/simulator/sensing/camera/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "docent/simulator/sensing/camera/shading.h"
#include "docent/simulator/sensing/camera/traced_scene.h"

namespace docent::simulator {
namespace {

using Sight = TracedScene::Sight;
using Rays = TracedScene::Rays;
using Sights = TracedScene::Sights;
constexpr std::size_t kPacket = TracedScene::kPacket;

/// A table of what the eye makes of linear light, 0..1 in 1023 steps.
class Gamma {
 public:
  Gamma() {
    for (std::size_t i = 0; i < table_.size(); ++i)
      table_[i] = static_cast<std::uint8_t>(
          std::lround(255.0 * std::pow(static_cast<double>(i) / static_cast<double>(table_.size() - 1), 1.0 / 2.2)));
  }
  [[nodiscard]] std::uint8_t operator()(float linear) const {
    const float scaled = std::clamp(linear, 0.0F, 1.0F) * static_cast<float>(table_.size() - 1);
    return table_[static_cast<std::size_t>(std::lround(scaled))];
  }

 private:
  std::array<std::uint8_t, 1024> table_{};
};

/// A camera's rays in the world.
class Aim {
 public:
  Aim(const Viewpoint& viewpoint, const RayTable& lens) : viewpoint_{viewpoint}, lens_{lens} {}
  [[nodiscard]] Vec3 eye() const { return viewpoint_.eye; }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(lens_.width()) + static_cast<std::size_t>(x);
  }
  /// Of length nearly 1; {0, 0, 0} where the lens lets no light in.
  [[nodiscard]] Vec3 through(int x, int y, float u = 0.5F, float v = 0.5F) const {
    return lens_.sees(x, y) ? viewpoint_.to_world(lens_.through(x, y, u, v)) : Vec3{};
  }
  /// Calls `use(rays, places)` for blocks of 4 x 2 pixels, whose rays go the same way; a place is -1 beyond the edge.
  template <class Use>
  void for_blocks(const Use& use) const {
    for (int y = 0; y < lens_.height(); y += 2)
      for (int x = 0; x < lens_.width(); x += 4) {
        Rays rays;
        std::array<std::ptrdiff_t, kPacket> places;
        for (int i = 0; i < static_cast<int>(kPacket); ++i) {
          const int column = x + i % 4, row = y + i / 4;
          const bool is_in = column < lens_.width() && row < lens_.height();
          rays[static_cast<std::size_t>(i)] = is_in ? through(column, row) : Vec3{};
          places[static_cast<std::size_t>(i)] = is_in ? static_cast<std::ptrdiff_t>(index(column, row)) : -1;
        }
        use(rays, places);
      }
  }

 private:
  const Viewpoint& viewpoint_;
  const RayTable& lens_;
};

}  // namespace

class Renderer::Impl {
 public:
  void set(Furnishing furnishing) {
    scene_.set(TracedScene::still, std::move(furnishing.mesh), false);
    scene_.set(TracedScene::glass, std::move(furnishing.glass), false);
    posters_ = std::move(furnishing.posters);
    ceiling_ = std::move(furnishing.ceiling);
    light_ = std::move(furnishing.light);
  }
  void set(Mesh figures) { scene_.set(TracedScene::moving, std::move(figures), true); }

  /// With what a sensor has to know of its rays.
  RawPicture expose(const Viewpoint& viewpoint, const RayTable& lens, const Lighting& lighting) const {
    RawPicture raw = light_on(viewpoint, lens, lighting);
    raw.where.resize(raw.light.size());
    for (int y = 0; y < lens.height(); ++y)
      for (int x = 0; x < lens.width(); ++x)
        if (lens.sees(x, y))
          raw.where[static_cast<std::size_t>(y) * static_cast<std::size_t>(lens.width()) +
                    static_cast<std::size_t>(x)] = lens.through(x, y, 0.5F, 0.5F);
    return raw;
  }

  RawPicture light_on(const Viewpoint& viewpoint, const RayTable& lens, const Lighting& lighting) const {
    const Aim aim{viewpoint, lens};
    const CeilingLight::Field light = light_.field(lighting);
    const Shading shading{scene_, ceiling_, posters_, light, lens.pixel_angle()};
    const auto pixels = static_cast<std::size_t>(lens.width()) * static_cast<std::size_t>(lens.height());
    RawPicture raw{lens.width(), lens.height(), std::vector<Rgb>(pixels), {}};
    std::vector<Sight> sights(pixels);
    aim.for_blocks([&](const Rays& rays, const std::array<std::ptrdiff_t, kPacket>& places) {
      const Sights met = scene_.look(aim.eye(), rays);
      for (std::size_t i = 0; i < kPacket; ++i) {
        if (places[i] < 0 || dot(rays[i], rays[i]) == 0.0F) continue;
        const auto at = static_cast<std::size_t>(places[i]);
        sights[at] = met[i];
        raw.light[at] = shading.shade(aim.eye(), rays[i], met[i]);
      }
    });
    soften_edges(aim, shading, sights, raw);
    return raw;
  }

  RawDepth probe(const Viewpoint& viewpoint, const RayTable& lens, double baseline) const {
    const Aim aim{viewpoint, lens};
    const CeilingLight::Field light = light_.field({});
    const Shading shading{scene_, ceiling_, posters_, light, lens.pixel_angle()};
    const Vec3 projector = viewpoint.eye + static_cast<float>(baseline) * viewpoint.right;
    RawDepth raw{lens.width(), lens.height(), {}};
    raw.meetings.resize(static_cast<std::size_t>(lens.width()) * static_cast<std::size_t>(lens.height()));
    aim.for_blocks([&](const Rays& rays, const std::array<std::ptrdiff_t, kPacket>& places) {
      const Sights met = scene_.look(aim.eye(), rays);
      const auto panes = scene_.glass_before(aim.eye(), rays, met);
      const auto reached = scene_.is_reached(projector, aim.eye(), rays, met);
      for (std::size_t i = 0; i < kPacket; ++i) {
        if (places[i] < 0 || met[i].layer == TracedScene::kNone) continue;
        RawDepth::Meeting& meeting = raw.meetings[static_cast<std::size_t>(places[i])];
        const float ahead = dot(rays[i], viewpoint.ahead);
        meeting.z = ahead * met[i].away;
        meeting.glass = ahead * panes[i];
        meeting.slant = std::abs(dot(normalized(scene_.normal_of(met[i])), rays[i]));
        const Rgb color = shading.color_at(met[i], aim.eye() + met[i].away * rays[i]);
        meeting.brightness = color.red;  // the pattern is infrared
        meeting.is_lit = reached[i];
      }
    });
    return raw;
  }

  pictures::Image draw(const Lens& lens, const Lighting& lighting) const {
    const RayTable rays{plain_lens(lens.width, lens.height, lens.field_of_view)};
    const RawPicture raw = light_on(viewpoint_at(lens.eye, lens.pan, lens.tilt), rays, lighting);
    static const Gamma kGamma;
    pictures::Image image{lens.width, lens.height, pictures::colors::kBlack};
    const auto bytes = image.writable_bytes();
    for (std::size_t i = 0; i < raw.light.size(); ++i) {
      bytes[4 * i] = kGamma(raw.light[i].red);
      bytes[4 * i + 1] = kGamma(raw.light[i].green);
      bytes[4 * i + 2] = kGamma(raw.light[i].blue);
    }
    return image;
  }

 private:
  /// Four rays more through each pixel whose right or lower neighbour sees another thing.
  void soften_edges(const Aim& aim, const Shading& shading, const std::vector<Sight>& sights, RawPicture& raw) const {
    const auto width = static_cast<std::size_t>(raw.width);
    std::vector<std::uint32_t> edges;
    for (std::size_t at = 0; at < sights.size(); ++at) {
      const bool right = at % width + 1 < width && differ(sights[at], sights[at + 1]);
      const bool below = at + width < sights.size() && differ(sights[at], sights[at + width]);
      if (right || below) edges.push_back(static_cast<std::uint32_t>(at));
    }
    constexpr std::array<std::array<float, 2>, 4> kParts{
        {{0.125F, 0.375F}, {0.375F, 0.875F}, {0.625F, 0.125F}, {0.875F, 0.625F}}};
    for (std::size_t first = 0; first < edges.size(); first += 2) {  // two pixels are a packet
      const std::size_t count = std::min<std::size_t>(2, edges.size() - first);
      Rays rays;
      for (std::size_t i = 0; i < kPacket; ++i) {
        const std::size_t at = edges[first + std::min(i / 4, count - 1)];
        rays[i] =
            aim.through(static_cast<int>(at % width), static_cast<int>(at / width), kParts[i % 4][0], kParts[i % 4][1]);
      }
      const Sights met = scene_.look(aim.eye(), rays);
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t at = edges[first + k];
        if (dot(rays[4 * k], rays[4 * k]) == 0.0F) continue;
        Rgb sum;
        for (std::size_t i = 0; i < 4; ++i) sum = sum + shading.shade(aim.eye(), rays[4 * k + i], met[4 * k + i]);
        raw.light[at] = 0.25F * sum;
      }
    }
  }

  [[nodiscard]] bool differ(const Sight& a, const Sight& b) const {
    if (a.layer != b.layer || a.in_shadow != b.in_shadow) return true;
    if (a.layer == TracedScene::kNone || a.triangle == b.triangle) return false;
    const Look& first = scene_.look_of(a);
    const Look& second = scene_.look_of(b);
    return first.color.red != second.color.red || first.finish != second.finish || first.part != second.part ||
           std::abs(a.away - b.away) > 0.2F || dot(scene_.normal_of(a), scene_.normal_of(b)) < 0.9F;
  }

  TracedScene scene_;
  std::vector<pictures::Image> posters_;
  Ceiling ceiling_;
  CeilingLight light_;
};

Renderer::Renderer() : impl_{std::make_unique<Impl>()} {}
Renderer::~Renderer() = default;

void Renderer::set_furnishing(Furnishing furnishing) { impl_->set(std::move(furnishing)); }
void Renderer::set_figures(Mesh figures) { impl_->set(std::move(figures)); }

pictures::Image Renderer::draw(const Lens& lens, const Lighting& lighting) const { return impl_->draw(lens, lighting); }

RawPicture Renderer::expose(const Viewpoint& viewpoint, const RayTable& lens, const Lighting& lighting) const {
  return impl_->expose(viewpoint, lens, lighting);
}

RawDepth Renderer::probe(const Viewpoint& viewpoint, const RayTable& lens, double baseline) const {
  return impl_->probe(viewpoint, lens, baseline);
}

}  // namespace docent::simulator
