#include "docent/apps/doctor/stream_watch.h"

#include <algorithm>
#include <cstdio>

namespace docent::apps::doctor_command {
namespace {

constexpr std::size_t kMostFrames = 100;
constexpr double kAhead = -0.05;        // [s] of a stamp: the other clock is ahead
constexpr double kOtherClock = 1000.0;  // [s] no clock that somebody keeps is off by so much

std::string number(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

}  // namespace

void StreamWatch::hear(Time stamp, Time now, const std::string& frame) {
  if (count_ > 0) {
    longest_ = std::max(longest_, now - last_);
    if (stamp.nanoseconds != 0 && stamp == last_stamp_) ++repeated_;
    if (stamp.nanoseconds != 0 && stamp < last_stamp_) ++back_;
  } else {
    first_ = now;
  }
  ++count_;
  last_ = now;
  last_stamp_ = stamp;
  if (stamp.nanoseconds == 0)
    ++without_stamp_;
  else
    ages_.push_back(to_seconds(now - stamp));
  if (frames_.size() < kMostFrames) frames_.insert(frame);
}

double StreamWatch::rate_hz() const {
  const double lasted = to_seconds(last_ - first_);
  return count_ > 1 && lasted > 0.0 ? (count_ - 1) / lasted : 0.0;
}

double StreamWatch::longest_pause_s(Time begin, Time end) const {
  if (count_ == 0) return to_seconds(end - begin);
  return to_seconds(std::max({longest_, first_ - begin, end - last_}));
}

std::optional<double> StreamWatch::age_s() const {
  if (ages_.empty()) return std::nullopt;
  std::vector<double> sorted = ages_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

Finding StreamWatch::judge(const std::string& name, const StreamDemand& demand, int writers, Time begin,
                           Time end) const {
  Finding finding{"base", name, Verdict::fine, ""};
  const auto add = [&finding](Verdict verdict, const std::string& what) {
    finding.verdict = std::max(finding.verdict, verdict);
    finding.text += (finding.text.empty() ? "" : "; ") + what;
  };
  const Verdict missing = demand.is_required ? Verdict::wrong : Verdict::note;
  if (count_ == 0) {
    add(missing, writers == 0 ? "nobody publishes it"
                              : std::to_string(writers) + (writers == 1 ? " program publishes" : " programs publish") +
                                    " it and nothing comes: of another type, of another quality of service, or silent");
    finding.figures = {{"messages", 0.0}, {"writers", static_cast<double>(writers)}};
    return finding;
  }
  const double rate = rate_hz();
  const double pause = longest_pause_s(begin, end);
  add(Verdict::fine, number(rate, 1) + " Hz");
  if (rate < demand.least_hz) add(missing, "wanted are " + number(demand.least_hz, 1) + " Hz at least");
  if (pause > demand.silent_s) add(missing, "silent for " + number(pause, 1) + " s");
  if (writers > 1) add(Verdict::note, std::to_string(writers) + " programs publish it");
  const auto age = age_s();
  if (!age) {
    add(Verdict::note, "its stamps are zero: a message is taken to be of the moment when it comes");
  } else if (*age > kOtherClock || *age < -kOtherClock) {
    add(Verdict::note, "its stamps are of another clock (" + number(*age, 0) + " s)");
  } else {
    add(Verdict::fine, number(*age * 1000.0, 0) + " ms old");
    if (*age > demand.oldest_s)
      add(Verdict::note, "late, or its clock is behind: keep the computers together by chrony");
    if (*age < kAhead) add(Verdict::note, "its clock is ahead of this one's: keep the computers together by chrony");
  }
  if (back_ > 0) add(Verdict::note, std::to_string(back_) + " stamps lie before the one before");
  if (repeated_ > count_ / 2) add(Verdict::note, "it repeats its stamps");
  finding.figures = {{"messages", static_cast<double>(count_)},
                     {"rate_hz", rate},
                     {"longest_pause_s", pause},
                     {"writers", static_cast<double>(writers)}};
  if (age) finding.figures.emplace_back("age_s", *age);
  return finding;
}

}  // namespace docent::apps::doctor_command
