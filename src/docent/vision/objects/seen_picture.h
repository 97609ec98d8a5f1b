#pragma once

#include "docent/pictures/image.h"
#include "docent/vision/objects/features.h"

namespace docent::vision {

/// A picture of one thing as the recognizer sees it.
struct SeenPicture {
  Sites sites;
  StandingThing thing;
  Features features{};
};

/// Pixels of a picture's longer side that a site spans one of: at this many sites a thing has its features.
inline constexpr int kSitesAcross = 72;

/// Sites, regions, the thing on its ground, its features. O(n log n) in sites.
[[nodiscard]] SeenPicture see(const pictures::Image& picture);

}  // namespace docent::vision
