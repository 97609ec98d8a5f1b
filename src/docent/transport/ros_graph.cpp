#include "docent/transport/ros_graph.h"

#include <dds/dds.h>

#include <algorithm>
#include <memory>

#include "docent/base/check.h"
#include "docent/messages/cdr.h"
#include "docent/transport/cdr_sertype.h"
#include "docent/transport/type_hash.h"

namespace docent::transport {
namespace {

constexpr const char* kLongestName = "256";  // [bytes] of a node's name, and of its name space

Gid gid_of(dds_entity_t entity) {
  dds_guid_t guid{};
  Gid gid;
  if (dds_get_guid(entity, &guid) == DDS_RETCODE_OK) std::copy(std::begin(guid.v), std::end(guid.v), gid.data.begin());
  return gid;
}

bool is_allowed(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

MessageSchemas schemas_of_participant_entities() {
  MessageSchemas schemas = message_schemas<ParticipantEntitiesInfo>();
  for (MessageSchema& schema : schemas)
    for (FieldSchema& field : schema.fields)
      if (field.type == "string") field.type += std::string{"<="} + kLongestName;
  return schemas;
}

std::string node_name_of(const std::string& text) {
  std::string name = text;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !is_allowed(c); }, '_');
  if (name.empty() || (name.front() >= '0' && name.front() <= '9')) name.insert(name.begin(), '_');
  return name;
}

RosGraph::RosGraph(std::int32_t participant, const std::string& prefix, const std::string& node) {
  ddsi_sertype* type = make_cdr_sertype(dds_type_name(ParticipantEntitiesInfo::kType));
  const dds_entity_t topic = dds_create_topic_sertype(participant, kRosDiscovery, &type, nullptr, nullptr, nullptr);
  DOCENT_CHECK(topic > 0);
  type_ = type;
  const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos{dds_create_qos(), dds_delete_qos};
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &representation);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_INFINITY);
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  const std::string data = endpoint_user_data(ParticipantEntitiesInfo::kType);
  dds_qset_userdata(qos.get(), data.data(), data.size());
  writer_ = dds_create_writer(participant, topic, qos.get(), nullptr);
  DOCENT_CHECK(writer_ > 0);
  info_.gid = gid_of(participant);
  info_.node_entities_info_seq.push_back({"/" + prefix, node_name_of(node), {}, {}});
}

void RosGraph::add_reader(std::int32_t reader) {
  info_.node_entities_info_seq.front().reader_gid_seq.push_back(gid_of(reader));
  is_new_ = true;
}

void RosGraph::remove_reader(std::int32_t reader) {
  std::erase(info_.node_entities_info_seq.front().reader_gid_seq, gid_of(reader));
  is_new_ = true;
}

void RosGraph::add_writer(std::int32_t writer) {
  info_.node_entities_info_seq.front().writer_gid_seq.push_back(gid_of(writer));
  is_new_ = true;
}

void RosGraph::publish() {
  is_new_ = false;
  dds_writecdr(writer_, make_cdr_sample(type_, encode_cdr(info_)));
}

}  // namespace docent::transport
