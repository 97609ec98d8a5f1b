#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "docent/simulator/sensing/camera/mesh/mesh.h"

namespace docent::simulator {

/// Three meshes that rays meet, by Embree, whose arithmetic is bound to SSE2: the same rays meet the same on every CPU.
class TracedScene {
 public:
  static constexpr int kPacket = 8;  ///< rays that are followed together
  enum Layer : unsigned {
    still,  ///< what stands still
    moving,
    glass,  ///< panes, which only `glass_before` meets
  };
  static constexpr unsigned kNone = ~0U;

  /// What a ray met.
  struct Sight {
    unsigned layer = kNone;
    unsigned triangle = kNone;
    float away = 0.0F;  ///< in lengths of the ray
    float u = 0.0F, v = 0.0F;
    bool in_shadow = false;
  };
  using Rays = std::array<Vec3, kPacket>;
  using Sights = std::array<Sight, kPacket>;

  TracedScene();
  ~TracedScene();
  TracedScene(const TracedScene&) = delete;
  TracedScene& operator=(const TracedScene&) = delete;

  /// O(n log n). @param is_brief  it will soon be another: built faster, traced more slowly
  void set(Layer layer, Mesh mesh, bool is_brief);
  [[nodiscard]] const Mesh& mesh(unsigned layer) const { return meshes_[layer]; }

  /// The first thing that stands still or moves along each ray; which places on the floor lie in the shadow of what
  /// moves. Rays of length 0 meet nothing.
  [[nodiscard]] Sights look(Vec3 eye, const Rays& rays) const;
  /// How far it is to a pane nearer than what was met, in lengths of the ray; 0: there is none.
  [[nodiscard]] std::array<float, kPacket> glass_before(Vec3 eye, const Rays& rays, const Sights& met) const;
  /// Whether nothing stands between each place that was met and `from`.
  [[nodiscard]] std::array<bool, kPacket> is_reached(Vec3 from, Vec3 eye, const Rays& rays, const Sights& met) const;

  [[nodiscard]] const Look& look_of(const Sight& sight) const { return meshes_[sight.layer].surfaces[sight.triangle]; }
  [[nodiscard]] Vec3 normal_of(const Sight& sight) const;                 ///< between those of the corners
  [[nodiscard]] std::array<float, 2> place_of(const Sight& sight) const;  ///< likewise

 private:
  struct Embree;
  void throw_shadows(Vec3 eye, const Rays& rays, Sights& met) const;

  std::unique_ptr<Embree> embree_;
  std::array<Mesh, 3> meshes_;
};

/// Where most light comes from, of length 1.
inline constexpr Vec3 kLampLight{0.28F, 0.17F, 0.945F};

}  // namespace docent::simulator
