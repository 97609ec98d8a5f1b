#pragma once

#include <span>
#include <string>

#include "docent/telepresence/api/endpoint.h"

namespace docent::telepresence {

/// The table as an OpenAPI 3.1 document.
[[nodiscard]] std::string openapi_of(std::span<const Endpoint> endpoints);

}  // namespace docent::telepresence
