#pragma once

#include <memory>
#include <string>

#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

/// A connection that is lost is made again by the next statement; the statement that found it lost has failed, and its
/// caller tries again or says that nothing was stored.
[[nodiscard]] Result<std::unique_ptr<Database>> open_postgres(const std::string& address, Database::Try when);

}  // namespace docent::telepresence
