#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "docent/base/result.h"

namespace docent::recording {

/// The whole pages of a database of SQLite in memory, a copy of one's own: what a cut leaves of the last page would be
/// read as noughts.
class WholePages {
 public:
  /// Error: "FILE: …": unreadable, or no such database.
  [[nodiscard]] static Result<std::unique_ptr<WholePages>> of(const std::filesystem::path& path);
  WholePages(const WholePages&) = delete;
  WholePages& operator=(const WholePages&) = delete;
  ~WholePages();

  [[nodiscard]] std::span<std::uint8_t> bytes() const { return bytes_; }
  /// "ends early (60 of 100 pages are there)", or that it is damaged.
  [[nodiscard]] std::string what_is_wrong() const;

 private:
  WholePages() = default;
  void* mapped_ = nullptr;
  std::size_t size_ = 0;
  std::span<std::uint8_t> bytes_;
  std::size_t pages_ = 0, should_be_ = 0;
};

}  // namespace docent::recording
