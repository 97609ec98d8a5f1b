#include "docent/people/breadth.h"

namespace docent::people {

Result<void> BreadthParams::validate() const {
  if (!(broad > 0.0)) return fail("breadth.broad must be > 0");
  if (!(at_first >= 0.0 && at_first <= 1.0)) return fail("breadth.at_first must be in 0..1");
  if (!(trust > 0.0)) return fail("breadth.trust must be > 0");
  if (!(from >= 0)) return fail("breadth.from must be >= 0");
  if (!(of_one > 0)) return fail("breadth.of_one must be > 0");
  if (!(kept >= trust)) return fail("breadth.kept must be >= trust");
  return {};
}

Breadth::Breadth(const BreadthParams& params)
    : params_{params}, broad_{params.at_first * params.trust}, all_{params.trust} {}

void Breadth::learn(int sightings, double breadth) {
  if (sightings <= params_.from || sightings > params_.from + params_.of_one) return;
  broad_ += is_broad(breadth) ? 1.0 : 0.0;
  all_ += 1.0;
  if (all_ <= params_.kept) return;
  broad_ *= params_.kept / all_;
  all_ = params_.kept;
}

}  // namespace docent::people
