#include "docent/telepresence/uplink/envelope/picture_pieces.h"

#include <algorithm>
#include <utility>

namespace docent::telepresence {
namespace {

constexpr std::size_t kMost = 4;  // pictures that are being put together

}  // namespace

void PictureCutter::begin(std::string path, std::string taken, std::shared_ptr<const std::string> picture) {
  path_ = std::move(path);
  taken_ = std::move(taken);
  picture_ = std::move(picture);
  at_ = 0;
}

std::optional<UplinkPiece> PictureCutter::next(std::size_t most) {
  if (!picture_ || at_ >= picture_->size()) return std::nullopt;
  const std::size_t offset = std::exchange(at_, std::min(picture_->size(), at_ + most));
  return UplinkPiece{path_, taken_, picture_->size(), offset, picture_->substr(offset, at_ - offset)};
}

std::optional<JoinedPicture> PictureJoiner::add(UplinkPiece piece) {
  if (piece.offset == 0) {
    if (begun_.size() >= kMost && !begun_.contains(piece.path)) return std::nullopt;
    begun_[piece.path] = {piece.path, piece.taken, {}};
  }
  const auto place = begun_.find(piece.path);
  if (place == begun_.end()) return std::nullopt;
  JoinedPicture& picture = place->second;
  if (picture.taken != piece.taken || picture.bytes.size() != piece.offset) {
    begun_.erase(place);
    return std::nullopt;
  }
  picture.bytes += piece.bytes;
  if (picture.bytes.size() < piece.total) return std::nullopt;
  JoinedPicture whole = std::move(picture);
  begun_.erase(place);
  return whole;
}

}  // namespace docent::telepresence
