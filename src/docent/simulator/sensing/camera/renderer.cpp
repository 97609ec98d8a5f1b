#include "docent/simulator/sensing/camera/renderer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "docent/base/check.h"

namespace docent::simulator {
namespace {

constexpr int kPacket = 8;                        // rays that Embree follows together
constexpr float kNear = 0.05F;                    // [m] nothing nearer than the glass of the lens
constexpr float kFar = 300.0F;                    // [m]
constexpr float kShadow = 4.0F;                   // [m] what is farther from the floor throws none
constexpr Vec3 kLampLight{0.28F, 0.17F, 0.945F};  // where most light comes from, of length 1
constexpr Rgb kNothing{0.30F, 0.33F, 0.36F};
constexpr unsigned kNone = RTC_INVALID_GEOMETRY_ID;

struct Freed {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Freed>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Freed>;

/// What a ray met.
struct Sight {
  unsigned mesh = kNone;
  unsigned triangle = kNone;
  float away = 0.0F;  ///< [m] along the ray
  float u = 0.0F, v = 0.0F;
  bool in_shadow = false;
};

Vec3 mix(Vec3 a, Vec3 b, Vec3 c, float u, float v) { return (1.0F - u - v) * a + u * b + v * c; }
std::array<float, 2> mix(std::array<float, 2> a, std::array<float, 2> b, std::array<float, 2> c, float u, float v) {
  const float w = 1.0F - u - v;
  return {w * a[0] + u * b[0] + v * c[0], w * a[1] + u * b[1] + v * c[1]};
}

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

/// std::floor for what lies in a museum; without SSE4.1 that is a call.
float below(float x) {
  const auto whole = static_cast<float>(static_cast<int>(x));
  return whole > x ? whole - 1.0F : whole;
}

float to_linear(std::uint8_t byte) {
  const float x = static_cast<float>(byte) / 255.0F;
  return x * x;
}

/// The picture's plane: where a ray through a place on it goes.
class Aim {
 public:
  explicit Aim(const Lens& lens) : lens_{lens} {
    const auto c = [](double a) { return static_cast<float>(std::cos(a)); };
    const auto s = [](double a) { return static_cast<float>(std::sin(a)); };
    ahead_ = {c(lens.pan) * c(lens.tilt), s(lens.pan) * c(lens.tilt), s(lens.tilt)};
    right_ = {s(lens.pan), -c(lens.pan), 0.0F};
    up_ = cross(right_, ahead_);
    scale_ = static_cast<float>(2.0 * std::tan(0.5 * lens.field_of_view) / lens.width);
  }
  /// Through a place in pixels from the upper left corner; not of length 1.
  [[nodiscard]] Vec3 through(float x, float y) const {
    const float across = scale_ * (x - 0.5F * static_cast<float>(lens_.width));
    const float upwards = scale_ * (0.5F * static_cast<float>(lens_.height) - y);
    return ahead_ + across * right_ + upwards * up_;
  }

 private:
  const Lens& lens_;
  Vec3 ahead_, right_, up_;
  float scale_ = 0.0F;
};

}  // namespace

class Renderer::Impl {
 public:
  Impl() : device_{rtcNewDevice("threads=1,set_affinity=0,isa=sse2")} { DOCENT_CHECK(device_ != nullptr); }

  void set(unsigned index, Mesh mesh, RTCBuildQuality quality) {
    meshes_[index] = std::move(mesh);
    const Mesh& m = meshes_[index];
    Scene scene{rtcNewScene(device_.get())};
    rtcSetSceneBuildQuality(scene.get(), quality);
    if (!m.triangles.empty()) {
      RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
      rtcSetGeometryBuildQuality(geometry, quality);
      std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                          m.points.size()),
                  m.points.data(), m.points.size() * sizeof(Vec3));
      std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), m.triangles.size()),
                  m.triangles.data(), m.triangles.size() * 3 * sizeof(std::uint32_t));
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(scene.get(), geometry, index);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene.get());
    DOCENT_CHECK(rtcGetDeviceError(device_.get()) == RTC_ERROR_NONE);
    scenes_[index] = std::move(scene);
  }
  void set_posters(std::vector<pictures::Image> posters) { posters_ = std::move(posters); }

  pictures::Image draw(const Lens& lens) const {
    const Aim aim{lens};
    const auto pixels = static_cast<std::size_t>(lens.width) * static_cast<std::size_t>(lens.height);
    std::vector<Sight> sights(pixels);
    std::vector<Rgb> light(pixels);
    look_through_all(lens, aim, sights, light);
    soften_edges(lens, aim, sights, light);
    static const Gamma kGamma;
    pictures::Image image{lens.width, lens.height, pictures::colors::kBlack};
    const auto bytes = image.writable_bytes();
    for (std::size_t i = 0; i < pixels; ++i) {
      bytes[4 * i] = kGamma(light[i].red);
      bytes[4 * i + 1] = kGamma(light[i].green);
      bytes[4 * i + 2] = kGamma(light[i].blue);
    }
    return image;
  }

 private:
  using Rays = std::array<Vec3, kPacket>;
  using Sights = std::array<Sight, kPacket>;

  void look_through_all(const Lens& lens, const Aim& aim, std::vector<Sight>& sights, std::vector<Rgb>& light) const {
    for (int y = 0; y < lens.height; y += 2) {
      for (int x = 0; x < lens.width; x += 4) {  // blocks of 4 x 2: neighbours go the same way
        Rays rays;
        for (int i = 0; i < kPacket; ++i)
          rays[static_cast<std::size_t>(i)] =
              aim.through(static_cast<float>(x + i % 4) + 0.5F, static_cast<float>(y + i / 4) + 0.5F);
        const Sights met = look(lens.eye, rays);
        for (int i = 0; i < kPacket; ++i) {
          if (x + i % 4 >= lens.width || y + i / 4 >= lens.height) continue;
          const auto at = static_cast<std::size_t>(y + i / 4) * static_cast<std::size_t>(lens.width) +
                          static_cast<std::size_t>(x + i % 4);
          sights[at] = met[static_cast<std::size_t>(i)];
          light[at] = shade(lens.eye, rays[static_cast<std::size_t>(i)], sights[at]);
        }
      }
    }
  }

  /// Four rays more through each pixel whose right or lower neighbour sees another thing.
  void soften_edges(const Lens& lens, const Aim& aim, const std::vector<Sight>& sights, std::vector<Rgb>& light) const {
    const auto width = static_cast<std::size_t>(lens.width);
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
        rays[i] = aim.through(static_cast<float>(at % width) + kParts[i % 4][0],
                              static_cast<float>(at / width) + kParts[i % 4][1]);
      }
      const Sights met = look(lens.eye, rays);
      for (std::size_t k = 0; k < count; ++k) {
        Rgb sum;
        for (std::size_t i = 0; i < 4; ++i) sum = sum + shade(lens.eye, rays[4 * k + i], met[4 * k + i]);
        light[edges[first + k]] = 0.25F * sum;
      }
    }
  }

  [[nodiscard]] bool differ(const Sight& a, const Sight& b) const {
    if (a.mesh != b.mesh || a.in_shadow != b.in_shadow) return true;
    if (a.mesh == kNone || a.triangle == b.triangle) return false;
    const Look& first = meshes_[a.mesh].surfaces[a.triangle];
    const Look& second = meshes_[b.mesh].surfaces[b.triangle];
    return first.color.red != second.color.red || first.finish != second.finish || first.poster != second.poster ||
           std::abs(a.away - b.away) > 0.2F || dot(normal_of(a), normal_of(b)) < 0.9F;
  }

  [[nodiscard]] Sights look(Vec3 eye, const Rays& rays) const {
    alignas(32) RTCRayHit8 packet;
    alignas(32) std::array<int, kPacket> all;
    all.fill(-1);
    for (std::size_t i = 0; i < kPacket; ++i) {
      packet.ray.org_x[i] = eye.x, packet.ray.org_y[i] = eye.y, packet.ray.org_z[i] = eye.z;
      packet.ray.dir_x[i] = rays[i].x, packet.ray.dir_y[i] = rays[i].y, packet.ray.dir_z[i] = rays[i].z;
      packet.ray.tnear[i] = kNear, packet.ray.tfar[i] = kFar, packet.ray.time[i] = 0.0F;
      packet.ray.mask[i] = ~0U, packet.ray.id[i] = 0, packet.ray.flags[i] = 0;
      packet.hit.geomID[i] = kNone, packet.hit.primID[i] = kNone, packet.hit.instID[0][i] = kNone;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (const Scene& scene : scenes_)
      if (scene) rtcIntersect8(all.data(), scene.get(), &context, &packet);
    Sights met;
    for (std::size_t i = 0; i < kPacket; ++i)
      met[i] = {packet.hit.geomID[i], packet.hit.primID[i], packet.ray.tfar[i],
                packet.hit.u[i],      packet.hit.v[i],      false};
    throw_shadows(eye, rays, met);
    return met;
  }

  /// Which of the places on the floor lie in the shadow of what moves, or of furniture.
  void throw_shadows(Vec3 eye, const Rays& rays, Sights& met) const {
    alignas(32) RTCRay8 packet;
    alignas(32) std::array<int, kPacket> some;
    bool any = false;
    for (std::size_t i = 0; i < kPacket; ++i) {
      const bool on_floor = met[i].mesh == 0 && surface_of(met[i]).finish == Finish::tiles;
      some[i] = on_floor ? -1 : 0;
      any = any || on_floor;
      const Vec3 from = eye + met[i].away * rays[i];
      packet.org_x[i] = from.x, packet.org_y[i] = from.y, packet.org_z[i] = from.z + 0.01F;
      packet.dir_x[i] = kLampLight.x, packet.dir_y[i] = kLampLight.y, packet.dir_z[i] = kLampLight.z;
      packet.tnear[i] = 0.0F, packet.tfar[i] = kShadow, packet.time[i] = 0.0F;
      packet.mask[i] = ~0U, packet.id[i] = 0, packet.flags[i] = 0;
    }
    if (!any || !scenes_[1]) return;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded8(some.data(), scenes_[1].get(), &context, &packet);
    for (std::size_t i = 0; i < kPacket; ++i)
      met[i].in_shadow = some[i] != 0 && packet.tfar[i] < 0.0F;  // -infinity: something is in between
  }

  [[nodiscard]] const Look& surface_of(const Sight& sight) const {
    return meshes_[sight.mesh].surfaces[sight.triangle];
  }
  [[nodiscard]] Vec3 normal_of(const Sight& sight) const {
    const Mesh& mesh = meshes_[sight.mesh];
    const auto& corners = mesh.triangles[sight.triangle];
    return mix(mesh.normals[corners[0]], mesh.normals[corners[1]], mesh.normals[corners[2]], sight.u, sight.v);
  }

  [[nodiscard]] Rgb shade(Vec3 eye, Vec3 ray, const Sight& sight) const {
    if (sight.mesh == kNone) return kNothing;
    const Look& surface = surface_of(sight);
    const Vec3 at = eye + sight.away * ray;
    Vec3 normal = normalized(normal_of(sight));
    const Vec3 towards = normalized(-1.0F * ray);
    if (dot(normal, towards) < 0.0F) normal = -1.0F * normal;
    const Rgb color = color_at(surface, sight, at);
    if (surface.finish == Finish::ceiling || surface.finish == Finish::poster) return color;
    // Light of all directions, more from above; the lamps'; and a little along the view, so that forms show.
    const float around = 0.50F + 0.18F * normal.z;
    const float lamps = sight.in_shadow ? 0.0F : 0.42F * std::max(0.0F, dot(normal, kLampLight));
    const float along = 0.16F * std::max(0.0F, dot(normal, towards));
    return (around + lamps + along) * color;
  }

  [[nodiscard]] Rgb color_at(const Look& surface, const Sight& sight, Vec3 at) const {
    const auto parted = [](float x, float step, float line) {
      const float parts = x * (1.0F / step);
      return parts - below(parts) < line * (1.0F / step);
    };
    switch (surface.finish) {
      case Finish::plain:
        return surface.color;
      case Finish::tiles: {  // of 0.6 m, every other one a little darker
        if (parted(at.x, 0.6F, 0.012F) || parted(at.y, 0.6F, 0.012F)) return 0.72F * surface.color;
        const bool dark = (static_cast<int>(below(at.x / 0.6F)) + static_cast<int>(below(at.y / 0.6F))) % 2 == 0;
        return (dark ? 0.92F : 1.0F) * surface.color;
      }
      case Finish::wall:  // a skirting board
        return at.z < 0.1F ? 0.4F * surface.color : surface.color;
      case Finish::ceiling:  // a lamp of 1.2 x 0.3 m every 3 m
        return parted(at.x, 3.0F, 1.2F) && parted(at.y, 3.0F, 0.3F) ? Rgb{1.0F, 1.0F, 0.97F} : 0.72F * surface.color;
      case Finish::poster:
        return poster_at(surface, sight);
    }
    return surface.color;
  }

  [[nodiscard]] Rgb poster_at(const Look& surface, const Sight& sight) const {
    const pictures::Image& poster = posters_[static_cast<std::size_t>(surface.poster)];
    const Mesh& mesh = meshes_[sight.mesh];
    const auto& corners = mesh.triangles[sight.triangle];
    const auto place = mix(mesh.places[corners[0]], mesh.places[corners[1]], mesh.places[corners[2]], sight.u, sight.v);
    const int x = std::clamp(static_cast<int>(place[0] * static_cast<float>(poster.width())), 0, poster.width() - 1);
    const int y = std::clamp(static_cast<int>(place[1] * static_cast<float>(poster.height())), 0, poster.height() - 1);
    const auto pixel = poster.bytes().subspan(
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(poster.width()) + static_cast<std::size_t>(x)), 3);
    return {to_linear(pixel[0]), to_linear(pixel[1]), to_linear(pixel[2])};
  }

  Device device_;
  std::array<Scene, 2> scenes_;  ///< what stands still, what moves; freed before the device
  std::array<Mesh, 2> meshes_;
  std::vector<pictures::Image> posters_;
};

Renderer::Renderer() : impl_{std::make_unique<Impl>()} {}
Renderer::~Renderer() = default;

void Renderer::set_furnishing(Furnishing furnishing) {
  impl_->set(0, std::move(furnishing.mesh), RTC_BUILD_QUALITY_MEDIUM);
  impl_->set_posters(std::move(furnishing.posters));
}

void Renderer::set_figures(Mesh figures) { impl_->set(1, std::move(figures), RTC_BUILD_QUALITY_LOW); }

pictures::Image Renderer::draw(const Lens& lens) const { return impl_->draw(lens); }

}  // namespace docent::simulator
