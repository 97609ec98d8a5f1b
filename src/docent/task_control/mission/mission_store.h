#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "docent/base/result.h"
#include "docent/task_control/mission/mission.h"

namespace docent::task_control {

/// mission.sqlite (architecture 10.9): every request ever made and the plan of the running visit, in WAL mode. Each
/// `save` is one transaction: after a kill at any moment the file holds the state before it or after it.
class MissionStore {
 public:
  /// Opens or makes the file. `is_durable`: also a power failure loses nothing that was saved (one sync a save).
  /// `new_deployment` names a new file's life. A file that is damaged is set aside under another name and a new one
  /// begun: a robot that has forgotten is better than none. Error: "FILE: why".
  [[nodiscard]] static Result<MissionStore> open(const std::filesystem::path& path, const std::string& new_deployment,
                                                 bool is_durable);
  MissionStore(MissionStore&&) noexcept;
  MissionStore& operator=(MissionStore&&) noexcept;
  ~MissionStore();

  /// Where the damaged file went; empty: it was sound.
  [[nodiscard]] const std::string& set_aside() const;

  /// All open requests, the last closed ones, the plan, and all that was learned of travel times. A plan that cannot be
  /// read is left out.
  [[nodiscard]] Result<MissionMemory> load();
  /// Writes what changed since the last save: the board's unstored entries, the lessons and the plan. Nothing changed:
  /// no write. The caller marks board and travel times as stored when this succeeds.
  [[nodiscard]] Result<void> save(const MissionMemory& memory);
  /// A request by its id, however long ago it was closed.
  [[nodiscard]] Result<std::optional<BoardEntry>> find(const std::string& id);

 private:
  struct Connection;
  explicit MissionStore(std::unique_ptr<Connection> connection);
  [[nodiscard]] static std::unique_ptr<Connection> connect(const std::filesystem::path& path,
                                                           const std::string& new_deployment, bool is_durable);
  std::unique_ptr<Connection> connection_;
};

}  // namespace docent::task_control
