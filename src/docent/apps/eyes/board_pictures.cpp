#include "docent/apps/eyes/board_pictures.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>

#include "docent/base/files.h"
#include "docent/grid/map_image.h"
#include "docent/messages/cdr.h"
#include "docent/messages/standard_messages.h"
#include "docent/modules/eyes/camera_messages.h"
#include "docent/pictures/jpeg/jpeg.h"
#include "docent/recording/mcap/reader.h"

namespace docent::apps::calibrate_camera_command {
namespace {

namespace fs = std::filesystem;

constexpr int kLongest = 4096;  // [pixels]

std::string small(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

GreyImage read_file_picture(const fs::path& path) {
  GreyImage picture{path.filename().string()};
  const auto refuse = [&](const Error& error) {
    picture.fault = error.message;
    return picture;
  };
  const std::string ending = small(path.extension().string());
  if (ending == ".jpg" || ending == ".jpeg") {
    const auto bytes = read_file(path);
    if (!bytes) return refuse(bytes.error());
    const auto image =
        pictures::decode_jpeg({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()}, kLongest);
    if (!image) return refuse(image.error());
    picture.columns = image->width(), picture.rows = image->height();
    picture.grey = modules::grey_of(*image);
    return picture;
  }
  auto image = open_map_image(path);
  if (!image) return refuse(image.error());
  if ((*image)->width() > kLongest || (*image)->height() > kLongest) return refuse(Error{"is too large"});
  picture.columns = static_cast<int>((*image)->width()), picture.rows = static_cast<int>((*image)->height());
  std::vector<std::uint32_t> shades;
  for (int row = 0; row < picture.rows; ++row) {
    if (auto read = (*image)->read_row(shades); !read) return refuse(read.error());
    for (const std::uint32_t shade : shades)
      picture.grey.push_back(shade == MapImage::kClear
                                 ? std::uint8_t{0}
                                 : static_cast<std::uint8_t>(std::lround(255.0 * shade / (*image)->white())));
  }
  return picture;
}

Result<void> read_folder(const fs::path& folder, const std::function<void(GreyImage)>& take) {
  const std::set<std::string> endings{".png", ".pgm", ".jpg", ".jpeg"};
  std::vector<fs::path> files;
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator{folder, fault})
    if (endings.contains(small(entry.path().extension().string()))) files.push_back(entry.path());
  if (fault) return fail(folder.string() + ": " + fault.message());
  if (files.empty()) return fail(folder.string() + ": holds no picture (PNG, PGM, JPEG)");
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) take(read_file_picture(file));
  return {};
}

bool is_picture_topic(const recording::McapChannel& channel) {
  return channel.encoding == "cdr" &&
         (channel.type == sensor_msgs::Image::kType || channel.type == sensor_msgs::CompressedImage::kType);
}

GreyImage read_message(const recording::McapMessage& message) {
  char time[32];
  std::snprintf(time, sizeof time, " %.2f s", to_seconds(message.log_time - Time{}));
  GreyImage picture{message.channel.topic + time};
  if (message.channel.type == sensor_msgs::Image::kType) {
    const auto image = decode_cdr<sensor_msgs::Image>(message.data);
    const auto grey = image ? modules::grey_of(*image) : tl::unexpected<Error>(image.error());
    if (!grey) return {picture.name, 0, 0, {}, grey.error().message};
    return {picture.name, static_cast<int>(image->width), static_cast<int>(image->height), *grey};
  }
  const auto file = decode_cdr<sensor_msgs::CompressedImage>(message.data);
  if (!file) return {picture.name, 0, 0, {}, file.error().message};
  const auto image = pictures::decode_jpeg(file->data, kLongest);
  if (!image) return {picture.name, 0, 0, {}, image.error().message};
  return {picture.name, image->width(), image->height(), modules::grey_of(*image)};
}

Result<std::string> topic_of(recording::McapReader& reader, const std::string& wanted) {
  std::set<std::string> found;
  const auto read = reader.read([&](const recording::McapMessage& message) {
    if (is_picture_topic(message.channel)) found.insert(message.channel.topic);
    return true;
  });
  if (!read) return tl::unexpected<Error>(read.error());
  std::string all;
  for (const std::string& topic : found) all += (all.empty() ? "" : ", ") + topic;
  if (found.empty()) return fail("the recording has no topic of pictures (sensor_msgs/Image, CompressedImage)");
  if (!wanted.empty()) {
    const std::string name = wanted.starts_with('/') ? wanted : "/" + wanted;
    if (!found.contains(name)) return fail("the recording has no pictures on " + name + ", but on " + all);
    return name;
  }
  if (found.size() > 1) return fail("name one of the topics by --topic: " + all);
  return *found.begin();
}

}  // namespace

Result<void> read_pictures(const fs::path& from, const std::string& topic, double a_second,
                           const std::function<void(GreyImage)>& take) {
  if (fs::is_directory(from)) return read_folder(from, take);
  auto reader = recording::McapReader::open(from);
  if (!reader) return tl::unexpected<Error>(reader.error());
  const auto name = topic_of(*reader, topic);
  if (!name) return fail(from.string() + ": " + name.error().message);
  recording::McapReader::Selection selection;
  selection.topics = {*name};
  std::optional<Time> last;
  return reader->read(selection, [&](const recording::McapMessage& message) {
    if (last && message.log_time - *last < seconds(1.0 / a_second)) return true;
    last = message.log_time;
    take(read_message(message));
    return true;
  });
}

}  // namespace docent::apps::calibrate_camera_command
