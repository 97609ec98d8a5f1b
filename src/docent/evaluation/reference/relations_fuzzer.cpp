#include <cstddef>
#include <cstdint>
#include <string_view>

#include "docent/evaluation/reference/relations.h"

// Files of poses and of relations: refused, or scored.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text{reinterpret_cast<const char*>(data), size};
  const auto poses = docent::evaluation::parse_timed_poses(text, "fuzz");
  const auto relations = docent::evaluation::parse_relations(text, "fuzz");
  if (poses && relations) (void)docent::evaluation::score_relations(*relations, *poses);
  return 0;
}
