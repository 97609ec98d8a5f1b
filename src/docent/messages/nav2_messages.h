#pragma once

#include <vector>

#include "docent/messages/standard_messages.h"

// What Nav2's own programs and panels speak, field for field.

namespace docent {

namespace nav2_msgs {
struct Particle {
  static constexpr const char* kType = "nav2_msgs/msg/Particle";
  geometry_msgs::Pose pose;
  double weight = 0;  ///< share of the mass
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("pose", m.pose);
    v("weight", m.weight);
  }
};

/// What AMCL says of its belief.
struct ParticleCloud {
  static constexpr const char* kType = "nav2_msgs/msg/ParticleCloud";
  std_msgs::Header header;
  std::vector<Particle> particles;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("particles", m.particles);
  }
};
}  // namespace nav2_msgs

}  // namespace docent
