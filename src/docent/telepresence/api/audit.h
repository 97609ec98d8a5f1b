#pragma once

#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/store/database.h"

namespace docent::telepresence {

/// Who did what, when and from where: logins, and all that moderators and operators do.
struct AuditEntry {
  Time time;
  std::string who;      ///< a person's id, or the name with which somebody tried to log in
  std::string what;     ///< a word, such as "login" or the endpoint's name
  std::string about;    ///< the thing that it was done to; empty: none
  std::string address;  ///< from where
};

/// The audit log, in the store. It only grows, but for what is older than a year. One thread.
class Audit {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Audit>> open(Database& database);
  Audit(const Audit&) = delete;
  Audit& operator=(const Audit&) = delete;
  [[nodiscard]] Result<void> add(const AuditEntry& entry);
  /// The newest `most`, newest first.
  [[nodiscard]] Result<std::vector<AuditEntry>> newest(int most);
  void forget_before(Time time);

 private:
  explicit Audit(Database& database) : database_{database} {}
  Database& database_;
};

}  // namespace docent::telepresence
