#include <cstddef>
#include <cstdint>

#include "docent/telepresence/api/api_documents.h"
#include "docent/telepresence/api/document_reader.h"

// Bodies of calls to /api/v1.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace docent::telepresence;
  const auto json = parse_json({reinterpret_cast<const char*>(data), size});
  if (!json) return 0;
  (void)from_json<documents::NewPost>(*json);
  (void)from_json<documents::StatisticsDays>(*json);
  (void)from_json<documents::Verdict>(*json);
  return 0;
}
