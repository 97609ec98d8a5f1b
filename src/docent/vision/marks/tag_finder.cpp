#include "docent/vision/marks/tag_finder.h"

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}

#include <algorithm>
#include <tuple>

#include "docent/base/check.h"

namespace docent::vision {

Result<void> TagFinderParams::validate() const {
  if (!(decimate >= 1.0)) return fail("tag finder: decimate must be >= 1");
  if (!(most_wrong_bits >= 0 && most_wrong_bits <= 2)) return fail("tag finder: most_wrong_bits must be in 0..2");
  if (!(least_margin >= 0.0)) return fail("tag finder: least_margin must be >= 0");
  return {};
}

struct TagFinder::Detector {
  explicit Detector(const TagFinderParams& params) : family{tag36h11_create()}, detector{apriltag_detector_create()} {
    apriltag_detector_add_family_bits(detector, family, params.most_wrong_bits);
    detector->nthreads = 1;
    detector->quad_decimate = static_cast<float>(params.decimate);
    detector->refine_edges = true;
  }
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;
  ~Detector() {
    apriltag_detector_destroy(detector);
    tag36h11_destroy(family);
  }
  apriltag_family_t* family;
  apriltag_detector_t* detector;
};

TagFinder::TagFinder(const TagFinderParams& params) : params_{params}, detector_{std::make_unique<Detector>(params)} {}
TagFinder::TagFinder(TagFinder&&) noexcept = default;
TagFinder& TagFinder::operator=(TagFinder&&) noexcept = default;
TagFinder::~TagFinder() = default;

std::vector<SeenTag> TagFinder::find(const GreyPicture& picture) {
  DOCENT_CHECK(picture.columns > 0 && picture.rows > 0 &&
               picture.shades.size() ==
                   static_cast<std::size_t>(picture.columns) * static_cast<std::size_t>(picture.rows));
  // The library reads the picture and never writes it.
  image_u8_t image{picture.columns, picture.rows, picture.columns, const_cast<std::uint8_t*>(picture.shades.data())};
  zarray_t* detections = apriltag_detector_detect(detector_->detector, &image);
  std::vector<SeenTag> tags;
  for (int i = 0; i < zarray_size(detections); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(detections, i, &detection);
    if (static_cast<double>(detection->decision_margin) < params_.least_margin) continue;
    SeenTag tag{detection->id, {}, static_cast<double>(detection->decision_margin)};
    for (std::size_t k = 0; k < 4; ++k) tag.corners[k] = {detection->p[k][0], detection->p[k][1]};
    tags.push_back(tag);
  }
  apriltag_detections_destroy(detections);
  std::sort(tags.begin(), tags.end(), [](const SeenTag& a, const SeenTag& b) {
    return std::tuple{a.id, a.corners[0].column, a.corners[0].row} <
           std::tuple{b.id, b.corners[0].column, b.corners[0].row};
  });
  return tags;
}

}  // namespace docent::vision
