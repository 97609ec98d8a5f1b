#pragma once

#include "docent/base/time.h"

namespace docent::recording {

/// The stamps of one topic of a recording, whose clock may have been set back on the way: from the third message in
/// succession on whose stamps rise but are older than those before, all are moved by as much as the clock was set. Lone
/// ones that were overtaken keep theirs.
class RisingStamps {
 public:
  /// Of the next message in the order of the file.
  Time follow(Time stamp);
  [[nodiscard]] int set_back() const { return set_back_; }  ///< how often

 private:
  static constexpr int kEnough = 3;  ///< messages that bear each other out
  bool is_first_ = true;
  Time newest_{};  ///< as it was given out
  Duration shift_{};
  Time late_{};     ///< stamp of the last one that was older
  int rising_ = 0;  ///< so many in succession
  int set_back_ = 0;
};

}  // namespace docent::recording
