#include "docent/collision_avoidance/avoider/carried_off.h"

#include <algorithm>

namespace docent::collision_avoidance {
namespace {

using Finding = Succession::Finding;

constexpr const char* kWhy = "carried off, as the scans say: it only turns until it knows where it is";

bool is_strange(Finding finding) { return finding == Finding::suspect || finding == Finding::broken; }

}  // namespace

CarriedOff::Word CarriedOff::word_of(const Look& look, Time first, Time newest) const {
  if (!look.stamp || newest - *look.stamp > seconds(params_.alive)) return Word::agrees;  // it says nothing at all
  const Time since = first - seconds(params_.same_moment);
  if (look.broken >= since || is_strange(look.finding) || look.finding == Finding::untold) return Word::agrees;
  if (*look.stamp >= first) return Word::denies;
  return newest - first > seconds(params_.waits) ? Word::agrees : Word::waits;
}

void CarriedOff::judge(Time newest) {
  std::optional<Time> first = pending_;
  for (const Look& look : looks_)
    if (is_strange(look.finding)) first = first ? std::min(*first, look.strange) : look.strange;
  is_suspected_ = false;
  if (!first) return;
  bool waits = false;
  for (const Look& look : looks_) {
    const Word word = word_of(look, *first, newest);
    waits = waits || word == Word::waits;
    if (word != Word::denies) continue;
    pending_.reset();
    return;
  }
  is_suspected_ = true;
  if (!pending_ || waits) return;
  since_ = newest;
  here_ = 0;
  ++times_;
  pending_.reset();
  is_suspected_ = false;
}

void CarriedOff::see(std::size_t scanner, Time stamp, Finding finding) {
  Look& look = looks_[scanner];
  if (is_strange(finding) && !is_strange(look.finding)) look.strange = stamp;
  look.stamp = stamp;
  look.finding = finding;
  if (finding == Finding::broken) {
    const bool is_told = since_ && look.strange <= *since_ && times_ > 0 && !pending_;
    look.broken = stamp;
    // The other scanner has told of the same moment already.
    if (!is_told) pending_ = pending_ ? std::min(*pending_, look.strange) : look.strange;
  }
  judge(stamp);
}

void CarriedOff::believe(Time stamp, bool says_here) {
  if (!since_) return;
  here_ = says_here && stamp >= *since_ + seconds(params_.settles) ? here_ + 1 : 0;
  if (here_ >= params_.sure) since_.reset();
}

std::optional<std::string> CarriedOff::forbids_driving(Time now) const {
  if (is_suspected_) return kWhy;
  if (since_ && now - *since_ < seconds(params_.turns_only)) return kWhy;
  return std::nullopt;
}

void CarriedOff::cap(Time now, SpeedCap& cap) const {
  if (!since_) return;
  cap.lower(now - *since_ < seconds(params_.turns_only) ? 0.0 : params_.creep, kWhy);
}

}  // namespace docent::collision_avoidance
