#include "docent/task_control/tour_scheduler/request_board.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "docent/base/check.h"

namespace docent::task_control {
bool is_step(RequestStatus from, RequestStatus to) {
  switch (from) {
    case RequestStatus::queued:
      return to == RequestStatus::active || to == RequestStatus::failed || to == RequestStatus::cancelled;
    case RequestStatus::active:
      return to != RequestStatus::active && to != RequestStatus::refused;
    default:
      return false;
  }
}

void RequestBoard::restore(std::vector<BoardEntry> entries, std::uint64_t revision) {
  entries_ = std::move(entries);
  revision_ = revision;
  unstored_.clear();
  tidy();
}

const BoardEntry* RequestBoard::find(const std::string& id) const {
  const auto place =
      std::find_if(entries_.begin(), entries_.end(), [&](const BoardEntry& entry) { return entry.request.id == id; });
  return place == entries_.end() ? nullptr : &*place;
}

BoardEntry* RequestBoard::find_mutable(const std::string& id) { return const_cast<BoardEntry*>(find(id)); }

void RequestBoard::add(VisitorRequest request, RequestStatus status, Reason reason, Time now) {
  DOCENT_CHECK(find(request.id) == nullptr);
  const std::string id = request.id;
  BoardEntry entry{std::move(request), status, std::move(reason), now, now};
  if (is_open(status)) {
    const auto first_closed =
        std::find_if(entries_.begin(), entries_.end(), [](const BoardEntry& e) { return !is_open(e.status); });
    entries_.insert(first_closed, std::move(entry));
  } else {
    entries_.push_back(std::move(entry));
  }
  touch(id);
}

void RequestBoard::show_again(BoardEntry entry) {
  DOCENT_CHECK(!is_open(entry.status) && find(entry.request.id) == nullptr);
  const std::string id = entry.request.id;
  entries_.push_back(std::move(entry));
  touch(id);
}

void RequestBoard::change(const std::string& id, RequestStatus status, Reason reason, Time now) {
  BoardEntry* entry = find_mutable(id);
  DOCENT_CHECK(entry != nullptr && is_step(entry->status, status));
  entry->status = status;
  entry->reason = std::move(reason);
  entry->changed = now;
  if (!is_open(status)) {  // closed entries stand behind the open ones, in the order of closing
    const auto place = entries_.begin() + (entry - entries_.data());
    std::rotate(place, place + 1, entries_.end());
  }
  touch(id);
}

void RequestBoard::count_attempt(const std::string& id, Time not_before) {
  BoardEntry* entry = find_mutable(id);
  DOCENT_CHECK(entry != nullptr && is_open(entry->status));
  ++entry->attempts;
  entry->not_before = not_before;
  touch(id);
}

std::size_t RequestBoard::open_count() const {
  return static_cast<std::size_t>(
      std::count_if(entries_.begin(), entries_.end(), [](const BoardEntry& entry) { return is_open(entry.status); }));
}

std::size_t RequestBoard::stops_with(const VisitorRequest& request) const {
  std::set<std::tuple<Word<RequestKind>, std::string, int>> stops{{request.kind, request.target, request.viewpoint}};
  for (const BoardEntry& entry : entries_) {
    const VisitorRequest& other = entry.request;
    if (is_open(entry.status)) stops.emplace(other.kind, other.target, other.viewpoint);
  }
  // A request that minds no viewpoint is met at a stop that is made anyway; in this order it comes before these stops.
  std::size_t count = 0;
  for (auto stop = stops.begin(); stop != stops.end(); ++stop) {
    const auto next = std::next(stop);
    const bool is_met = std::get<2>(*stop) < 0 && next != stops.end() && std::get<0>(*next) == std::get<0>(*stop) &&
                        std::get<1>(*next) == std::get<1>(*stop);
    if (!is_met) ++count;
  }
  return count;
}

void RequestBoard::touch(const std::string& id) {
  unstored_.insert(id);
  ++revision_;
  tidy();
}

void RequestBoard::tidy() {
  const std::size_t open = open_count();
  if (entries_.size() - open <= kClosedKept) return;
  // Only what is stored may leave: an entry that was never committed would be lost.
  const std::size_t surplus = entries_.size() - open - kClosedKept;
  const auto first = entries_.begin() + static_cast<std::ptrdiff_t>(open);
  const auto last = first + static_cast<std::ptrdiff_t>(surplus);
  entries_.erase(std::remove_if(first, last, [&](const BoardEntry& e) { return !unstored_.contains(e.request.id); }),
                 last);
}

}  // namespace docent::task_control
