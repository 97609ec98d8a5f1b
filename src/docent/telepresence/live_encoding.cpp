#include "docent/telepresence/live_encoding.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "docent/messages/conversions.h"
#include "docent/telepresence/belief_raster.h"
#include "docent/telepresence/document_json.h"
#include "docent/telepresence/documents.h"
#include "docent/telepresence/site.h"
#include "docent/vocabulary/reason.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {
namespace {

/// The last eight digits of an id: who knows all of it may cancel a request.
std::string end_of(const std::string& id) { return id.size() > 8 ? id.substr(id.size() - 8) : id; }

/// Rounded, so that the text stays short.
double rounded(double value, double scale = 1000.0) { return std::round(value * scale) / scale; }

/// nullopt: it is not finite.
std::optional<double> finite(double value) { return std::isfinite(value) ? std::optional{value} : std::nullopt; }

double seconds_of(const builtin_interfaces::Time& time) { return to_seconds(from_message(time)); }

documents::Pose pose_of(const Pose2& pose) { return {rounded(pose.x), rounded(pose.y), rounded(pose.theta.radians())}; }

bool is_open(const docent_msgs::RequestState& request) {
  const auto status = parse<RequestStatus>(request.state);
  return status && docent::is_open(*status);
}

/// nullopt: there is none that the page has words for.
std::optional<documents::Reason> reason_of(const Reason& reason) {
  if (!reason.word()) return std::nullopt;
  return documents::Reason{*reason.word(), reason.about()};
}

documents::BoardEntry entry_of(const docent_msgs::RequestState& entry) {
  const auto& request = entry.request;
  return {end_of(request.id),
          request.source,
          request.visitor,
          request.kind,
          request.target,
          request.viewpoint,
          entry.state,
          reason_of(Reason::from_text(entry.reason)),
          rounded(seconds_of(entry.created)),
          rounded(seconds_of(entry.changed))};
}

documents::Texts by_language(const std::vector<std::string>& languages, const std::vector<std::string>& texts) {
  documents::Texts result;
  for (std::size_t i = 0; i < std::min(languages.size(), texts.size()); ++i) result[languages[i]] = texts[i];
  return result;
}

std::string address_of(const std::string& audio) { return is_audio_name(audio) ? "/audio/" + audio : ""; }

}  // namespace

std::string encode_live(const LiveFrame& frame) {
  documents::LiveMessage live;
  live.t = rounded(to_seconds(frame.now));
  if (frame.map_from_base) live.pose = pose_of(*frame.map_from_base);
  live.v = rounded(frame.linear);
  live.w = rounded(frame.angular);
  live.p_lost = rounded(frame.p_lost);
  for (const auto& hypothesis : frame.hypotheses) {
    const auto [x, y, heading] = pose_of(hypothesis.map_from_base);
    live.hypotheses.push_back({x, y, heading, rounded(hypothesis.mass)});
  }
  live.scan.frame = frame.is_scan_in_map ? ScanFrame::map : ScanFrame::base;
  live.scan.from = {rounded(frame.scan_origin.x), rounded(frame.scan_origin.y)};
  for (const Point2 point : frame.scan) {
    live.scan.points.push_back(std::lround(point.x * 100.0));
    live.scan.points.push_back(std::lround(point.y * 100.0));
  }
  for (const auto& person : frame.people.people) {
    live.people.emplace_back(person.id, rounded(person.x, 100), rounded(person.y, 100), rounded(person.vx, 100),
                             rounded(person.vy, 100));
  }
  if (frame.avoid) {
    live.avoid = {frame.avoid->state,
                  reason_of(Reason::from_text(frame.avoid->reason)),
                  rounded(frame.avoid->speed_cap),
                  frame.avoid->path_blocked,
                  frame.avoid->unmapped_obstacle,
                  finite(rounded(frame.avoid->nearest_real_m, 100)),
                  finite(rounded(frame.avoid->nearest_virtual_m, 100))};
  }
  if (frame.battery) live.battery = rounded(*frame.battery, 100);
  return json_text(live);
}

std::string encode_pose(const LiveFrame& frame) {
  documents::PoseMessage message;
  message.t = rounded(to_seconds(frame.now));
  if (frame.map_from_base) message.pose = pose_of(*frame.map_from_base);
  message.v = rounded(frame.linear);
  message.w = rounded(frame.angular);
  message.p_lost = rounded(frame.p_lost);
  if (frame.battery) message.battery = rounded(*frame.battery, 100);
  return json_text(message);
}

std::string encode_belief(const docent_msgs::Belief& belief) {
  const BeliefRaster raster = belief_raster(belief);
  documents::BeliefMessage message;
  message.t = rounded(seconds_of(belief.header.stamp));
  message.localized = belief.localized;
  message.p_lost = rounded(belief.p_lost);
  message.entropy = rounded(belief.entropy);
  message.active = belief.active_cells;
  message.beams = {belief.beams_used, belief.beams_filtered};
  for (std::size_t i = 0; i < std::min<std::size_t>(belief.hypotheses.size(), 12); ++i) {
    const auto& h = belief.hypotheses[i];
    message.hypotheses.push_back({{rounded(h.x), rounded(h.y), rounded(h.theta)},
                                  rounded(h.mass),
                                  rounded(h.covariance[0], 1e5),
                                  rounded(h.covariance[1], 1e5),
                                  rounded(h.covariance[4], 1e5)});
  }
  message.raster = {
      rounded(raster.origin.x), rounded(raster.origin.y), rounded(raster.cell), raster.columns, raster.rows,
      base64(raster.levels)};
  return json_text(message);
}

std::string encode_path(const nav_msgs::Path& path, const docent_msgs::GoalState& state) {
  // A path has a point a cell; a line on a screen needs fewer.
  constexpr std::size_t kMaxPoints = 400;
  const std::size_t step = path.poses.size() / kMaxPoints + 1;
  documents::PathMessage message;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    if (i % step != 0 && i + 1 != path.poses.size()) continue;
    message.points.push_back(rounded(path.poses[i].pose.position.x, 100));
    message.points.push_back(rounded(path.poses[i].pose.position.y, 100));
  }
  message.goal = state.id;
  message.state = state.state;
  message.remaining = rounded(state.remaining_m, 10);
  message.blocked = rounded(state.blocked_s, 10);
  return json_text(message);
}

std::string encode_mission(const docent_msgs::MissionState& mission) {
  documents::MissionMessage message{mission.phase,
                                    mission.tour_id,
                                    mission.exhibit_id,
                                    by_language(mission.languages, mission.texts),
                                    mission.agenda,
                                    mission.exhibits_explained,
                                    mission.tours_completed,
                                    mission.requests_served,
                                    std::nullopt};
  if (const auto& prompt = mission.prompt; !prompt.id.empty()) {
    message.prompt = {prompt.id,
                      by_language(prompt.languages, prompt.texts),
                      prompt.language,
                      prompt.options,
                      prompt.default_option,
                      rounded(seconds_of(prompt.deadline))};
  }
  return json_text(message);
}

std::string encode_speech(const docent_msgs::SpeechState& speech) {
  std::string audio = speech.audio;
  if (!audio.empty() && audio.find('.') == std::string::npos) audio += ".wav";
  return json_text(documents::SpeechMessage{speech.id, speech.state, speech.text, speech.language,
                                            rounded(seconds_of(speech.start)), rounded(speech.duration),
                                            address_of(audio)});
}

std::string encode_horn(Time t, const std::string& file, double duration_s) {
  return json_text(documents::HornMessage{rounded(to_seconds(t)), rounded(duration_s), address_of(file)});
}

std::string encode_sound(const docent_msgs::SoundState& sound) {
  const auto loudness = [](double value) { return rounded(std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0); };
  return json_text(documents::SoundMessage{loudness(sound.volume), address_of(sound.music),
                                           loudness(sound.music_volume), rounded(seconds_of(sound.music_start))});
}

std::string encode_expression(const docent_msgs::Expression& expression) {
  constexpr double kFine = 50.0;     // steps of the valence, and of the head to a radian: finer than eyes see on a face
  constexpr double kMostTurn = 3.2;  // [rad]
  const auto angle = [&](double value) { return rounded(std::clamp(value, -kMostTurn, kMostTurn), kFine); };
  return json_text(documents::ExpressionMessage{
      parse<Mood>(expression.mood).value_or(Mood::neutral), rounded(std::clamp(expression.valence, -1.0, 1.0), kFine),
      expression.is_speaking, expression.gaze, angle(expression.pan), angle(expression.tilt)});
}

std::string encode_button(Time t, int number) {
  return json_text(documents::ButtonMessage{rounded(to_seconds(t)), number});
}

std::string encode_board(const docent_msgs::RequestBoard& board) {
  constexpr std::size_t kMaxOpen = 500;  // as many as the board takes, mission.max_open
  constexpr std::size_t kMaxClosed = 30;
  documents::BoardMessage message;
  message.revision = board.revision;
  std::vector<const docent_msgs::RequestState*> closed;
  for (const auto& entry : board.requests) {
    if (!is_open(entry)) {
      closed.push_back(&entry);
    } else if (++message.open_count <= kMaxOpen) {
      message.open.push_back(entry_of(entry));
    }
  }
  std::stable_sort(closed.begin(), closed.end(),
                   [](const auto* a, const auto* b) { return from_message(a->changed) > from_message(b->changed); });
  if (closed.size() > kMaxClosed) closed.resize(kMaxClosed);
  for (const auto* entry : closed) message.closed.push_back(entry_of(*entry));
  return json_text(message);
}

std::string encode_votes(const Tally& tally) {
  documents::VotesMessage message;
  message.round = end_of(tally.round);
  for (const auto& [tour, count] : tally.counts) message.tours.emplace_back(tour, count);
  return json_text(message);
}

std::string encode_hours(const std::string& mode, bool is_open, const std::string& next_mode,
                         const std::string& next_at) {
  return json_text(documents::HoursMessage{mode, is_open, next_mode, next_at});
}

std::string encode_health(const std::map<std::string, HealthEntry>& modules, std::size_t viewers, Time now) {
  constexpr Duration kSilent = std::chrono::seconds{2};
  documents::HealthMessage message{viewers, {}};
  for (const auto& [name, entry] : modules) {
    const bool is_silent = now - entry.heard > kSilent;
    message.modules.push_back({name, is_silent ? "silent" : entry.health.state, entry.health.reason,
                               finite(rounded(entry.health.step_p99_ms, 10))});
  }
  return json_text(message);
}

std::string encode_window(const docent_msgs::AvoidState& avoid) {
  documents::WindowMessage message{rounded(avoid.linear), rounded(avoid.angular), {}};
  for (const auto& candidate : avoid.window) {
    message.candidates.push_back(rounded(candidate.linear));
    message.candidates.push_back(rounded(candidate.angular));
    message.candidates.push_back(rounded(candidate.value));
  }
  return json_text(message);
}

std::string encode_field(const sensor_msgs::LaserScan& virtual_scan, const docent_msgs::PersonBeams& beams) {
  const auto in_cm = [](double metres) { return static_cast<int>(std::lround(100.0 * metres)); };
  documents::FieldMessage message;
  // The first turn: what binds the whole body.
  for (std::size_t i = 0; i < virtual_scan.ranges.size() / 2; ++i) {
    const double range = virtual_scan.ranges[i];
    if (!(range < virtual_scan.range_max)) continue;
    const double bearing = virtual_scan.angle_min + static_cast<double>(i) * virtual_scan.angle_increment;
    message.virtual_points.push_back(in_cm(range * std::cos(bearing)));
    message.virtual_points.push_back(in_cm(range * std::sin(bearing)));
  }
  const std::size_t count = std::min({beams.bearings.size(), beams.ranges.size(), beams.origins.size()});
  for (std::size_t i = 0; i < count; ++i) {
    if (!(beams.ranges[i] > 0.0F && beams.ranges[i] < 100.0F)) continue;
    message.beams.push_back(in_cm(beams.ranges[i] * std::cos(beams.bearings[i])));
    message.beams.push_back(in_cm(beams.ranges[i] * std::sin(beams.bearings[i])));
    message.beams.push_back(beams.origins[i]);
  }
  return json_text(message);
}

std::string encode_acknowledgement(const std::string& id) { return json_text(documents::Acknowledgement{id}); }

std::string encode_refusal(const std::string& id, const Reason& reason) {
  return json_text(documents::Refusal{id, reason_of(reason).value()});
}

std::string encode_error(const Reason& reason) { return json_text(documents::ErrorMessage{reason_of(reason).value()}); }

std::vector<Point2> scan_points(const sensor_msgs::LaserScan& scan, const Pose2& base_from_sensor, std::size_t every) {
  std::vector<Point2> points;
  points.reserve(scan.ranges.size() / every + 1);
  for (std::size_t i = 0; i < scan.ranges.size(); i += every) {
    const double range = scan.ranges[i];
    if (!(range >= scan.range_min && range <= scan.range_max)) continue;
    const double bearing = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    points.push_back(base_from_sensor * Point2{range * std::cos(bearing), range * std::sin(bearing)});
  }
  return points;
}

}  // namespace docent::telepresence
