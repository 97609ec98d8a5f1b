#include "docent/telepresence/api/endpoint.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/museum_office/exhibit_picture.h"
#include "docent/telepresence/museum_office/museum_documents.h"
#include "docent/telepresence/robot_office/robot_office.h"
#include "docent/telepresence/setup_office/setup_office.h"

namespace docent::telepresence {
namespace {

using documents::MuseumEdition;
using documents::MuseumFaults;
using documents::MuseumWish;
using documents::Nothing;
using Outcome = Result<museum::MuseumWorkshop::Outcome>;

constexpr const char* kNoMuseum = "no museum can be changed here";

ApiAnswer<MuseumEdition> read_museum(ApiCall& call, const Nothing& /*wish*/) {
  const auto& office = call.services.museum;
  if (!office) return refuse(ApiFault::not_found, kNoMuseum);
  const auto edition = office->workshop.read();
  if (!edition) return refuse(ApiFault::not_stored, edition.error().message);
  return MuseumEdition{edition->revision, office->workshop.is_trial(), document_of(museum::draft_of(edition->museum))};
}

ApiAnswer<MuseumFaults> check(ApiCall& call, const documents::MuseumDraft& draft) {
  const auto& office = call.services.museum;
  if (!office) return refuse(ApiFault::not_found, kNoMuseum);
  auto faults = office->workshop.check(draft_of(draft));
  if (!faults) return refuse(ApiFault::not_stored, faults.error().message);
  return MuseumFaults{std::move(*faults)};
}

/// Has the robot work in what `change` has made.
ApiAnswer<MuseumFaults> change(ApiCall& call, bool into_trial,
                               const std::function<Outcome(const MuseumOffice&)>& change) {
  const auto& office = call.services.museum;
  if (!office) return refuse(ApiFault::not_found, kNoMuseum);
  if (!office->is_stopped()) return refuse(ApiFault::must_stand);
  auto outcome = change(*office);
  if (!outcome) return refuse(ApiFault::not_stored, outcome.error().message);
  if (outcome->is_outdated) return refuse(ApiFault::outdated);
  if (outcome->faults.empty()) office->move(into_trial);
  return MuseumFaults{std::move(outcome->faults)};
}

ApiAnswer<MuseumFaults> try_out(ApiCall& call, const MuseumWish& wish) {
  return change(call, true, [&](const MuseumOffice& office) -> Outcome {
    return office.workshop.try_out(draft_of(wish.draft), wish.revision);
  });
}

ApiAnswer<MuseumFaults> publish(ApiCall& call, const MuseumWish& wish) {
  return change(call, false, [&](const MuseumOffice& office) -> Outcome {
    return office.workshop.publish(draft_of(wish.draft), wish.revision);
  });
}

ApiAnswer<MuseumFaults> end_trial(ApiCall& call, const Nothing& /*wish*/) {
  return change(call, false,
                [](const MuseumOffice& /*office*/) -> Outcome { return museum::MuseumWorkshop::Outcome{}; });
}

ApiAnswer<documents::KeptPicture> keep_picture(ApiCall& call, const documents::MuseumPicture& wish) {
  const auto& office = call.services.museum;
  if (!office) return refuse(ApiFault::not_found, kNoMuseum);
  const auto picture = exhibit_picture(wish.jpeg);
  if (!picture) return documents::KeptPicture{"", {picture.error().message}};
  const auto kept = office->workshop.keep_picture(*picture, ".jpg");
  if (!kept) return refuse(ApiFault::not_stored, kept.error().message);
  return documents::KeptPicture{kept->generic_string(), {}};
}

ApiAnswer<documents::MuseumRecordings> read_recordings(ApiCall& call, const Nothing& /*wish*/) {
  const auto& office = call.services.museum;
  if (!office || !office->recordings) return refuse(ApiFault::not_found, kNoMuseum);
  auto edition = office->workshop.read();
  if (!edition) return refuse(ApiFault::not_stored, edition.error().message);
  edition->museum.folder = office->workshop.published();
  return office->recordings(edition->museum);
}

// A museum that is being set up.

constexpr const char* kNoSetup = "no museum is being set up here: docent setup does that";

ApiAnswer<documents::SetupState> read_setup(ApiCall& call, const Nothing& /*wish*/) {
  const auto& office = call.services.setup;
  if (!office) return refuse(ApiFault::not_found, kNoSetup);
  auto state = state_of(*office);
  if (!state) return refuse(ApiFault::not_stored, state.error().message);
  return *state;
}

/// What `work` does to the folder; all modules begin anew when it has done it.
ApiAnswer<MuseumFaults> change_setup(ApiCall& call, const std::function<Result<void>(const SetupOffice&)>& work) {
  const auto& office = call.services.setup;
  if (!office) return refuse(ApiFault::not_found, kNoSetup);
  if (auto done = work(*office); !done) return MuseumFaults{{done.error().message}};
  office->move();
  return MuseumFaults{};
}

ApiAnswer<MuseumFaults> name_museum(ApiCall& call, const documents::SetupName& wish) {
  return change_setup(call, [&](const SetupOffice& office) { return office.setup.name(wish.name, wish.languages); });
}

ApiAnswer<Nothing> order(ApiCall& call, const documents::SetupOrder& wish) {
  const auto& office = call.services.setup;
  if (!office) return refuse(ApiFault::not_found, kNoSetup);
  office->order(wish.order);
  return Nothing{};
}

ApiAnswer<MuseumFaults> keep_map(ApiCall& call, const Nothing& /*wish*/) {
  return change_setup(call, [](const SetupOffice& office) { return office.setup.keep_map(); });
}

ApiAnswer<MuseumFaults> map_again(ApiCall& call, const Nothing& /*wish*/) {
  return change_setup(call, [](const SetupOffice& office) { return office.setup.map_again(std::nullopt); });
}

ApiAnswer<MuseumFaults> go(ApiCall& call, const documents::SetupWish& wish) {
  const auto& office = call.services.setup;
  if (!office) return refuse(ApiFault::not_found, kNoSetup);
  const auto before = office->setup.read();
  auto faults = office->setup.go(wish.step);
  if (!faults) return refuse(ApiFault::not_stored, faults.error().message);
  const bool has_other_work = before && museum::work_of(before->step) != museum::work_of(wish.step);
  if (faults->empty() && has_other_work) office->move();
  return MuseumFaults{std::move(*faults)};
}

// A robot that is sent about.

constexpr const char* kNoRobot = "no robot is sent about here";

ApiAnswer<documents::RobotState> read_robot(ApiCall& call, const Nothing& /*wish*/) {
  const auto& office = call.services.robot;
  if (!office) return refuse(ApiFault::not_found, kNoRobot);
  return office->state();
}

ApiAnswer<Nothing> send_robot(ApiCall& call, const documents::RobotGoal& goal) {
  const auto& office = call.services.robot;
  if (!office) return refuse(ApiFault::not_found, kNoRobot);
  if (std::string fault = fault_of(goal); !fault.empty()) return refuse(ApiFault::not_understood, std::move(fault));
  office->drive(goal);
  return Nothing{};
}

ApiAnswer<Nothing> withdraw_goal(ApiCall& call, const Nothing& /*wish*/) {
  const auto& office = call.services.robot;
  if (!office) return refuse(ApiFault::not_found, kNoRobot);
  const std::string& goal = call.path.at("goal");
  if (!is_uuid7(goal)) return refuse(ApiFault::not_understood, "the goal must be a UUID of version 7");
  office->cancel(goal);
  return Nothing{};
}

ApiAnswer<documents::OfficeReport> read_office(ApiCall& call, const Nothing& /*wish*/) {
  const auto& office = call.services.robot;
  if (!office) return refuse(ApiFault::not_found, kNoRobot);
  return office->report();
}

ApiAnswer<Nothing> order_office(ApiCall& call, const documents::OfficeWish& wish) {
  const auto& office = call.services.robot;
  if (!office) return refuse(ApiFault::not_found, kNoRobot);
  if (std::string fault = fault_of(wish); !fault.empty()) return refuse(ApiFault::not_understood, std::move(fault));
  office->order(wish);
  return Nothing{};
}

}  // namespace

std::vector<Endpoint> robot_endpoints() {
  const auto row = [](const char* method, const char* path, const char* name, const char* summary) {
    return at(method, path, Rank::operator_, name, summary);
  };
  return {
      endpoint<Nothing, documents::RobotState>(
          row("GET", "/robot", "read_robot", "How the robot is, and what became of where it was sent"), read_robot),
      endpoint<documents::RobotGoal, Nothing>(
          row("PUT", "/robot/goal", "send_robot", "Sends the robot to a pose, before all wishes of visitors"),
          send_robot),
      endpoint<Nothing, Nothing>(
          row("DELETE", "/robot/goal/{goal}", "withdraw_goal", "Takes that back: the robot does not go there any more"),
          withdraw_goal),
      endpoint<Nothing, documents::OfficeReport>(
          row("GET", "/robot/office", "read_office", "How a delivery or the tidying up goes"), read_office),
      endpoint<documents::OfficeWish, Nothing>(
          row("PUT", "/robot/office", "order_office", "Has the robot bring something to a room, or tidy up"),
          order_office),
  };
}

std::vector<Endpoint> museum_endpoints() {
  return {
      endpoint<Nothing, MuseumEdition>(
          at("GET", "/museum", Rank::operator_, "read_museum", "The museum as it may be changed"), read_museum),
      endpoint<documents::MuseumDraft, MuseumFaults>(
          at("POST", "/museum/check", Rank::operator_, "check_museum", "What in a draft could not work"), check),
      endpoint<MuseumWish, MuseumFaults>(at("PUT", "/museum/trial", Rank::operator_, "try_museum",
                                            "Has the robot, which stands, work in a draft until it starts again"),
                                         try_out),
      endpoint<Nothing, MuseumFaults>(at("DELETE", "/museum/trial", Rank::operator_, "end_trial",
                                         "Has the robot, which stands, work in the published museum again"),
                                      end_trial),
      endpoint<MuseumWish, MuseumFaults>(
          at("PUT", "/museum", Rank::operator_, "publish_museum",
             "Writes a draft into the museum's folder, and has the robot, which stands, work in it"),
          publish),
      endpoint<documents::MuseumPicture, documents::KeptPicture>(
          at("POST", "/museum/picture", Rank::operator_, "keep_picture",
             "Keeps a picture in the museum's folder, which an exhibit of a draft may name then"),
          keep_picture),
      endpoint<Nothing, documents::MuseumRecordings>(
          at("GET", "/museum/recordings", Rank::operator_, "read_recordings",
             "What people have recorded instead of the voice, and what they may"),
          read_recordings),
  };
}

std::vector<Endpoint> setup_endpoints() {
  const auto row = [](const char* method, const char* path, const char* name, const char* summary) {
    return at(method, path, Rank::operator_, name, summary);
  };
  return {
      endpoint<Nothing, documents::SetupState>(
          row("GET", "/setup", "read_setup", "How far the setting up of the museum is"), read_setup),
      endpoint<documents::SetupName, MuseumFaults>(
          row("PUT", "/setup/name", "name_museum", "What the museum is called, and which languages it speaks"),
          name_museum),
      endpoint<documents::SetupOrder, Nothing>(
          row("PUT", "/setup/order", "order_exploration", "Who drives while the museum is mapped"), order),
      endpoint<Nothing, MuseumFaults>(
          row("PUT", "/setup/map", "keep_map", "Takes the map that the robot has made for the museum's"), keep_map),
      endpoint<Nothing, MuseumFaults>(
          row("DELETE", "/setup/map", "map_again", "Forgets map, hazards and exhibits, and begins a new map"),
          map_again),
      endpoint<documents::SetupWish, MuseumFaults>(
          row("PUT", "/setup/step", "go_to_step", "Goes to another step of the set-up"), go),
  };
}

}  // namespace docent::telepresence
