#include "docent/telepresence/api/endpoint.h"
#include "docent/telepresence/museum_office/museum_documents.h"

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

}  // namespace

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
  };
}

}  // namespace docent::telepresence
