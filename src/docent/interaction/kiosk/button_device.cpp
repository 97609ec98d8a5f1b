#include "docent/interaction/kiosk/button_device.h"

#include <fcntl.h>
#include <libevdev/libevdev.h>
#include <linux/input.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <set>
#include <system_error>

namespace docent::interaction {

struct ButtonDevice::Handle {
  int descriptor = -1;
  libevdev* evdev = nullptr;  ///< null: a pipe
};

void ButtonDevice::Close::operator()(Handle* handle) const {
  if (handle->evdev != nullptr) libevdev_free(handle->evdev);
  ::close(handle->descriptor);
  delete handle;  // NOLINT(cppcoreguidelines-owning-memory): the deleter of a unique_ptr
}

namespace {

std::string reason(int error) { return std::generic_category().message(error); }

/// The path of the device with this name; the first of them by path. Error: none has it.
Result<std::string> find_device(const std::string& name) {
  std::set<std::string> paths;
  std::error_code error;
  for (auto entry = std::filesystem::directory_iterator{"/dev/input", error};
       !error && entry != std::filesystem::directory_iterator{}; entry.increment(error)) {
    if (entry->path().filename().string().starts_with("event")) paths.insert(entry->path().string());
  }
  for (const std::string& path : paths) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    libevdev* evdev = nullptr;
    const bool is_it = libevdev_new_from_fd(descriptor, &evdev) == 0 && name == libevdev_get_name(evdev);
    if (evdev != nullptr) libevdev_free(evdev);
    ::close(descriptor);
    if (is_it) return path;
  }
  return fail("no input device is called '" + name + "'");
}

}  // namespace

Result<void> ButtonParams::validate() const {
  if (!(debounce >= 0.0 && debounce <= 1.0)) return fail("buttons.debounce must be 0..1 s");
  if (!(retry > 0.0)) return fail("buttons.retry must be > 0 s");
  auto codes = button_codes(keys, stop_key);
  if (!codes) return tl::unexpected<Error>(codes.error());
  return {};
}

Result<ButtonCodes> button_codes(const std::vector<std::string>& keys, const std::string& stop_key) {
  ButtonCodes codes;
  if (keys.size() != codes.buttons.size()) return fail("buttons.keys must name four keys");
  std::set<std::uint16_t> taken;
  const auto code_of = [&](const std::string& option, const std::string& key) -> Result<std::uint16_t> {
    const int code = libevdev_event_code_from_name(EV_KEY, key.c_str());
    if (code < 0) return fail("buttons." + option + ": " + key + " is no key");
    if (!taken.insert(static_cast<std::uint16_t>(code)).second)
      return fail("buttons." + option + ": " + key + " stands twice");
    return static_cast<std::uint16_t>(code);
  };
  for (std::size_t i = 0; i < codes.buttons.size(); ++i) {
    const auto code = code_of("keys", keys[i]);
    if (!code) return tl::unexpected<Error>(code.error());
    codes.buttons[i] = *code;
  }
  if (stop_key.empty()) return codes;
  const auto code = code_of("stop_key", stop_key);
  if (!code) return tl::unexpected<Error>(code.error());
  codes.stop = *code;
  return codes;
}

Result<ButtonDevice> ButtonDevice::open(const ButtonParams& params) {
  auto path = params.device.empty() ? find_device(params.name) : Result<std::string>{params.device};
  if (!path) return tl::unexpected<Error>(path.error());
  const int descriptor = ::open(path->c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return fail(*path + ": " + reason(errno));
  ButtonDevice device{*path, std::unique_ptr<Handle, Close>{new Handle{descriptor, nullptr}}};
  struct stat about {};
  if (::fstat(descriptor, &about) != 0) return fail(*path + ": " + reason(errno));
  if (S_ISFIFO(about.st_mode)) return device;
  // A file would end at once and be read again from its beginning.
  if (!S_ISCHR(about.st_mode)) return fail(*path + ": is no device");
  if (const int error = libevdev_new_from_fd(descriptor, &device.handle_->evdev); error < 0)
    return fail(*path + ": is no evdev device: " + reason(-error));
  if (!params.grab) return device;
  if (const int error = libevdev_grab(device.handle_->evdev, LIBEVDEV_GRAB); error < 0)
    return fail(*path + ": another program has it: " + reason(-error));
  return device;
}

Result<std::string> ButtonDevice::read(Duration patience) {
  pollfd wait{handle_->descriptor, POLLIN, 0};
  const auto wait_ms = std::chrono::duration_cast<std::chrono::milliseconds>(patience).count();
  if (::poll(&wait, 1, static_cast<int>(wait_ms)) <= 0) return std::string{};
  std::array<char, 64 * sizeof(input_event)> bytes{};
  const ssize_t count = ::read(handle_->descriptor, bytes.data(), bytes.size());
  if (count > 0) return std::string(bytes.data(), static_cast<std::size_t>(count));
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return std::string{};
  return fail(path_ + ": " + (count == 0 ? "is gone" : reason(errno)));
}

}  // namespace docent::interaction
