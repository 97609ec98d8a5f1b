#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "docent/base/result.h"
#include "docent/evaluation/reference/reference_poses.h"

namespace docent::evaluation {

/// How two places of a drive truly lie to each other, as a person has measured or checked it.
struct Relation {
  Time first;
  Time second;
  Pose2 first_from_second;
};

/// Lines "t1 t2 x y z roll pitch yaw" [s, m, rad], as the SLAM benchmark of R. Kümmerle et al. (On measuring the
/// accuracy of SLAM algorithms, Autonomous Robots 27, 2009) has them; z, roll and pitch are passed over.
/// Error: "FILE: …" or "FILE:LINE: …".
[[nodiscard]] Result<std::vector<Relation>> load_relations(const std::filesystem::path& path);
[[nodiscard]] Result<std::vector<Relation>> parse_relations(std::string_view text, const std::string& name);

/// Kümmerle et al., eq. 2: each relation's error is the true difference of the two poses less the estimated one. No
/// alignment of the whole: a map that is bent far away is no worse here.
struct RelationScore {
  std::size_t relations = 0;   ///< those whose times lie within the poses'
  double metres = 0.0;         ///< mean of the translational errors,
  double metres_spread = 0.0;  ///< their standard deviation
  double metres_worst = 0.0;
  double degrees = 0.0;  ///< mean of the rotational errors
  double degrees_spread = 0.0;
};

/// `poses`: in the order of their times; between two of them the way is straight. O(relations log poses).
[[nodiscard]] RelationScore score_relations(std::span<const Relation> relations, std::span<const TimedPose> poses);

/// Relations between true poses that lie `apart` [m] of way from each other, for logs whose true poses are known.
[[nodiscard]] std::vector<Relation> relations_between(std::span<const TimedPose> truth, std::span<const double> apart);

}  // namespace docent::evaluation
