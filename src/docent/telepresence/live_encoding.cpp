#include "docent/telepresence/live_encoding.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "docent/messages/conversions.h"
#include "docent/telepresence/belief_raster.h"
#include "docent/telepresence/site.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent {
namespace {

using Json = nlohmann::json;

/// Rounded, so that the text stays short; what is not finite becomes null.
Json rounded(double value, double scale = 1000.0) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * scale) / scale;
}

double seconds_of(const builtin_interfaces::Time& time) { return to_seconds(from_message(time)); }

/// Whatever bytes a message carries, the text is valid UTF-8.
std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json pose_of(const Pose2& pose) { return {rounded(pose.x), rounded(pose.y), rounded(pose.theta.radians())}; }

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t group = (static_cast<std::uint32_t>(bytes[i]) << 16U) |
                                (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8U : 0U) |
                                (left > 2 ? static_cast<std::uint32_t>(bytes[i + 2]) : 0U);
    text += kDigits[group >> 18U];
    text += kDigits[(group >> 12U) & 63U];
    text += left > 1 ? kDigits[(group >> 6U) & 63U] : '=';
    text += left > 2 ? kDigits[group & 63U] : '=';
  }
  return text;
}

bool is_open(const docent_msgs::RequestState& request) {
  const auto status = parse<RequestStatus>(request.state);
  return status && docent::is_open(*status);
}

Json request_of(const docent_msgs::RequestState& entry) {
  const auto& id = entry.request.id;
  return {{"key", id.size() > 8 ? id.substr(id.size() - 8) : id},
          {"source", entry.request.source},
          {"visitor", entry.request.visitor},
          {"kind", entry.request.kind},
          {"target", entry.request.target},
          {"viewpoint", entry.request.viewpoint},
          {"state", entry.state},
          {"reason", entry.reason},
          {"created", rounded(seconds_of(entry.created))},
          {"changed", rounded(seconds_of(entry.changed))}};
}

/// What the robot is doing, by language. A recording of before has two.
Json texts_of(const docent_msgs::MissionState& mission) {
  if (mission.languages.empty()) return {{"en", mission.text_en}, {"de", mission.text_de}};
  Json texts = Json::object();
  for (std::size_t i = 0; i < std::min(mission.languages.size(), mission.texts.size()); ++i)
    texts[mission.languages[i]] = mission.texts[i];
  return texts;
}

}  // namespace

std::string encode_live(const LiveFrame& frame) {
  Json json{{"type", "live"}, {"t", rounded(to_seconds(frame.now))}};
  json["pose"] = frame.map_from_base ? pose_of(*frame.map_from_base) : Json{};
  json["v"] = rounded(frame.linear);
  json["w"] = rounded(frame.angular);
  json["p_lost"] = rounded(frame.p_lost);
  Json& hypotheses = json["hypotheses"] = Json::array();
  for (const auto& hypothesis : frame.hypotheses) {
    Json entry = pose_of(hypothesis.map_from_base);
    entry.push_back(rounded(hypothesis.mass));
    hypotheses.push_back(std::move(entry));
  }
  Json points = Json::array();
  for (const Point2 point : frame.scan) {
    points.push_back(std::lround(point.x * 100.0));
    points.push_back(std::lround(point.y * 100.0));
  }
  json["scan"] = {{"frame", frame.is_scan_in_map ? "map" : "base"},
                  {"from", {rounded(frame.scan_origin.x), rounded(frame.scan_origin.y)}},
                  {"points", std::move(points)}};
  Json& people = json["people"] = Json::array();
  for (const auto& person : frame.people.people) {
    people.push_back(
        {person.id, rounded(person.x, 100), rounded(person.y, 100), rounded(person.vx, 100), rounded(person.vy, 100)});
  }
  if (frame.avoid) {
    json["avoid"] = {{"state", frame.avoid->state},
                     {"reason", frame.avoid->reason},
                     {"cap", rounded(frame.avoid->speed_cap)},
                     {"blocked", frame.avoid->path_blocked},
                     {"person", frame.avoid->unmapped_obstacle},
                     {"real", rounded(frame.avoid->nearest_real_m, 100)},
                     {"virtual", rounded(frame.avoid->nearest_virtual_m, 100)}};
  }
  if (frame.battery) json["battery"] = rounded(*frame.battery, 100);
  return text_of(json);
}

std::string encode_belief(const docent_msgs::Belief& belief) {
  const BeliefRaster raster = belief_raster(belief);
  Json hypotheses = Json::array();
  for (std::size_t i = 0; i < std::min<std::size_t>(belief.hypotheses.size(), 12); ++i) {
    const auto& h = belief.hypotheses[i];
    hypotheses.push_back({{"pose", {rounded(h.x), rounded(h.y), rounded(h.theta)}},
                          {"mass", rounded(h.mass)},
                          {"xx", rounded(h.covariance[0], 1e5)},
                          {"xy", rounded(h.covariance[1], 1e5)},
                          {"yy", rounded(h.covariance[4], 1e5)}});
  }
  return text_of({{"type", "belief"},
                  {"t", rounded(seconds_of(belief.header.stamp))},
                  {"localized", belief.localized},
                  {"p_lost", rounded(belief.p_lost)},
                  {"entropy", rounded(belief.entropy)},
                  {"active", belief.active_cells},
                  {"beams", {belief.beams_used, belief.beams_filtered}},
                  {"hypotheses", std::move(hypotheses)},
                  {"raster",
                   {{"x", rounded(raster.origin.x)},
                    {"y", rounded(raster.origin.y)},
                    {"cell", rounded(raster.cell)},
                    {"columns", raster.columns},
                    {"rows", raster.rows},
                    {"levels", base64(raster.levels)}}}});
}

std::string encode_path(const nav_msgs::Path& path, const docent_msgs::GoalState& state) {
  // A path has a point a cell; a line on a screen needs fewer.
  constexpr std::size_t kMaxPoints = 400;
  const std::size_t step = path.poses.size() / kMaxPoints + 1;
  Json points = Json::array();
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    if (i % step != 0 && i + 1 != path.poses.size()) continue;
    points.push_back(rounded(path.poses[i].pose.position.x, 100));
    points.push_back(rounded(path.poses[i].pose.position.y, 100));
  }
  return text_of({{"type", "path"},
                  {"points", std::move(points)},
                  {"goal", state.id},
                  {"state", state.state},
                  {"remaining", rounded(state.remaining_m, 10)},
                  {"blocked", rounded(state.blocked_s, 10)},
                  {"reason", state.reason}});
}

std::string encode_mission(const docent_msgs::MissionState& mission) {
  const auto& prompt = mission.prompt;
  Json json{{"type", "mission"},
            {"phase", mission.phase},
            {"tour", mission.tour_id},
            {"exhibit", mission.exhibit_id},
            {"text", texts_of(mission)},
            {"agenda", mission.agenda},
            {"explained", mission.exhibits_explained},
            {"tours", mission.tours_completed},
            {"served", mission.requests_served}};
  json["prompt"] = prompt.id.empty() ? Json{}
                                     : Json{{"id", prompt.id},
                                            {"text", prompt.text},
                                            {"options", prompt.options},
                                            {"default", prompt.default_option},
                                            {"deadline", rounded(seconds_of(prompt.deadline))}};
  return text_of(json);
}

std::string encode_speech(const docent_msgs::SpeechState& speech) {
  std::string audio = speech.audio;
  if (!audio.empty() && !audio.ends_with(".wav")) audio += ".wav";
  return text_of({{"type", "speech"},
                  {"id", speech.id},
                  {"state", speech.state},
                  {"text", speech.text},
                  {"language", speech.language},
                  {"start", rounded(seconds_of(speech.start))},
                  {"duration", rounded(speech.duration)},
                  {"audio", is_audio_name(audio) ? "/audio/" + audio : ""}});
}

std::string encode_horn(Time t, const std::string& file, double duration_s) {
  return text_of({{"type", "horn"},
                  {"t", rounded(to_seconds(t))},
                  {"duration", rounded(duration_s)},
                  {"audio", is_audio_name(file) ? "/audio/" + file : ""}});
}

std::string encode_board(const docent_msgs::RequestBoard& board) {
  constexpr std::size_t kMaxOpen = 500;  // as many as the board takes, mission.max_open
  constexpr std::size_t kMaxClosed = 30;
  Json open = Json::array();
  std::vector<const docent_msgs::RequestState*> closed;
  std::size_t open_count = 0;
  for (const auto& entry : board.requests) {
    if (!is_open(entry)) {
      closed.push_back(&entry);
    } else if (++open_count <= kMaxOpen) {
      open.push_back(request_of(entry));
    }
  }
  std::stable_sort(closed.begin(), closed.end(),
                   [](const auto* a, const auto* b) { return from_message(a->changed) > from_message(b->changed); });
  if (closed.size() > kMaxClosed) closed.resize(kMaxClosed);
  Json done = Json::array();
  for (const auto* entry : closed) done.push_back(request_of(*entry));
  return text_of({{"type", "board"},
                  {"revision", board.revision},
                  {"open", std::move(open)},
                  {"open_count", open_count},
                  {"closed", std::move(done)}});
}

std::string encode_health(const std::map<std::string, HealthEntry>& modules, std::size_t viewers, Time now) {
  constexpr Duration kSilent = std::chrono::seconds{2};
  Json list = Json::array();
  for (const auto& [name, entry] : modules) {
    const bool is_silent = now - entry.heard > kSilent;
    list.push_back({{"name", name},
                    {"state", is_silent ? "silent" : entry.health.state},
                    {"reason", entry.health.reason},
                    {"p99_ms", rounded(entry.health.step_p99_ms, 10)}});
  }
  return text_of({{"type", "health"}, {"viewers", viewers}, {"modules", std::move(list)}});
}

std::string encode_window(const docent_msgs::AvoidState& avoid) {
  Json points = Json::array();
  for (const auto& candidate : avoid.window) {
    points.push_back(rounded(candidate.linear));
    points.push_back(rounded(candidate.angular));
    points.push_back(rounded(candidate.value));
  }
  return text_of({{"type", "window"},
                  {"v", rounded(avoid.linear)},
                  {"w", rounded(avoid.angular)},
                  {"candidates", std::move(points)}});
}

std::string encode_acknowledgement(const std::string& id) { return text_of({{"type", "ack"}, {"id", id}}); }

std::string encode_refusal(const std::string& id, const std::string& reason) {
  return text_of({{"type", "refused"}, {"id", id}, {"reason", reason}});
}

std::string encode_error(const std::string& reason) { return text_of({{"type", "error"}, {"reason", reason}}); }

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

}  // namespace docent
