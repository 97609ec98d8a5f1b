#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace docent::telepresence {

/// By which names the server may be called. A page of a stranger may have its own name lead to this computer (DNS
/// rebinding), and would then count as a page of ours: so a name must be one of ours. An address cannot be made to lead
/// elsewhere, and is always one.
class Hosts {
 public:
  /// @param names  besides localhost and this computer's own
  explicit Hosts(const std::vector<std::string>& names);
  /// @param host  as the header Host says it, with or without a port; empty: none came, as no browser does
  [[nodiscard]] bool is_ours(std::string_view host) const;

 private:
  std::set<std::string, std::less<>> names_;
};

}  // namespace docent::telepresence
