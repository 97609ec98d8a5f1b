#pragma once

#include <span>

#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

/// A step from one version of the tables to the next. A step that was published is never changed.
struct Migration {
  const char* name;        ///< what it is for
  const char* statements;  ///< as both databases read them
};

/// Brings the part of a database that is called `part` to its newest version: what is missing of `migrations`, in their
/// order, each wholly or not at all. Two programs that do it at the same time do it once.
/// Error: also where the tables are of a newer program.
[[nodiscard]] Result<void> migrate(Database& database, const std::string& part, std::span<const Migration> migrations);

}  // namespace docent::telepresence
