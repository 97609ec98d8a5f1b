#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "docent/telepresence/uplink/envelope/envelope.h"

namespace docent::telepresence {

/// Cuts a picture into pieces, one after the other.
class PictureCutter {
 public:
  /// Begins with another picture; what was left of the one before is never sent.
  void begin(std::string path, std::string taken, std::shared_ptr<const std::string> picture);
  /// The next `most` bytes; nullopt: all were given.
  [[nodiscard]] std::optional<UplinkPiece> next(std::size_t most);

 private:
  std::string path_, taken_;
  std::shared_ptr<const std::string> picture_;
  std::size_t at_ = 0;
};

struct JoinedPicture {
  std::string path, taken, bytes;
};

/// Puts pieces together again, which come in their order; a picture that lacks one is given up.
class PictureJoiner {
 public:
  /// The picture, with its last piece.
  [[nodiscard]] std::optional<JoinedPicture> add(UplinkPiece piece);

 private:
  std::map<std::string, JoinedPicture> begun_;  ///< by path; at most kMost
};

}  // namespace docent::telepresence
