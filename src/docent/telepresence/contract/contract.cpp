#include "docent/telepresence/contract/contract.h"

#include <limits>

#include "docent/messages/conversions.h"
#include "docent/telepresence/api/api_documents.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/contract/typescript.h"
#include "docent/telepresence/document_json.h"
#include "docent/telepresence/documents.h"
#include "docent/telepresence/live_encoding.h"
#include "docent/telepresence/museum_document.h"
#include "docent/telepresence/museum_office/museum_documents.h"
#include "docent/telepresence/setup_office/setup_documents.h"
#include "docent/vocabulary/reason.h"

namespace docent::telepresence {
namespace {

const Time kNow = time_from_seconds(12.5);

docent_msgs::AvoidState avoid_state() {
  docent_msgs::AvoidState avoid;
  avoid.state = "stopped";
  avoid.reason = to_text(ReasonWord::person_in_way);
  avoid.path_blocked = avoid.unmapped_obstacle = true;
  avoid.nearest_real_m = 0.42;
  avoid.nearest_virtual_m = std::numeric_limits<double>::infinity();
  avoid.window = {{0.3F, 0.1F, 0.8F}, {0.6F, 0.0F, -1.0F}};
  return avoid;
}

std::string live() {
  LiveFrame frame;
  frame.now = kNow;
  frame.map_from_base = Pose2{1.25, -2.5, Angle::radians(0.5)};
  frame.linear = 0.3;
  frame.p_lost = 0.01;
  frame.is_scan_in_map = true;
  frame.scan = {{1.0, 2.0}, {-0.125, 3.456}};
  frame.people.people = {{7, 1.5F, 2.5F, 0.1F, 0.0F}};
  frame.avoid = avoid_state();
  frame.battery = 0.8;
  return encode_live(frame);
}

std::string pose() {
  LiveFrame frame;
  frame.now = kNow;
  frame.map_from_base = Pose2{1.25, -2.5, Angle::radians(0.5)};
  frame.linear = 0.3;
  frame.battery = 0.8;
  return encode_pose(frame);
}

std::string lost() {
  LiveFrame frame;
  frame.now = kNow;
  frame.hypotheses = {{Pose2{1, 2, Angle{}}, 0.4}};
  return encode_live(frame);
}

std::string belief() {
  docent_msgs::Belief belief;
  belief.header.stamp = to_message(kNow);
  belief.localized = true;
  belief.cells = {{1.0F, 2.0F, 0.0F, 0.7F}, {1.4F, 2.0F, 0.0F, 0.3F}};
  belief.hypotheses.resize(1);
  belief.hypotheses[0].mass = 0.9;
  return encode_belief(belief);
}

std::string path() {
  nav_msgs::Path path;
  path.poses.resize(2);
  path.poses[1].pose.position.x = 1.5;
  docent_msgs::GoalState goal;
  goal.id = "t1/drive";
  goal.state = to_text(GoalStatus::driving);
  goal.remaining_m = 1.5;
  return encode_path(path, goal);
}

std::string mission(bool asks) {
  docent_msgs::MissionState mission;
  mission.phase = to_text(asks ? MissionPhase::asking : MissionPhase::driving);
  mission.exhibit_id = "sputnik";
  mission.languages = {"en", "fr"};
  mission.texts = {"I am on my way.", "Je suis en route."};
  mission.agenda = {"sputnik", "vase"};
  if (asks) {
    mission.prompt.id = "t1/more";
    mission.prompt.language = "fr";
    mission.prompt.languages = mission.languages;
    mission.prompt.texts = {"More?", "Encore ?"};
    mission.prompt.options = {to_text(Answer::more), to_text(Answer::next)};
    mission.prompt.default_option = to_text(Answer::next);
    mission.prompt.deadline = to_message(kNow);
  }
  return encode_mission(mission);
}

std::string expression() {
  docent_msgs::Expression expression;
  expression.mood = to_text(Mood::happy);
  expression.valence = 0.7;
  expression.is_speaking = true;
  expression.gaze = "visitor";
  expression.pan = -0.3;
  return encode_expression(expression);
}

std::string board() {
  docent_msgs::RequestBoard board;
  board.revision = 3;
  for (const RequestStatus status : {RequestStatus::queued, RequestStatus::fulfilled}) {
    docent_msgs::RequestState entry;
    entry.request.id = "018f3a6c-5b2e-7c3d-9a4b-0123456789ab";
    entry.request.source = to_text(RequestSource::web);
    entry.request.visitor = "Ada";
    entry.request.kind = to_text(RequestKind::exhibit);
    entry.request.target = "sputnik";
    entry.state = to_text(status);
    if (status == RequestStatus::queued) entry.reason = Reason{ReasonWord::not_reached, "sputnik vase"}.text();
    entry.created = entry.changed = to_message(kNow);
    board.requests.push_back(entry);
  }
  return encode_board(board);
}

std::string health() {
  docent_msgs::Health module;
  module.state = "degraded";
  module.reason = "no voice";
  module.step_p99_ms = 1.25;
  return encode_health({{"sound", {module, kNow}}, {"web", {{}, Time{}}}}, 2, kNow);
}

std::string field() {
  sensor_msgs::LaserScan scan;
  scan.range_max = 6.0F;
  scan.angle_increment = 0.1F;
  scan.ranges = {1.0F, 6.0F, 1.0F, 6.0F};
  docent_msgs::PersonBeams beams;
  beams.bearings = {0.0F, 1.0F, 2.0F};
  beams.ranges = {2.0F, -1.0F, 0.5F};
  beams.origins = {1, 0, 3};
  return encode_field(scan, beams);
}

std::string exploration() {
  documents::ExplorationMessage message{"done", "by_itself", 81.5, 42.25, 0, {{3.5, 4.0}}, "no loop was closed", {}};
  message.map = {"/api/growing.png?3", 120, 80, 0.05, {-1.0, -2.0}};
  return json_text(message);
}

std::string museum() {
  museum::Museum museum;
  museum.name = {{"en", "A hall"}, {"fr", "Une salle"}};
  museum.languages = {"fr", "en"};
  museum.area = {{0, 0}, {5, 0}, {5, 4}};
  museum.charger = Pose2{1, 1, Angle{}};
  museum.hazards.resize(1);
  museum.hazards[0].id = "steps";
  museum.hazards[0].kind = museum::HazardKind::stairs;
  museum.hazards[0].polygon = {{1, 1}, {2, 1}, {2, 2}};
  museum.exhibits.resize(1);
  museum.exhibits[0].id = "sputnik";
  museum.exhibits[0].title = museum.exhibits[0].short_text = museum.name;
  museum.exhibits[0].viewpoints = {{2, 3, Angle{}}};
  museum.exhibits[0].topics = {"space"};
  museum.exhibits[0].picture = "content/sputnik.webp";
  museum.exhibits[0].links = {{museum.name, "https://en.wikipedia.org/wiki/Sputnik_1"}};
  museum.tours = {{"all", museum.name, {"sputnik"}, std::nullopt}, {"quick", museum.name, {}, 2.0}};
  return encode_museum(museum, 0.3);
}

}  // namespace

std::string contract_types() {
  TypeScript types;
  types.add<documents::Museum>();
  types.add_union("ServerMessage", static_cast<const documents::ServerMessage*>(nullptr));
  types.add<documents::Fault>();
  types.add<documents::Me>();
  types.add<documents::ForumThreads>();
  types.add<documents::ForumPosts>();
  types.add<documents::PostWritten>();
  types.add<documents::AuditLines>();
  types.add<documents::StatisticsDays>();
  types.add<documents::AccountLines>();
  types.add<documents::MuseumEdition>();
  types.add<documents::MuseumWish>();
  types.add<documents::MuseumFaults>();
  types.add<documents::KeptPicture>();
  types.add<documents::MuseumRecordings>();
  types.add<documents::SetupState>();
  types.add<documents::SetupName>();
  types.add<documents::SetupOrder>();
  types.add<documents::SetupWish>();
  types.add_union("ClientMessage", static_cast<const ClientMessage*>(nullptr));
  return "// What the server sends and takes. docent_web_contract writes this file from documents.h and "
         "client_message.h in\n"
         "// src/docent/telepresence: change those, and run it.\n\n" +
         types.text();
}

std::map<std::string, std::string> contract_samples() {
  docent_msgs::SpeechState speech;
  speech.id = "t1/short";
  speech.state = to_text(SpeechStatus::speaking);
  speech.text = "The first satellite.";
  speech.language = "en";
  speech.start = to_message(kNow);
  speech.duration = 3.25;
  speech.audio = "00ff";
  return {
      {"museum.json", museum()},
      {"live.json", live()},
      {"live_lost.json", lost()},
      {"pose.json", pose()},
      {"belief.json", belief()},
      {"path.json", path()},
      {"mission.json", mission(false)},
      {"mission_asking.json", mission(true)},
      {"speech.json", encode_speech(speech)},
      {"horn.json", encode_horn(kNow, "00ff.wav", 0.5)},
      {"sound.json", encode_sound({{}, 0.75, "00ff.ogg", 0.125, to_message(kNow)})},
      {"expression.json", expression()},
      {"button.json", encode_button(kNow, 3)},
      {"board.json", board()},
      {"votes.json", encode_votes({"018f3a6c-5b2e-7c3d-9a4b-0123456789ab", {{"highlights", 3}, {"space", 1}}})},
      {"hours.json", encode_hours("web", true, "open", "21:30")},
      {"field.json", field()},
      {"maps.json", json_text(documents::MapsMessage{{0.5, 1.0, 0.15, 2, 1, base64({255, 1})},
                                                     {0.0, 0.0, 0.15, 1, 1, base64({255})}})},
      {"exploration.json", exploration()},
      {"log.json", json_text(documents::LogMessage{{{12.5, "visit_started", "sputnik", ""}}})},
      {"operation.json", json_text(documents::OperationMessage{"ada", true, true, "grace", 3, "web"})},
      {"health.json", health()},
      {"window.json", encode_window(avoid_state())},
      {"ack.json", encode_acknowledgement("018f3a6c-5b2e-7c3d-9a4b-0123456789ab")},
      {"refused.json", encode_refusal("018f3a6c-5b2e-7c3d-9a4b-0123456789ab", {ReasonWord::no_such_exhibit, "vase"})},
      {"error.json", encode_error(ReasonWord::too_fast)}};
}

}  // namespace docent::telepresence
