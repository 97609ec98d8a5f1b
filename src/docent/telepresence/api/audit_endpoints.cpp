#include "docent/telepresence/api/endpoint.h"

namespace docent::telepresence {
namespace {

using documents::Nothing;

ApiAnswer<documents::AuditLines> audit(ApiCall& call, const Nothing& /*wish*/) {
  const auto given = [&](const char* name) {
    const auto place = call.query.find(name);
    return place == call.query.end() ? std::string{} : place->second;
  };
  AuditSearch search;
  search.account = given("account");
  search.address = given("address");
  search.before = given("before");
  for (auto [name, time] : {std::pair{"from", &search.from}, std::pair{"until", &search.until}}) {
    if (given(name).empty()) continue;
    *time = time_of(given(name));
    if (!*time) return refuse(ApiFault::not_understood, std::string{name} + " must be a time");
  }
  if (!search.before.empty() && !Audit::is_place(search.before))
    return refuse(ApiFault::not_understood, "before must be what `next` was");
  const auto entries = call.services.audit->find(search);
  if (!entries) return refuse(ApiFault::not_stored, public_reason(entries.error()));
  documents::AuditLines page;
  for (const AuditEntry& entry : *entries)
    page.lines.push_back({to_seconds(entry.time), entry.who, entry.what, entry.about, entry.address, entry.count});
  if (entries->size() == static_cast<std::size_t>(search.most)) page.next = entries->back().place;
  return page;
}

}  // namespace

std::vector<Endpoint> audit_endpoints() {
  return {endpoint<Nothing, documents::AuditLines>(
      at("GET", "/audit", Rank::operator_, "audit",
         "A page of the audit log, the newest first: of an account, of an address or its beginning, from a time until"
         " another; before: where the page before ended",
         {"account", "address", "from", "until", "before"}),
      audit)};
}

}  // namespace docent::telepresence
