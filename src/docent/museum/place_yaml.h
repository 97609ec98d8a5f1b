#pragma once

#include "docent/geometry/pose2.h"

namespace docent::museum {

/// A place in museum.yaml, in metres and degrees of the map's frame.
struct PointYaml {
  double x = 0.0;
  double y = 0.0;
  template <class V>
  void visit(V& v) {
    v.required("x", x);
    v.required("y", y);
  }
};

struct PoseYaml {
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;
  template <class V>
  void visit(V& v) {
    v.required("x", x);
    v.required("y", y);
    v.required("heading", heading);
  }
  [[nodiscard]] Pose2 pose() const { return {x, y, Angle::degrees(heading)}; }
};

}  // namespace docent::museum
