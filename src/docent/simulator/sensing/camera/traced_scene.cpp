#include "docent/simulator/sensing/camera/traced_scene.h"

#include <embree3/rtcore.h>

#include <cstring>
#include <type_traits>

#include "docent/base/check.h"

namespace docent::simulator {
namespace {

constexpr float kNear = 0.05F;   // [m] nothing nearer than the glass of the lens
constexpr float kFar = 300.0F;   // [m]
constexpr float kShadow = 4.0F;  // [m] what is farther from the floor throws none
constexpr float kOff = 0.01F;    // [m] off a surface, so that it does not hide itself

struct Freed {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Freed>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Freed>;

Vec3 mix(Vec3 a, Vec3 b, Vec3 c, float u, float v) { return (1.0F - u - v) * a + u * b + v * c; }

RTCIntersectContext coherent() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

void put(RTCRay8& packet, std::size_t i, Vec3 from, Vec3 along, float near, float far) {
  packet.org_x[i] = from.x, packet.org_y[i] = from.y, packet.org_z[i] = from.z;
  packet.dir_x[i] = along.x, packet.dir_y[i] = along.y, packet.dir_z[i] = along.z;
  packet.tnear[i] = near, packet.tfar[i] = far, packet.time[i] = 0.0F;
  packet.mask[i] = ~0U, packet.id[i] = 0, packet.flags[i] = 0;
}

using Which = std::array<int, TracedScene::kPacket>;  // -1: the ray counts

}  // namespace

struct TracedScene::Embree {
  Device device{rtcNewDevice("threads=1,set_affinity=0,isa=sse2")};
  std::array<Scene, 3> scenes;  ///< freed before the device
};

TracedScene::TracedScene() : embree_{std::make_unique<Embree>()} { DOCENT_CHECK(embree_->device != nullptr); }
TracedScene::~TracedScene() = default;

void TracedScene::set(Layer layer, Mesh mesh, bool is_brief) {
  const RTCBuildQuality quality = is_brief ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM;
  meshes_[layer] = std::move(mesh);
  const Mesh& m = meshes_[layer];
  const RTCDevice device = embree_->device.get();
  Scene scene{rtcNewScene(device)};
  rtcSetSceneBuildQuality(scene.get(), quality);
  if (!m.triangles.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, quality);
    std::memcpy(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), m.points.size()),
        m.points.data(), m.points.size() * sizeof(Vec3));
    std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                                        m.triangles.size()),
                m.triangles.data(), m.triangles.size() * 3 * sizeof(std::uint32_t));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene.get(), geometry, layer);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene.get());
  DOCENT_CHECK(rtcGetDeviceError(device) == RTC_ERROR_NONE);
  embree_->scenes[layer] = std::move(scene);
}

TracedScene::Sights TracedScene::look(Vec3 eye, const Rays& rays) const {
  alignas(32) RTCRayHit8 packet;
  alignas(32) Which which;
  for (std::size_t i = 0; i < kPacket; ++i) {
    which[i] = dot(rays[i], rays[i]) > 0.0F ? -1 : 0;
    put(packet.ray, i, eye, rays[i], kNear, kFar);
    packet.hit.geomID[i] = kNone, packet.hit.primID[i] = kNone, packet.hit.instID[0][i] = kNone;
  }
  RTCIntersectContext context = coherent();
  for (const Layer layer : {still, moving})
    if (const Scene& scene = embree_->scenes[layer]) rtcIntersect8(which.data(), scene.get(), &context, &packet);
  Sights met;
  for (std::size_t i = 0; i < kPacket; ++i)
    met[i] = {packet.hit.geomID[i], packet.hit.primID[i], packet.ray.tfar[i], packet.hit.u[i], packet.hit.v[i], false};
  throw_shadows(eye, rays, met);
  return met;
}

void TracedScene::throw_shadows(Vec3 eye, const Rays& rays, Sights& met) const {
  alignas(32) RTCRay8 packet;
  alignas(32) Which some;
  bool any = false;
  for (std::size_t i = 0; i < kPacket; ++i) {
    const bool on_floor = met[i].layer == still && look_of(met[i]).finish == Finish::tiles;
    some[i] = on_floor ? -1 : 0;
    any = any || on_floor;
    const Vec3 from = eye + met[i].away * rays[i];
    put(packet, i, {from.x, from.y, from.z + kOff}, kLampLight, 0.0F, kShadow);
  }
  const Scene& scene = embree_->scenes[moving];
  if (!any || !scene) return;
  RTCIntersectContext context = coherent();
  rtcOccluded8(some.data(), scene.get(), &context, &packet);
  for (std::size_t i = 0; i < kPacket; ++i)
    met[i].in_shadow = some[i] != 0 && packet.tfar[i] < 0.0F;  // -infinity: something is in between
}

std::array<float, TracedScene::kPacket> TracedScene::glass_before(Vec3 eye, const Rays& rays, const Sights& met) const {
  std::array<float, kPacket> panes{};
  const Scene& scene = embree_->scenes[glass];
  if (!scene) return panes;
  alignas(32) RTCRayHit8 packet;
  alignas(32) Which which;
  for (std::size_t i = 0; i < kPacket; ++i) {
    which[i] = dot(rays[i], rays[i]) > 0.0F ? -1 : 0;
    put(packet.ray, i, eye, rays[i], kNear, met[i].layer == kNone ? kFar : met[i].away);
    packet.hit.geomID[i] = kNone, packet.hit.primID[i] = kNone, packet.hit.instID[0][i] = kNone;
  }
  RTCIntersectContext context = coherent();
  rtcIntersect8(which.data(), scene.get(), &context, &packet);
  for (std::size_t i = 0; i < kPacket; ++i)
    if (packet.hit.geomID[i] != kNone) panes[i] = packet.ray.tfar[i];
  return panes;
}

std::array<bool, TracedScene::kPacket> TracedScene::is_reached(Vec3 from, Vec3 eye, const Rays& rays,
                                                               const Sights& met) const {
  alignas(32) RTCRay8 packet;
  alignas(32) Which which;
  for (std::size_t i = 0; i < kPacket; ++i) {
    which[i] = met[i].layer == kNone ? 0 : -1;
    const Vec3 way = eye + met[i].away * rays[i] - from;
    const float length = std::sqrt(dot(way, way));
    put(packet, i, from, (1.0F / std::max(length, 1e-6F)) * way, kNear, length - kOff);
  }
  RTCIntersectContext context = coherent();
  for (const Layer layer : {still, moving})
    if (const Scene& scene = embree_->scenes[layer]) rtcOccluded8(which.data(), scene.get(), &context, &packet);
  std::array<bool, kPacket> reached{};
  for (std::size_t i = 0; i < kPacket; ++i) reached[i] = which[i] != 0 && packet.tfar[i] > 0.0F;
  return reached;
}

Vec3 TracedScene::normal_of(const Sight& sight) const {
  const Mesh& mesh = meshes_[sight.layer];
  const auto& corners = mesh.triangles[sight.triangle];
  return mix(mesh.normals[corners[0]], mesh.normals[corners[1]], mesh.normals[corners[2]], sight.u, sight.v);
}

std::array<float, 2> TracedScene::place_of(const Sight& sight) const {
  const Mesh& mesh = meshes_[sight.layer];
  const auto& corners = mesh.triangles[sight.triangle];
  const auto &a = mesh.places[corners[0]], &b = mesh.places[corners[1]], &c = mesh.places[corners[2]];
  const float w = 1.0F - sight.u - sight.v;
  return {w * a[0] + sight.u * b[0] + sight.v * c[0], w * a[1] + sight.u * b[1] + sight.v * c[1]};
}

}  // namespace docent::simulator
