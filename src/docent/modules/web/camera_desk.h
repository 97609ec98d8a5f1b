#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "docent/messages/topics.h"
#include "docent/telepresence/site.h"
#include "docent/transport/bus.h"
#include "docent/vision/image_pairs.h"

namespace docent::modules {

/// The pictures of both cameras for the page: /camera/robot.jpg and /camera/scene.jpg. Each viewer fetches them at a
/// rate of their own, so a slow one waits for nobody and nobody for them; the files go out as the cameras made them.
class CameraDesk {
 public:
  CameraDesk(transport::Bus& bus, std::shared_ptr<telepresence::Site> site);

  /// What is wrong with what the cameras send; empty: nothing.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  void take_robot(const sensor_msgs::CompressedImage& image);
  void take_scene(const sensor_msgs::CompressedImage& image);
  /// One that is not compressed: in place of a compressed one, where none comes, and not faster than eyes need.
  void compress(const Topic<sensor_msgs::CompressedImage>& instead_of, const sensor_msgs::Image& image);
  /// nullopt: no picture that a browser shows.
  std::optional<vision::Picture> checked(const char* camera, const sensor_msgs::CompressedImage& image);
  /// Both of a new pair, or the newest of a camera that is alone.
  void show(const char* path, const vision::Picture& picture);
  void put(const char* path, const vision::Picture& picture);

  transport::Bus& bus_;
  std::shared_ptr<telepresence::Site> site_;
  vision::ImagePairs pairs_;
  std::optional<vision::PicturePair> shown_;
  std::map<std::string, Time> compressed_at_;  ///< by camera, when the last came compressed
  std::map<std::string, Time> encoded_at_;     ///< likewise, when the last was compressed here
  Time paired_at_{};
  std::string fault_;
};

}  // namespace docent::modules
