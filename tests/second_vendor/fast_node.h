#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ros_messages.h"

// A node as rmw_fastrtps makes one: a participant of Fast DDS with ROS 2's names, user data and qualities of service.

namespace second_vendor {

namespace dds = eprosima::fastdds::dds;

template <class T>
class MessageType final : public dds::TopicDataType {
 public:
  MessageType() {
    setName(T::kName);
    m_typeSize = 4096;  // to begin with; histories grow
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    eprosima::fastcdr::FastBuffer buffer{reinterpret_cast<char*>(payload->data), payload->max_size};
    eprosima::fastcdr::Cdr cdr{buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR};
    try {
      cdr.serialize_encapsulation();
      static_cast<const T*>(data)->serialize(cdr);
    } catch (const eprosima::fastcdr::exception::Exception&) {
      return false;
    }
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    eprosima::fastcdr::FastBuffer buffer{reinterpret_cast<char*>(payload->data), payload->length};
    eprosima::fastcdr::Cdr cdr{buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR};
    try {
      cdr.read_encapsulation();
      static_cast<T*>(data)->deserialize(cdr);
    } catch (const eprosima::fastcdr::exception::Exception&) {
      return false;
    }
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] {
      eprosima::fastcdr::FastBuffer buffer;
      eprosima::fastcdr::Cdr cdr{buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR};
      cdr.serialize_encapsulation();
      static_cast<const T*>(data)->serialize(cdr);
      return static_cast<std::uint32_t>(cdr.getSerializedDataLength());
    };
  }
  void* createData() override { return new T; }
  void deleteData(void* data) override { delete static_cast<T*>(data); }
  bool getKey(void* /*data*/, eprosima::fastrtps::rtps::InstanceHandle_t* /*key*/, bool /*md5*/) override {
    return false;
  }
};

/// What discovery told of somebody else's writer or reader.
struct Endpoint {
  bool writes = false;
  std::string topic;
  std::string type;
  std::string user_data;
  bool is_reliable = false;
  bool is_latched = false;
};
/// And of a participant.
struct Neighbour {
  std::string name;
  std::string user_data;
};

/// How a topic is offered or asked for; the names are rclcpp's.
enum class Quality { sensor_data, reliable, latched };

class FastNode {
 public:
  enum class Range { localhost, subnet };  ///< ROS_AUTOMATIC_DISCOVERY_RANGE
  FastNode(int domain, Range range);
  ~FastNode();
  FastNode(const FastNode&) = delete;
  FastNode& operator=(const FastNode&) = delete;
  [[nodiscard]] bool is_up() const { return participant_ != nullptr; }

  /// @param hash  whether its user data says the type's hash, as ROS 2 does from Iron on
  template <class T>
  dds::DataWriter* writer(const std::string& topic, Quality quality) {
    return make_writer(topic_of<T>(topic), quality, T::kHash);
  }
  template <class T>
  dds::DataReader* reader(const std::string& topic, Quality quality, dds::DataReaderListener* listener = nullptr) {
    return make_reader(topic_of<T>(topic), quality, T::kHash, listener);
  }

  [[nodiscard]] std::vector<Endpoint> endpoints() const;
  [[nodiscard]] std::vector<Neighbour> neighbours() const;

 private:
  class Ear;
  template <class T>
  dds::Topic* topic_of(const std::string& name) {
    dds::TypeSupport{new MessageType<T>}.register_type(participant_);
    return find_topic(name, T::kName);
  }
  dds::Topic* find_topic(const std::string& name, const std::string& type);
  dds::DataWriter* make_writer(dds::Topic* topic, Quality quality, const std::string& hash);
  dds::DataReader* make_reader(dds::Topic* topic, Quality quality, const std::string& hash,
                               dds::DataReaderListener* listener);

  std::unique_ptr<Ear> ear_;
  dds::DomainParticipant* participant_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
  dds::Subscriber* subscriber_ = nullptr;
  std::map<std::string, dds::Topic*> topics_;
};

/// Keeps what came on a topic until it is taken.
template <class T>
class Inbox final : public dds::DataReaderListener {
 public:
  void on_data_available(dds::DataReader* reader) override {
    T message;
    dds::SampleInfo info;
    while (reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      const std::scoped_lock lock{mutex_};
      messages_.push_back(message);
      ++count_;
      came_.notify_all();
    }
  }
  /// The oldest one, waited for.
  std::optional<T> take(std::chrono::milliseconds patience) {
    std::unique_lock lock{mutex_};
    if (!came_.wait_for(lock, patience, [this] { return !messages_.empty(); })) return std::nullopt;
    T first = std::move(messages_.front());
    messages_.pop_front();
    return first;
  }
  [[nodiscard]] std::size_t count() const {
    const std::scoped_lock lock{mutex_};
    return count_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable came_;
  std::deque<T> messages_;
  std::size_t count_ = 0;
};

}  // namespace second_vendor
