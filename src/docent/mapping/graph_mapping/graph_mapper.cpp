#include "docent/mapping/graph_mapping/graph_mapper.h"

#include <utility>

#include "docent/mapping/graph_mapping/graph_mapping.h"

namespace docent::mapping {

Result<void> GraphMapperParams::validate() const {
  const std::pair<const char*, Result<void>> parts[] = {
      {"points.", points.validate()}, {"chain.", chain.validate()}, {"submaps.", submaps.validate()},
      {"loops.", loops.validate()},   {"graph.", graph.validate()}, {"judgement.", judgement.validate()},
      {"lines.", lines.validate()}};
  for (const auto& [part, valid] : parts)
    if (!valid) return fail(part + valid.error().message);
  if (!(candidates > 0)) return fail("candidates must be > 0");
  if (!(loop_reach > 0.0)) return fail("loop_reach must be > 0 m");
  if (!(fine_rounds >= 0)) return fail("fine_rounds must be >= 0");
  if (!(fine_pairs > 0)) return fail("fine_pairs must be > 0");
  if (!(fine_reach > 0.0)) return fail("fine_reach must be > 0 m");
  if (!(first_steps >= 0)) return fail("first_steps must be >= 0");
  if (!(contradiction > 0.0)) return fail("contradiction must be > 0");
  if (!(few_points >= 0.0)) return fail("few_points must be >= 0");
  if (!(odometry_margin > 0.0)) return fail("odometry_margin must be > 0");
  if (!(least_odometry_scale > 0.0 && least_odometry_scale <= 1.0))
    return fail("least_odometry_scale must be in (0, 1]");
  return {};
}

GraphMap map_by_graph(std::span<const MappingScan> scans, const GraphMapperParams& params,
                      const std::function<void(const MappingProgress&)>& progress) {
  GraphMapping mapping{params};
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::size_t revision = mapping.revision();
    mapping.add(scans[i]);
    const bool is_told = mapping.revision() != revision || i % 100 == 0;
    if (progress && is_told) progress({"chain", i, scans.size(), mapping.loops(), mapping.map_from_base()});
  }
  return mapping.finish(progress);
}

}  // namespace docent::mapping
