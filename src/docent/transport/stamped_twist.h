#pragma once

#include "docent/transport/bus.h"

namespace docent::transport {

/// A Twist in memory that is a TwistStamped on the wire: what drivers of ROS 2 Jazzy want for cmd_vel. It is stamped
/// with the wall's clock when it goes, in frame base_link; of one that comes the stamp is not read.
[[nodiscard]] const TypeSupport& stamped_twist_support();

}  // namespace docent::transport
