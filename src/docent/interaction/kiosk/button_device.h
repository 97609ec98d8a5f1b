#pragma once

#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/interaction/kiosk/button_stream.h"

namespace docent::interaction {

/// Section `buttons`: the four coloured buttons beside the screen.
struct ButtonParams {
  std::string device;  ///< evdev device, best of /dev/input/by-id, which keep their names; empty: sought by `name`
  std::string name;    ///< of the device, as evtest shows it; both empty: there are no buttons
  /// Of buttons 1 to 4, as linux/input.h names them.
  std::vector<std::string> keys{"KEY_1", "KEY_2", "KEY_3", "KEY_4"};
  std::string stop_key;    ///< of this device, stops the robot; staff release it on /operate; empty: there is none
  double debounce = 0.05;  ///< [s], 0..1: contacts bounce for 5 to 20 ms, and nobody presses twice within 50 ms
  double retry = 1.0;      ///< [s], > 0: from one attempt to open a device that is not there to the next
  bool grab = true;        ///< nobody else gets these keys: else the screen's browser would hear each press twice
  template <class V>
  void visit(V& v) {
    v("device", device);
    v("name", name);
    v("keys", keys);
    v("stop_key", stop_key);
    v("debounce", debounce);
    v("retry", retry);
    v("grab", grab);
  }
  [[nodiscard]] Result<void> validate() const;
  [[nodiscard]] bool is_configured() const { return !device.empty() || !name.empty(); }
};

/// The codes of the keys' names. Error: "buttons.keys: KEY_X is no key".
/// @param stop_key  empty: there is none
[[nodiscard]] Result<ButtonCodes> button_codes(const std::vector<std::string>& keys, const std::string& stop_key);

/// An open evdev device, or a pipe of its bytes. One thread.
class ButtonDevice {
 public:
  /// Error: "PATH: why", or that no device has the name.
  [[nodiscard]] static Result<ButtonDevice> open(const ButtonParams& params);

  /// Waits for what comes, `patience` at most; empty: nothing came. Error: the device is gone.
  [[nodiscard]] Result<std::string> read(Duration patience);
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  struct Handle;
  struct Close {
    void operator()(Handle* handle) const;
  };
  ButtonDevice(std::string path, std::unique_ptr<Handle, Close> handle)
      : path_{std::move(path)}, handle_{std::move(handle)} {}

  std::string path_;
  std::unique_ptr<Handle, Close> handle_;
};

}  // namespace docent::interaction
