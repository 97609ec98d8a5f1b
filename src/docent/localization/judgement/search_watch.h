#pragma once

namespace docent::localization {

struct SearchWatchParams {
  double way = 1.5;         ///< [m] after which the whole map is searched anew, while the robot is unsure;
  double way_kept = 6.0;    ///< [m] while it is sure, but in doubt or not for long; each search that finds nobody
  double way_calm = 48.0;   ///< [m] better doubles it, up to this: a rare look for what nothing speaks of
  double usual_nats = 0.8;  ///< [nat] that a view says against the right place at most, in the mean: the survey's
                            ///< errors and people; seen are 0.15 (busy) to 0.45 (packed), 1.3 once in a hundred views
  double doubt_nats = 3.0;  ///< [nat] more than that since it was last calm: search at once
};

/// When the whole map is to be searched for a better place than the one that the robot keeps. A search costs as much as
/// seconds of tracking, and a robot that is right finds nothing: so it searches on doubt. Doubt is what the views say
/// against its place beyond the usual, summed as in a test for a change of a mean (Page's CUSUM): a few bad views, or
/// many that are a little worse.
class SearchWatch {
 public:
  explicit SearchWatch(const SearchWatchParams& params) : params_{params}, kept_{params.way_kept} {}

  /// The place is new: the next view is to be searched for.
  void begin();
  /// A view came after so much way [m]; it says so much against the place that is kept [nat].
  void see(double way, double nats);
  /// @param in_doubt  other signs speak against the place
  [[nodiscard]] bool is_due(bool keeps_its_place, bool in_doubt) const;
  /// The whole map was searched.
  void searched();
  [[nodiscard]] bool is_suspicious() const { return suspicion_ > params_.doubt_nats; }

 private:
  SearchWatchParams params_;
  bool is_new_ = true;
  double way_ = 0.0;        ///< [m] since the last search
  double kept_;             ///< [m] until the next one of a robot that is sure
  double suspicion_ = 0.0;  ///< [nat] beyond the usual
};

}  // namespace docent::localization
