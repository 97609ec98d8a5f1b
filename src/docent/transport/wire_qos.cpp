#include "docent/transport/wire_qos.h"

#include <dds/dds.h>

#include "docent/transport/type_hash.h"

namespace docent::transport {
namespace {

constexpr int kSensorDepth = 5;
constexpr int kCommandDepth = 32;
constexpr Duration kLiveliness = std::chrono::seconds{1};
constexpr dds_duration_t kMaxBlocking = DDS_MSECS(10);

int depth_of(const TopicInfo& info) {
  if (info.depth > 0) return info.depth;
  switch (info.qos) {
    case Qos::sensor:
      return kSensorDepth;
    case Qos::state:
      return 1;
    case Qos::command:
      return kCommandDepth;
  }
  return 1;
}

DdsQos to_dds(const WireQos& wire, const std::string& type) {
  DdsQos qos{dds_create_qos()};
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &representation);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, wire.depth);
  dds_qset_durability(qos.get(), wire.is_latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_reliability(qos.get(), wire.is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       kMaxBlocking);
  if (wire.lease.count() > 0) dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, wire.lease.count());
  const std::string data = endpoint_user_data(type);
  dds_qset_userdata(qos.get(), data.data(), data.size());
  return qos;
}

}  // namespace

void DeleteQos::operator()(dds_qos* qos) const { dds_delete_qos(qos); }

WireQos offered_qos(const TopicInfo& topic) {
  // Also sensors are offered reliably: our own readers ask for best effort and get just that, but many a ROS 2 tool
  // asks for reliable odometry and frames and would find no match.
  return {true, topic.qos == Qos::state, depth_of(topic), kLiveliness};
}

WireQos requested_qos(const TopicInfo& topic) {
  return {topic.qos != Qos::sensor, topic.qos == Qos::state, depth_of(topic), Duration{0}};
}

DdsQos dds_writer_qos(const TopicInfo& topic, const std::string& type) {
  const WireQos wire = offered_qos(topic);
  DdsQos qos = to_dds(wire, type);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  if (wire.is_latched) {
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, wire.depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  return qos;
}

DdsQos dds_reader_qos(const TopicInfo& topic, const std::string& type) { return to_dds(requested_qos(topic), type); }

DdsQos dds_probe_qos(const TopicInfo& topic, const std::string& type) {
  WireQos wire = requested_qos(topic);
  wire.depth = 1;
  wire.is_reliable = false;
  return to_dds(wire, type);
}

const char* policy_name(std::uint32_t policy) {
  switch (policy) {
    case DDS_RELIABILITY_QOS_POLICY_ID:
      return "reliability";
    case DDS_DURABILITY_QOS_POLICY_ID:
      return "durability";
    case DDS_DEADLINE_QOS_POLICY_ID:
      return "deadline";
    case DDS_LIVELINESS_QOS_POLICY_ID:
      return "liveliness";
    case DDS_DATA_REPRESENTATION_QOS_POLICY_ID:
      return "data representation";
    default:
      return "quality of service";
  }
}

}  // namespace docent::transport
