#include "docent/telepresence/setup_office/setup_office.h"

namespace docent::telepresence {

Result<documents::SetupState> state_of(const SetupOffice& office) {
  const auto progress = office.setup.read();
  if (!progress) return tl::unexpected<Error>(progress.error());
  const auto museum = museum::load_museum(office.folder, museum::Stage::being_set_up);
  if (!museum) return tl::unexpected<Error>(museum.error());
  const bool is_mapping = progress->step == SetupStep::map;
  return documents::SetupState{progress->step, museum::translated(museum->name, museum->languages.front()),
                               museum->languages, is_mapping && office.setup.has_explored()};
}

}  // namespace docent::telepresence
