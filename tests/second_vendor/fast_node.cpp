#include "fast_node.h"

#include <fastrtps/utils/IPLocator.h>

namespace second_vendor {
namespace {

using eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;

std::string text_of(const std::vector<eprosima::fastrtps::rtps::octet>& bytes) { return {bytes.begin(), bytes.end()}; }

template <class Qos>
void set_quality(Qos& qos, Quality quality) {
  qos.reliability().kind =
      quality == Quality::sensor_data ? dds::BEST_EFFORT_RELIABILITY_QOS : dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind =
      quality == Quality::latched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = quality == Quality::latched ? 1 : 10;
  qos.endpoint().history_memory_policy = PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
}

template <class Qos>
void say_hash(Qos& qos, const std::string& hash) {
  if (hash.empty()) return;
  const std::string text = "typehash=" + hash + ";";
  qos.user_data().setValue({text.begin(), text.end()});
}

}  // namespace

/// Listens to discovery.
class FastNode::Ear final : public dds::DomainParticipantListener {
 public:
  void on_participant_discovery(dds::DomainParticipant* /*self*/,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& found) override {
    const std::scoped_lock lock{mutex_};
    const auto key = found.info.m_guid.guidPrefix;
    if (found.status == found.REMOVED_PARTICIPANT || found.status == found.DROPPED_PARTICIPANT) {
      neighbours_.erase(key);
    } else {
      neighbours_[key] = {found.info.m_participantName.to_string(), text_of(found.info.m_userData)};
    }
  }
  void on_publisher_discovery(dds::DomainParticipant* /*self*/,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& found) override {
    note(found.info, true, found.status == found.REMOVED_WRITER);
  }
  void on_subscriber_discovery(dds::DomainParticipant* /*self*/,
                               eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& found) override {
    note(found.info, false, found.status == found.REMOVED_READER);
  }
  std::vector<Endpoint> endpoints() {
    const std::scoped_lock lock{mutex_};
    std::vector<Endpoint> all;
    for (const auto& [key, endpoint] : endpoints_) all.push_back(endpoint);
    return all;
  }
  std::vector<Neighbour> neighbours() {
    const std::scoped_lock lock{mutex_};
    std::vector<Neighbour> all;
    for (const auto& [key, neighbour] : neighbours_) all.push_back(neighbour);
    return all;
  }

 private:
  template <class Info>
  void note(const Info& info, bool writes, bool is_gone) {
    const std::scoped_lock lock{mutex_};
    if (is_gone) {
      endpoints_.erase(info.guid());
      return;
    }
    endpoints_[info.guid()] = {writes,
                               info.topicName().to_string(),
                               info.typeName().to_string(),
                               text_of(info.m_qos.m_userData),
                               info.m_qos.m_reliability.kind == dds::RELIABLE_RELIABILITY_QOS,
                               info.m_qos.m_durability.kind == dds::TRANSIENT_LOCAL_DURABILITY_QOS};
  }
  std::mutex mutex_;
  std::map<eprosima::fastrtps::rtps::GuidPrefix_t, Neighbour> neighbours_;
  std::map<eprosima::fastrtps::rtps::GUID_t, Endpoint> endpoints_;
};

FastNode::FastNode(int domain, Range range) : ear_{std::make_unique<Ear>()} {
  auto* factory = dds::DomainParticipantFactory::get_instance();
  factory->load_profiles();
  dds::DomainParticipantQos qos = factory->get_default_participant_qos();
  auto& builtin = qos.wire_protocol().builtin;
  if (range == Range::localhost) {
    // What rmw_fastrtps does of ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST.
    builtin.metatrafficMulticastLocatorList.clear();
    builtin.metatrafficUnicastLocatorList.push_back(eprosima::fastrtps::rtps::Locator_t{});
    eprosima::fastrtps::rtps::Locator_t peer;
    eprosima::fastrtps::rtps::IPLocator::setIPv4(peer, "127.0.0.1");
    builtin.initialPeersList.push_back(peer);
  }
  builtin.readerHistoryMemoryPolicy = PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  builtin.writerHistoryMemoryPolicy = PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  const std::string enclave = "enclave=/;";
  qos.user_data().setValue({enclave.begin(), enclave.end()});
  qos.name("/");
  participant_ =
      factory->create_participant(static_cast<std::uint32_t>(domain), qos, ear_.get(), dds::StatusMask::none());
  if (participant_ == nullptr) return;
  publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
}

FastNode::~FastNode() {
  if (participant_ == nullptr) return;
  participant_->set_listener(nullptr);
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic* FastNode::find_topic(const std::string& name, const std::string& type) {
  dds::Topic*& topic = topics_[name];
  if (topic == nullptr) topic = participant_->create_topic("rt/" + name, type, dds::TOPIC_QOS_DEFAULT);
  return topic;
}

dds::DataWriter* FastNode::make_writer(dds::Topic* topic, Quality quality, const std::string& hash) {
  dds::DataWriterQos qos = publisher_->get_default_datawriter_qos();
  set_quality(qos, quality);
  say_hash(qos, hash);
  qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
  return publisher_->create_datawriter(topic, qos);
}

dds::DataReader* FastNode::make_reader(dds::Topic* topic, Quality quality, const std::string& hash,
                                       dds::DataReaderListener* listener) {
  dds::DataReaderQos qos = subscriber_->get_default_datareader_qos();
  set_quality(qos, quality);
  say_hash(qos, hash);
  return subscriber_->create_datareader(topic, qos, listener);
}

std::vector<Endpoint> FastNode::endpoints() const { return ear_->endpoints(); }
std::vector<Neighbour> FastNode::neighbours() const { return ear_->neighbours(); }

}  // namespace second_vendor
