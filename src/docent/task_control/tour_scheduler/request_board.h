#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/vocabulary/reason.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// Whether a request may go from one status to the other.
[[nodiscard]] bool is_step(RequestStatus from, RequestStatus to);

/// A wish as it was made.
struct VisitorRequest {
  std::string id;  ///< UUIDv7, made at the edge
  Time stamp;
  Word<RequestSource> source;
  std::string visitor;  ///< a name to show
  Word<RequestKind> kind;
  std::string target;  ///< exhibit or tour id; for cancel: the request's id
  int viewpoint = -1;
  std::string language;
};

struct BoardEntry {
  VisitorRequest request;
  RequestStatus status = RequestStatus::queued;
  Reason reason;  ///< for the visitor
  Time created;
  Time changed;
  int attempts = 0;   ///< visits for it that failed
  Time not_before{};  ///< not tried again before
};

/// All open requests and the last kClosedKept closed ones (architecture 10.8). Each change is remembered until it was
/// stored, so that it can be committed before it is published.
class RequestBoard {
 public:
  static constexpr std::size_t kClosedKept = 100;

  /// Entries as `entries()` returned them, and the revision they had.
  void restore(std::vector<BoardEntry> entries, std::uint64_t revision);

  [[nodiscard]] const BoardEntry* find(const std::string& id) const;
  /// @pre the id is not on the board.
  void add(VisitorRequest request, RequestStatus status, Reason reason, Time now);
  /// An old entry, long closed, to show once more: its client has not seen it. @pre not on the board, not open.
  void show_again(BoardEntry entry);
  /// @pre the id is on the board and is_step(its status, status).
  void change(const std::string& id, RequestStatus status, Reason reason, Time now);
  /// Notes a failed visit: one more attempt; not tried again before `not_before`. @pre the id is open.
  void count_attempt(const std::string& id, Time not_before);

  /// Open ones in the order of their arrival, then closed ones, the last closed last.
  [[nodiscard]] const std::vector<BoardEntry>& entries() const { return entries_; }
  [[nodiscard]] std::size_t open_count() const;
  /// How many different things (tours, exhibits, viewpoints of exhibits) the open requests wish for, if `request` is
  /// one of them. A wish for an exhibit from anywhere is no stop of its own beside one for a viewpoint. O(open log
  /// open).
  [[nodiscard]] std::size_t stops_with(const VisitorRequest& request) const;
  [[nodiscard]] std::uint64_t revision() const { return revision_; }

  /// Ids changed since the last `mark_stored`.
  [[nodiscard]] const std::set<std::string>& unstored() const { return unstored_; }
  void mark_stored() { unstored_.clear(); }

 private:
  [[nodiscard]] BoardEntry* find_mutable(const std::string& id);
  void touch(const std::string& id);
  void tidy();

  std::vector<BoardEntry> entries_;
  std::set<std::string> unstored_;
  std::uint64_t revision_ = 0;
};

}  // namespace docent::task_control
