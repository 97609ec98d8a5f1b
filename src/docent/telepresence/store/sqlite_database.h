#pragma once

#include <memory>
#include <string>

#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

[[nodiscard]] Result<std::unique_ptr<Database>> open_sqlite(const std::string& path);

}  // namespace docent::telepresence
