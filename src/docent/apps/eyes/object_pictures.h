#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/pictures/figure.h"
#include "docent/vision/objects/object_book.h"
#include "docent/vision/objects/seen_picture.h"

namespace docent::apps::objects_command {

using vision::see;
using vision::SeenPicture;

/// Error: with the file's name; no JPEG, or too small for its features.
[[nodiscard]] Result<pictures::Image> read_picture(const std::filesystem::path& path);

/// A folder of objects: a folder of JPEG pictures for each, named after what they show.
struct ObjectFolder {
  std::string object;
  std::vector<std::filesystem::path> pictures;  ///< by name
};
/// By name. Error: the folder cannot be read, or has no folders with pictures.
[[nodiscard]] Result<std::vector<ObjectFolder>> object_folders(const std::filesystem::path& path);

/// The picture beside its regions in their mean colours, with the outline of the thing.
[[nodiscard]] pictures::Figure draw_regions(const pictures::Image& picture, const SeenPicture& seen,
                                            const std::string& title);

}  // namespace docent::apps::objects_command
