#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

/// Who did what, when and from where: logins, and all that moderators and operators do.
struct AuditEntry {
  Time time;
  std::string who;         ///< a person's id, or the name with which somebody tried to log in
  std::string what;        ///< a word, such as "login" or the endpoint's name
  std::string about;       ///< the thing that it was done to; empty: none
  std::string address;     ///< from where
  std::int64_t count = 1;  ///< how often, within the hour whose last one is `time`
  std::string place = {};  ///< in the log, for `AuditSearch::before`
};

/// What is looked for; what is empty does not matter.
struct AuditSearch {
  std::string account = {};        ///< its name, or a person's id
  std::string address = {};        ///< or the beginning of one
  std::optional<Time> from = {};   ///< then or later
  std::optional<Time> until = {};  ///< earlier
  std::string before = {};         ///< the `place` of the last entry of the page before
  int most = 100;
};

/// The audit log, in the store. It only grows, but for what is older than `kLasts`. One thread.
class Audit {
 public:
  static constexpr Duration kLasts = std::chrono::hours{24 * 90};
  static constexpr const char* kNobody = "no account";  ///< who tries names that nobody has

  [[nodiscard]] static Result<std::unique_ptr<Audit>> open(Database& database);
  Audit(const Audit&) = delete;
  Audit& operator=(const Audit&) = delete;
  [[nodiscard]] Result<void> add(const AuditEntry& entry);
  /// Likewise, but all of one hour, one `who`, `what` and `address` are one entry with their count.
  [[nodiscard]] Result<void> count(const AuditEntry& entry);
  /// The newest first. @pre `before` is empty or a place
  [[nodiscard]] Result<std::vector<AuditEntry>> find(const AuditSearch& search);
  [[nodiscard]] static bool is_place(const std::string& text);
  void forget(Time now);  ///< what is older than `kLasts`

 private:
  explicit Audit(Database& database) : database_{database} {}
  Database& database_;
};

}  // namespace docent::telepresence
