#include "docent/recording/carmen_log.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "docent/messages/message_fitness.h"
#include "docent/recording/gzip_text.h"
#include "docent/recording/log_odometry.h"
#include "docent/recording/rosbag/stamp_clock.h"

namespace docent::recording {
namespace {

constexpr double kMostField = 2.0 * std::numbers::pi + 0.1;  ///< [rad] of one scan, as fault_of has it
constexpr double kFinest = 1e-5;                             ///< [rad] between two beams, likewise
constexpr double kSickLimit = 80.0;       ///< [m]; beyond it SICK scanners write codes, not distances
constexpr double kInventedStep = 0.2;     ///< [s]
constexpr std::size_t kMostNamed = 3;     ///< lines that are left out
constexpr std::size_t kFaultyShare = 10;  ///< where one of so many lines is wrong, so is the file
constexpr const char* kWrongCount = ": is the number of readings wrong?";
constexpr double kDegree = std::numbers::pi / 180.0;

/// Why a line is wrong; thrown within this file only.
struct LineFault {
  std::string what;
};

/// The words of one line, taken one after the other.
class Words {
 public:
  explicit Words(std::string_view line) : rest_{line} {}

  [[nodiscard]] std::string_view word() {
    const std::size_t start = rest_.find_first_not_of(" \t\r");
    if (start == std::string_view::npos) {
      rest_ = {};
      return {};
    }
    rest_.remove_prefix(start);
    const std::string_view found = rest_.substr(0, rest_.find_first_of(" \t\r"));
    rest_.remove_prefix(found.size());
    return found;
  }
  /// May be infinite or not a number: readings are.
  [[nodiscard]] double reading(const char* what) {
    std::string_view text = word();
    if (text.empty()) throw LineFault{std::string{"the line ends where "} + what + " should be"};
    if (text.front() == '+') text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) return 0.0;  // a denormal rest of some computation
    if (error != std::errc{} || end != text.data() + text.size())
      throw LineFault{"'" + std::string{text.substr(0, 40)} + "' where " + what + " should be"};
    return value;
  }
  [[nodiscard]] double number(const char* what) {
    const double value = reading(what);
    if (!std::isfinite(value) || std::abs(value) > 1e12) throw LineFault{std::string{what} + " is out of range"};
    return value;
  }
  [[nodiscard]] std::size_t count(const char* what) {
    const double value = number(what);
    if (value < 0 || value > static_cast<double>(kMostBeams) || value != std::floor(value))
      throw LineFault{std::string{what} + " must be 0 to " + std::to_string(kMostBeams)};
    return static_cast<std::size_t>(value);
  }
  [[nodiscard]] Pose2 pose(const char* what) {
    const double x = number(what);
    const double y = number(what);
    const double theta = number(what);
    for (const double part : {x, y, theta})
      if (std::abs(part) > kMostAnything) throw LineFault{std::string{what} + " lies nowhere on Earth"};
    return {x, y, Angle::radians(theta)};
  }

 private:
  std::string_view rest_;
};

/// The two clocks at the end of a line [s]; a missing one, or one beyond the year 2106, is not a number.
struct Clocks {
  double message = std::numeric_limits<double>::quiet_NaN();
  double logger = std::numeric_limits<double>::quiet_NaN();
};

Clocks read_clocks(Words& words) {
  Clocks clocks;
  clocks.message = words.number("the time");
  if (std::abs(clocks.message) > kLastSecond) clocks.message = std::numeric_limits<double>::quiet_NaN();
  const std::string_view host = words.word();
  if (host.empty()) return clocks;
  double number = 0.0;
  const auto [end, error] = std::from_chars(host.data(), host.data() + host.size(), number);
  if (error == std::errc{} && end == host.data() + host.size() && host.find('.') != std::string_view::npos)
    throw LineFault{"'" + std::string{host.substr(0, 40)} + "' where a computer's name should be" + kWrongCount};
  const std::string_view logger = words.word();
  double value = 0.0;
  if (std::from_chars(logger.data(), logger.data() + logger.size(), value).ec == std::errc{} && std::isfinite(value) &&
      std::abs(value) <= kLastSecond)
    clocks.logger = value;
  if (!words.word().empty()) throw LineFault{std::string{"the line goes on behind its times"} + kWrongCount};
  return clocks;
}

/// Scans and odometry as they come, before the file as a whole settles what lines leave open.
class Collector {
 public:
  explicit Collector(std::string name) : name_{std::move(name)} {}

  void line(std::string_view text, int number) {
    Words words{text};
    const std::string_view kind = words.word();
    if (kind == "FLASER" || kind == "RLASER") {
      old_laser(words, kind == "RLASER", number);
    } else if (kind == "ROBOTLASER1") {
      new_laser(words, number);
    } else if (kind == "ODOM") {
      odometry(words);
    } else if (kind == "PARAM") {
      const std::string key{words.word()};
      if (key.empty()) throw LineFault{"PARAM without a name"};
      log_.parameters[key] = std::string{words.word()};  // the last one holds, as in CARMEN
    }
  }
  [[nodiscard]] Result<LaserLog> finish() {
    if (log_.scans.empty())
      return fail(name_ +
                  ": holds no FLASER, RLASER or ROBOTLASER1 line, and is no MCAP recording or rosbag2 database");
    settle_times();
    settle_bearings();
    settle_no_return();
    settle_mount(false, "robot_frontlaser_offset");
    settle_mount(true, "robot_rearlaser_offset");
    take_out_jumps();
    return std::move(log_);
  }
  void note(std::string text) { log_.notes.push_back(std::move(text)); }
  [[nodiscard]] std::size_t taken() const { return log_.scans.size() + log_.odometry.size(); }

 private:
  void old_laser(Words& words, bool rear, int number) {
    LoggedScan scan;
    scan.rear = rear;
    scan.line = number;
    read_ranges(words, scan);
    scan.logged_pose = words.pose("the laser's pose");
    scan.odom_from_base = words.pose("the odometry");
    const Clocks clocks = read_clocks(words);
    add(std::move(scan), clocks);
  }
  /// type start fov step max accuracy remission n r.. m v.. laser x y t robot x y t tv rv safety(2) axis time host time
  void new_laser(Words& words, int number) {
    LoggedScan scan;
    scan.line = number;
    (void)words.number("the laser's type");
    const double start = words.number("the first bearing");
    (void)words.number("the field of view");
    const double step = words.number("the step of the bearings");
    const double max_range = words.number("the maximum range");
    (void)words.number("the accuracy");
    (void)words.number("the remission mode");
    if (std::abs(start) > 7.0 || !(step >= kFinest && step < 1.0)) throw LineFault{"no laser has such bearings"};
    scan.first_bearing = Angle::radians(start);
    scan.bearing_step = step;
    read_ranges(words, scan);
    if (step * (static_cast<double>(scan.ranges.size()) - 1.0) > kMostField)
      throw LineFault{"the beams go more than once round"};
    for (std::size_t left = words.count("the number of remissions"); left > 0; --left)
      (void)words.reading("a remission");
    scan.logged_pose = words.pose("the laser's pose");
    scan.odom_from_base = words.pose("the odometry");
    for (int i = 0; i < 5; ++i) (void)words.number("a velocity or safety distance");
    const Clocks clocks = read_clocks(words);
    for (float& range : scan.ranges)
      if (max_range > 0.0 && range >= max_range) range = std::numeric_limits<float>::infinity();
    add(std::move(scan), clocks);
  }
  void read_ranges(Words& words, LoggedScan& scan) {
    const std::size_t beams = words.count("the number of readings");
    if (beams == 0) throw LineFault{"a scan without readings"};
    scan.ranges.reserve(beams);
    for (std::size_t i = 0; i < beams; ++i) {
      const double range = words.reading("a reading");
      // Zero and below are errors of the device; a range that was infinite in the file had no return.
      scan.ranges.push_back(range > 0.0 ? static_cast<float>(range) : std::numeric_limits<float>::quiet_NaN());
    }
  }
  void odometry(Words& words) {
    LoggedOdometry reading;
    reading.odom_from_base = words.pose("the odometry");
    reading.linear = words.number("the velocity");
    reading.angular = words.number("the turn rate");
    (void)words.number("the acceleration");
    odometry_clocks_.push_back(read_clocks(words));
    log_.odometry.push_back(reading);
  }
  void add(LoggedScan scan, const Clocks& clocks) {
    scan_clocks_.push_back(clocks);
    scans_before_.push_back(log_.odometry.size());
    log_.scans.push_back(std::move(scan));
  }

  /// True when the clock moves: at least half of the scans have a time of their own, and nine of ten have any.
  [[nodiscard]] bool moves(double Clocks::*clock) const {
    std::vector<double> times;
    for (const Clocks& clocks : scan_clocks_)
      if (std::isfinite(clocks.*clock)) times.push_back(clocks.*clock);
    const std::size_t scans = scan_clocks_.size();
    if (times.empty() || 10 * times.size() < 9 * scans) return false;
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times.size() == 1 ? scans == 1 : 2 * times.size() > scans;
  }
  /// The scans' times by that clock: where it is missing, as the scan before; where it was set, by the logger's.
  std::vector<Time> times_of_scans(double Clocks::*clock) {
    const bool has_logger = clock == &Clocks::message && moves(&Clocks::logger);
    std::vector<RecordedStamp> stamps;
    std::size_t missing = 0;
    double last = 0.0, last_logger = 0.0;
    for (const Clocks& clocks : scan_clocks_)  // before the first: as the first
      if (stamps.empty() && last == 0.0 && std::isfinite(clocks.*clock)) last = clocks.*clock;
    for (const Clocks& clocks : scan_clocks_) {
      missing += std::isfinite(clocks.*clock) ? 0 : 1;
      if (std::isfinite(clocks.*clock)) last = clocks.*clock;
      if (std::isfinite(clocks.logger)) last_logger = clocks.logger;
      stamps.push_back({time_from_seconds(last), time_from_seconds(has_logger ? last_logger : 0.0)});
    }
    if (missing > 0)
      note(std::to_string(missing) +
           " scans have no time, or one beyond the year 2106: that of the scan before is taken");
    MendedStamps mended = mended_stamps(stamps);
    if (mended.mended > 0)
      note("the clock of the scans jumps or stands: " + std::to_string(mended.mended) + " of " +
           std::to_string(stamps.size()) + " times are moved by the logger's");
    return std::move(mended.times);
  }
  void settle_times() {
    if (moves(&Clocks::message)) return take_clock(&Clocks::message);
    if (moves(&Clocks::logger)) {
      note("the messages' times stand still: the logger's are used");
      return take_clock(&Clocks::logger);
    }
    note("the file's times stand still: scans are taken to be 0.2 s apart");
    log_.times_are_invented = true;
    for (std::size_t i = 0; i < log_.scans.size(); ++i)
      log_.scans[i].time = time_from_seconds(kInventedStep * static_cast<double>(i));
    // Odometry between two scans is spread evenly between their times, in the order of the file.
    std::size_t done = 0;
    for (std::size_t i = 0; i <= log_.scans.size(); ++i) {
      const std::size_t end = i < log_.scans.size() ? scans_before_[i] : log_.odometry.size();
      const double share = kInventedStep / static_cast<double>(end - done + 1);
      for (std::size_t k = done; k < end; ++k) {
        const double after = share * static_cast<double>(k - done + 1);
        log_.odometry[k].time =
            time_from_seconds(std::max(0.0, kInventedStep * (static_cast<double>(i) - 1.0) + after));
      }
      done = end;
    }
  }
  /// Readings and scans, in the order of the file.
  void take_out_jumps() {
    LogOdometry unbroken{!log_.times_are_invented};
    std::size_t done = 0;
    for (std::size_t i = 0; i <= log_.scans.size(); ++i) {
      const std::size_t end = i < log_.scans.size() ? scans_before_[i] : log_.odometry.size();
      for (; done < end; ++done) {
        LoggedOdometry& reading = log_.odometry[done];
        reading.odom_from_base = unbroken.follow_scan(reading.time, reading.odom_from_base);
      }
      if (i < log_.scans.size())
        log_.scans[i].odom_from_base = unbroken.follow_scan(log_.scans[i].time, log_.scans[i].odom_from_base);
    }
    if (std::string text = unbroken.note(); !text.empty()) note(std::move(text));
  }
  void take_clock(double Clocks::*clock) {
    std::size_t raised = 0;
    RisingStamps front, rear, readings;
    const std::vector<Time> times = times_of_scans(clock);
    Time last = times.front();
    for (std::size_t i = 0; i < log_.scans.size(); ++i) {
      RisingStamps& stamps = log_.scans[i].rear ? rear : front;
      const Time time = stamps.follow(times[i]);
      raised += time < last ? 1 : 0;
      last = log_.scans[i].time = std::max(last, time);
    }
    if (front.set_back() + rear.set_back() > 0)
      note("the clock of the scans was set back: later stamps are moved as far");
    if (raised > 0) note(std::to_string(raised) + " scans had a time before the scan before them");
    last = times.front();
    for (std::size_t i = 0; i < log_.odometry.size(); ++i) {
      const double seconds_logged = odometry_clocks_[i].*clock;
      if (std::isfinite(seconds_logged)) {
        const Time time = readings.follow(time_from_seconds(seconds_logged));
        last = i == 0 ? time : std::max(last, time);
      }
      log_.odometry[i].time = last;
    }
  }

  void settle_bearings() {
    for (LoggedScan& scan : log_.scans) {
      if (scan.bearing_step > 0.0) continue;
      const auto beams = static_cast<double>(scan.ranges.size());
      const double gaps = scan.ranges.size() % 2 == 1 && scan.ranges.size() > 1 ? beams - 1.0 : beams;
      double step = 180.0 / gaps;
      const auto resolution = parameter(scan.rear ? "laser_rear_laser_resolution" : "laser_front_laser_resolution");
      if (resolution && *resolution > 0.0 && *resolution * gaps <= 180.5) step = *resolution;
      scan.bearing_step = step * kDegree;
      scan.first_bearing = Angle::degrees(-0.5 * gaps * step);
    }
  }

  void settle_no_return() {
    float greatest = 0.0F;
    std::size_t readings = 0;
    for (const LoggedScan& scan : log_.scans)
      for (const float range : scan.ranges)
        if (std::isfinite(range)) {
          greatest = std::max(greatest, range);
          ++readings;
        }
    const float near_greatest = 0.995F * greatest;
    std::size_t peak = 0;
    for (const LoggedScan& scan : log_.scans)
      peak += static_cast<std::size_t>(std::count_if(scan.ranges.begin(), scan.ranges.end(),
                                                     [&](float r) { return std::isfinite(r) && r >= near_greatest; }));
    // Walls at just the greatest distance are rare: one reading in two thousand is a code.
    const bool is_code = peak >= 3 && 2000 * peak >= readings;
    float limit = is_code ? near_greatest : std::nextafter(greatest, std::numeric_limits<float>::infinity());
    if (greatest > kSickLimit) limit = std::min(limit, static_cast<float>(kSickLimit));
    log_.max_range = limit;
    for (LoggedScan& scan : log_.scans)
      for (float& range : scan.ranges)
        if (range >= limit) range = std::numeric_limits<float>::infinity();
  }

  void settle_mount(bool rear, const char* offset_parameter) {
    std::vector<double> dx, dy, turn;
    double first_turn = 0.0;
    for (const LoggedScan& scan : log_.scans) {
      if (scan.rear != rear) continue;
      const Pose2 difference = inverse(scan.odom_from_base) * scan.logged_pose;
      if (turn.empty()) first_turn = difference.theta.radians();
      dx.push_back(difference.x);
      dy.push_back(difference.y);
      turn.push_back(Angle::radians(difference.theta.radians() - first_turn).radians());
    }
    if (dx.empty()) return;
    const auto median = [](std::vector<double> values) {
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      return *middle;
    };
    const double x = median(dx), y = median(dy), theta = median(turn);
    std::size_t agree = 0;
    for (std::size_t i = 0; i < dx.size(); ++i)
      agree += std::hypot(dx[i] - x, dy[i] - y) < 0.02 && std::abs(turn[i] - theta) < kDegree ? 1 : 0;
    Pose2 base_from_laser{x, y, Angle::radians(theta + first_turn)};
    const bool consistent = 20 * agree >= 19 * dx.size() && std::hypot(x, y) < 3.0;
    if (!consistent) {
      base_from_laser = {parameter(offset_parameter).value_or(0.0), 0.0, Angle{}};
      if (rear) base_from_laser.x = -std::abs(base_from_laser.x);
      note(std::string{rear ? "rear" : "front"} +
           " laser: the poses beside the odometry are corrected ones; its place is " +
           (log_.parameters.contains(offset_parameter) ? std::string{"taken from "} + offset_parameter
                                                       : std::string{"unknown, the robot's centre is taken"}));
    }
    // Some writers leave out the half turn of the rear laser.
    if (rear && std::abs(base_from_laser.theta.radians()) < 0.5 * std::numbers::pi)
      base_from_laser.theta = base_from_laser.theta + Angle::degrees(180.0);
    for (LoggedScan& scan : log_.scans)
      if (scan.rear == rear) scan.base_from_laser = base_from_laser;
  }

  [[nodiscard]] std::optional<double> parameter(const char* key) const {
    const auto found = log_.parameters.find(key);
    if (found == log_.parameters.end()) return std::nullopt;
    double value = 0.0;
    const std::string& text = found->second;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc{} || !std::isfinite(value) ||
        std::abs(value) > 1000.0)
      return std::nullopt;
    return value;
  }

  std::string name_;
  LaserLog log_;
  std::vector<Clocks> scan_clocks_;
  std::vector<Clocks> odometry_clocks_;
  std::vector<std::size_t> scans_before_;  ///< odometry readings in the file before each scan
};

}  // namespace

Result<LaserLog> parse_carmen_log(std::string_view text, const std::string& name) {
  Collector collector{name};
  int number = 0;
  std::vector<std::string> faults;
  while (!text.empty()) {
    ++number;
    const std::size_t end = text.find('\n');
    const bool torn = end == std::string_view::npos;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(torn ? text.size() : end + 1);
    try {
      collector.line(line, number);
    } catch (const LineFault& fault) {
      if (torn) collector.note("line " + std::to_string(number) + " is torn and was left out");
      if (!torn) faults.push_back(std::to_string(number) + ": " + fault.what);
    }
  }
  if (faults.size() * kFaultyShare > collector.taken()) return fail(name + ":" + faults.front());
  if (!faults.empty()) {
    std::string note = std::to_string(faults.size()) + (faults.size() == 1 ? " line was" : " lines were") + " left out";
    for (std::size_t i = 0; i < std::min(faults.size(), kMostNamed); ++i) note += "; line " + faults[i];
    collector.note(note + (faults.size() > kMostNamed ? "; and so on" : ""));
  }
  return collector.finish();
}

Result<LaserLog> read_carmen_log(const std::filesystem::path& path) {
  const auto text = read_gzip_text(path);
  if (!text) return tl::unexpected<Error>(text.error());
  if (text->fault.empty()) return parse_carmen_log(text->content, path.string());
  // Without the last line: half a number is one, too.
  const std::string_view whole{text->content};
  auto log = parse_carmen_log(whole.substr(0, whole.rfind('\n') + 1), path.string());
  if (!log) return fail(log.error().message + "; " + text->fault);
  log->notes.insert(log->notes.begin(), text->fault + ": what came before is used");
  return log;
}

}  // namespace docent::recording
