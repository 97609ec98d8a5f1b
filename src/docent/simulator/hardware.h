#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/simulator/physique/disc.h"
#include "docent/simulator/sensing/scanner_kind.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// What the simulated robot is equipped with, as its drawing says: the true places are drawn around these.
struct Hardware {
  struct Scanner {
    std::string name;         ///< "front", "rear", "left" or "right": it speaks on scan_NAME, faults call it laser_NAME
    std::string frame;        ///< of its messages
    Pose2 base_from_scanner;  ///< the middle of its field looks along x
    ScannerKind kind{};       ///< what is sold under its name
    double late = 0.0;        ///< [s] after the sweep that it is sent, with the stamp of then
    double height = kLaserHeight;  ///< [m] above the floor
  };
  std::vector<Scanner> scanners{{"front", "laser_front", {}},
                                {"rear", "laser_rear", {0.0, 0.0, Angle::degrees(180.0)}}};
  std::vector<Disc> posts;        ///< [m] base frame: what of the body stands in the scanners' plane
  int sonars = 24;                ///< evenly round the body; 0: none
  double sonar_radius = 0.25;     ///< [m] from the body's centre
  int infrareds = 24;             ///< likewise
  double infrared_radius = 0.25;  ///< [m]
  bool has_tactile = true;
  double odometry_way = 1.0;    ///< metres that odometry counts for each true one
  double odometry_turn = 1.0;   ///< likewise of turns
  double odometry_rate = 20.0;  ///< [Hz]
};

}  // namespace docent::simulator
