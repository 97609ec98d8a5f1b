#include "docent/modules/guide/mingling.h"

#include <numbers>
#include <system_error>

namespace docent::modules {
namespace {

/// What was learned before. A damaged file is set aside, and the robot learns anew.
interaction::TrialMemory remembered(const std::filesystem::path& file, std::string& fault) {
  auto trials = interaction::load_trials(file);
  if (trials) return std::move(*trials);
  std::error_code failed;
  std::filesystem::rename(file, file.string() + ".damaged", failed);
  fault = trials.error().message + (failed ? "" : "; it was set aside as " + file.filename().string() + ".damaged");
  return {};
}

}  // namespace

Result<void> MinglingParams::validate() const {
  if (!(around_m > 0.0)) return fail("around_m must be > 0");
  return interaction::AttractionParams::validate();
}

Mingling::Mingling(const ModuleContext& context, const MinglingParams& params)
    : bus_{context.bus},
      params_{params},
      file_{context.state / "attraction.json"},
      survives_{context.virtual_time ? Survives::process_death : Survives::power_failure},
      around_{context.bus},
      attraction_{params, remembered(file_, fault_), Rng{context.seed}.stream("attraction")} {}

std::vector<Point2> Mingling::near() const {
  std::vector<Point2> near;
  for (const interaction::SeenPerson& person : around_.people().value_or(std::vector<interaction::SeenPerson>{}))
    if (norm(person.position) <= params_.around_m) near.push_back(person.position);
  return near;
}

bool Mingling::is_there() const { return !near().empty(); }

interaction::AttractionAction Mingling::begin() {
  const double area = std::numbers::pi * params_.around_m * params_.around_m;
  return attraction_.begin(bus_.now(), static_cast<double>(near().size()) / area);
}

void Mingling::observe() {
  if (around_.people()) attraction_.observe(near(), bus_.now());
}

std::optional<interaction::AttractionTrial> Mingling::finish() {
  if (!attraction_.finish(bus_.now()) || attraction_.trials().empty()) return std::nullopt;
  if (auto saved = interaction::save_trials(file_, attraction_.trials(), survives_); !saved) {
    fault_ = saved.error().message;
  } else {
    fault_.clear();
  }
  return attraction_.trials().back();
}

}  // namespace docent::modules
