#include "docent/localization/judgement/search_watch.h"

#include <algorithm>

namespace docent::localization {

void SearchWatch::begin() { *this = SearchWatch{params_}; }

void SearchWatch::see(double way, double nats) {
  way_ += way;
  suspicion_ = std::max(0.0, suspicion_ + nats - params_.usual_nats);
}

bool SearchWatch::is_due(bool keeps_its_place, bool in_doubt) const {
  if (is_new_) return true;
  if (!keeps_its_place) return way_ >= params_.way;
  if (is_suspicious() && way_ >= params_.way) return true;
  return way_ >= (in_doubt ? std::min(params_.way_kept, kept_) : kept_);
}

void SearchWatch::searched() {
  // What was suspicious once makes the next searches come early again.
  const bool was_calm = !is_new_ && !is_suspicious() && way_ >= params_.way_kept;
  kept_ = was_calm ? std::min(2.0 * kept_, std::max(params_.way_calm, params_.way_kept)) : params_.way_kept;
  is_new_ = false;
  way_ = suspicion_ = 0.0;
}

}  // namespace docent::localization
