#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/messages/schema.h"

namespace docent::recording {

/// The layout of a message in a recording that was made when the message had other fields, by the schema that the
/// recording embeds: what came since then is empty or zero, or has its default where nothing older stands behind it;
/// what is gone since then is passed over. A field is the same if its name and type are.
class OlderLayout {
 public:
  /// @param theirs, ours  schemas in the encoding ros2msg. nullopt: they describe the same layout, or one is no schema.
  [[nodiscard]] static std::optional<OlderLayout> between(const std::string& theirs, const std::string& ours);

  /// CDR bytes of their layout in ours; nullopt: they are damaged. O(bytes).
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> translated(std::span<const std::uint8_t> bytes) const;

 private:
  friend class LayoutTranslator;
  using Fields = std::vector<FieldSchema>;
  using Types = std::map<std::string, Fields>;  ///< by their names; the message itself has none

  [[nodiscard]] static Types parse(const std::string& schema);

  Types theirs_;
  Types ours_;
};

}  // namespace docent::recording
