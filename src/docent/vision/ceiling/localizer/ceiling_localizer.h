#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/vision/ceiling/ceiling_mosaic.h"
#include "docent/vision/ceiling/ceiling_samples.h"
#include "docent/vision/ceiling/localizer/ceiling_search.h"
#include "docent/vision/ceiling/pose_fit.h"

namespace docent::vision {

struct CeilingLocalizerParams {
  int samples = 240;          ///< of a picture that a pose is fitted by, > 1
  int few = 80;               ///< of these that the whole ceiling is searched by, > 1
  double steepest = 1.2;      ///< slope of the farthest looks, > 0
  double search_step = 0.25;  ///< [m] > 0: from place to place of a search; the coarsest blur is as wide
  double search_turn = 6.0;   ///< [deg] > 0: from heading to heading
  int most_found = 400;       ///< places of a search that are fitted by the few, > 0, and
  int most_fitted = 40;       ///< of these by all, > 0
  int most_ways = 24;         ///< ways that are followed, > 1
  int views = 8;              ///< pictures that ways are compared by, > 0
  double spacing = 0.35;      ///< [m] from one view to the next, > 0, or
  double turned = 20.0;       ///< [deg] likewise
  double independent = 6.0;   ///< samples of a view that count, > 0: neighbours, and errors of mosaic and mount, err
                              ///< together
  double most_nats = 6.0;     ///< [nat] that a view counts at most, > 0
  double good = 0.65;         ///< mean correlation over the views at which a place is as likely right as none is; and
  double good_width = 0.04;   ///< what its odds grow e-fold by
  int fewest = 3;             ///< views before it may be sure
  double sure = 0.01;         ///< P(wrong) below which it searches rarely, 0 .. 1
  int search_rarely = 60;     ///< pictures from search to search while it is sure; else each view is searched
  int give_up = 4;            ///< views in a row that no way explains: it begins anew
  double least_contrast = 0.015;  ///< of a picture, from which it says anything
  [[nodiscard]] Result<void> validate() const;
};

/// Where the robot is, by pictures of the ceiling and odometry alone, from anywhere ([Minerva2000] 3.2, Fig. 6). Some
/// ways that it may have come are followed, each fitted to every picture; they are compared by the pictures of the last
/// few views, all by the same ones, and a search of the whole ceiling brings further ones. Its P(wrong) knows of places
/// that look alike, and of a ceiling that looks like none: lamps that are out. Deterministic.
class CeilingLocalizer {
 public:
  /// @pre params are valid
  CeilingLocalizer(const CeilingMosaic& mosaic, const CeilingCamera& camera, const CeilingLocalizerParams& params = {});
  CeilingLocalizer(const CeilingLocalizer&) = delete;  // the search knows the levels
  CeilingLocalizer& operator=(const CeilingLocalizer&) = delete;

  struct Fix {
    Pose2 map_from_robot;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y [m], theta [rad]
    double p_wrong = 1.0;
    double correlation = 0.0;  ///< of the last picture
  };
  /// A picture, and where odometry had the robot then. Of a robot that stands most pictures are no news. Nothing where
  /// no place is known, or the picture says nothing. O(ways * samples), and where it searches O(places * few samples).
  std::optional<Fix> see(const GrayPicture& picture, const Pose2& odom_from_robot);
  void forget();
  /// Of the last picture, 0 .. 0.5.
  [[nodiscard]] double contrast() const { return sampler_.contrast(); }

 private:
  struct View {
    std::vector<CeilingSample> samples;
    Pose2 odom_from_robot;
    CeilingSearch::Likelihoods likelihoods;  ///< empty until they are asked for
  };
  struct Way {
    Pose2 pose;                ///< at the last picture
    std::deque<double> costs;  ///< [views] [nat]
    std::deque<double> correlations;
    PoseFit fit;
    bool fits = false;  ///< the last picture
    [[nodiscard]] double nats() const;
  };
  /// A picture fitted near a pose.
  struct Fitted {
    PoseFit fit;
    double correlation = 0.0;  ///< 0: it does not fit
    double nats = 0.0;
  };
  std::optional<Fix> look(const GrayPicture& picture, const Pose2& odom_from_robot, const Pose2& moved);
  [[nodiscard]] Fitted fitted(const Pose2& near, std::span<const CeilingSample> samples) const;
  [[nodiscard]] double nats(double correlation) const;
  [[nodiscard]] bool is_new_view(const Pose2& odom_from_robot) const;
  void follow(std::span<const CeilingSample> samples, const Pose2& moved, bool is_view);
  void search(std::span<const CeilingSample> samples, const Pose2& odom_from_robot);
  [[nodiscard]] std::vector<Pose2> searched(const Pose2& odom_from_robot);
  void take_in(const PoseFit& found, const Pose2& odom_from_robot);
  void prune();
  [[nodiscard]] double p_wrong() const;

  CeilingLocalizerParams params_;
  MosaicPyramid levels_;
  CeilingSampler sampler_;
  PoseFitParams fit_params_;
  CeilingSearch search_;
  std::deque<View> views_;
  std::vector<Way> ways_;  ///< by rising cost
  std::optional<Pose2> odom_;
  std::optional<Fix> last_;
  int same_ = 0;              ///< pictures of one place that were not looked at
  int since_search_ = 0;      ///< pictures
  bool is_searched_ = false;  ///< the last view
  int unexplained_ = 0;       ///< views in a row
};

}  // namespace docent::vision
