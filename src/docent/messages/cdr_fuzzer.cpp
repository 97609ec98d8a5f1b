#include <cstdlib>

#include "docent/messages/cdr.h"
#include "docent/messages/topics.h"

// Any bytes as any message: no crash, no endless allocation; and what was read can be written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  int index = 0;
  const std::span<const std::uint8_t> bytes{data + 1, size - 1};
  const auto check = [&]<class T>(docent::Topic<T>) {
    if (index++ != data[0]) return;
    const auto message = docent::decode_cdr<T>(bytes);
    if (!message) return;
    const auto again = docent::encode_cdr(*message);
    const auto back = docent::decode_cdr<T>(again);
    if (!back || docent::encode_cdr(*back) != again) std::abort();
  };
  docent::for_each_robot_topic(check);
  docent::for_each_truth_topic(check);
  return 0;
}
