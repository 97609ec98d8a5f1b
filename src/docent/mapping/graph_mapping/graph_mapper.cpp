#include "docent/mapping/graph_mapping/graph_mapper.h"

#include "docent/mapping/graph_mapping/graph_mapping.h"

namespace docent::mapping {

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
