#include "docent/transport/cdr_sertype.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>

namespace docent::transport {
namespace {

struct CdrSertype : ddsi_sertype {};

struct CdrSample : ddsi_serdata {
  CdrSample(const ddsi_sertype* sample_type, ddsi_serdata_kind sample_kind) : ddsi_serdata{} {
    ddsi_serdata_init(this, sample_type, sample_kind);
    hash = sample_type->serdata_basehash;  // without a key all samples are of one instance
  }
  /// Cyclone may read up to the next multiple of four.
  void resize(std::size_t wanted) {
    size = wanted;
    padded.assign((wanted + 3) / 4 * 4, 0);
  }
  std::size_t size = 0;
  std::vector<std::uint8_t> padded;
};

const CdrSample& sample_of(const ddsi_serdata* data) { return *static_cast<const CdrSample*>(data); }

bool equal_keys(const ddsi_serdata* /*a*/, const ddsi_serdata* /*b*/) { return true; }

std::uint32_t size_of(const ddsi_serdata* data) { return static_cast<std::uint32_t>(sample_of(data).size); }

ddsi_serdata* from_network(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragment,
                           std::size_t size) {
  auto sample = std::make_unique<CdrSample>(type, kind);
  sample->resize(size);
  std::size_t filled = 0;
  for (; fragment != nullptr; fragment = fragment->nextfrag) {  // in order; they may overlap
    const std::size_t end = std::min<std::size_t>(fragment->maxp1, size);
    if (end <= filled) continue;
    if (fragment->min > filled) return nullptr;
    const std::uint8_t* payload = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    std::memcpy(sample->padded.data() + filled, payload + (filled - fragment->min), end - filled);
    filled = end;
  }
  return filled == size ? sample.release() : nullptr;
}

ddsi_serdata* from_pieces(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                          const ddsrt_iovec_t* pieces, std::size_t size) {
  auto sample = std::make_unique<CdrSample>(type, kind);
  sample->resize(size);
  std::size_t filled = 0;
  for (ddsrt_msg_iovlen_t i = 0; i < count && filled < size; ++i) {
    const std::size_t length = std::min<std::size_t>(pieces[i].iov_len, size - filled);
    std::memcpy(sample->padded.data() + filled, pieces[i].iov_base, length);
    filled += length;
  }
  return filled == size ? sample.release() : nullptr;
}

ddsi_serdata* from_keyhash(const ddsi_sertype* type, const ddsi_keyhash* /*hash*/) {
  return new CdrSample{type, SDK_KEY};
}

// The typed calls of Cyclone (dds_write, dds_take) are not for these topics.
ddsi_serdata* from_sample(const ddsi_sertype* /*type*/, ddsi_serdata_kind /*kind*/, const void* /*sample*/) {
  return nullptr;
}
bool to_sample(const ddsi_serdata* /*data*/, void* /*sample*/, void** /*buffer*/, void* /*limit*/) { return false; }
bool untyped_to_sample(const ddsi_sertype* /*type*/, const ddsi_serdata* /*data*/, void* /*sample*/, void** /*buffer*/,
                       void* /*limit*/) {
  return true;
}

void to_network(const ddsi_serdata* data, std::size_t offset, std::size_t size, void* buffer) {
  std::memcpy(buffer, sample_of(data).padded.data() + offset, size);
}
ddsi_serdata* to_network_by_reference(const ddsi_serdata* data, std::size_t offset, std::size_t size,
                                      ddsrt_iovec_t* piece) {
  piece->iov_base = const_cast<std::uint8_t*>(sample_of(data).padded.data() + offset);
  piece->iov_len = static_cast<ddsrt_iov_len_t>(size);
  return ddsi_serdata_ref(data);
}
void end_reference(ddsi_serdata* data, const ddsrt_iovec_t* /*piece*/) { ddsi_serdata_unref(data); }

ddsi_serdata* to_untyped(const ddsi_serdata* data) {
  auto* untyped = new CdrSample{data->type, SDK_KEY};
  untyped->type = nullptr;
  return untyped;
}

void free_sample(ddsi_serdata* data) { delete static_cast<CdrSample*>(data); }

std::size_t print(const ddsi_sertype* type, const ddsi_serdata* /*data*/, char* buffer, std::size_t size) {
  return static_cast<std::size_t>(std::snprintf(buffer, size, "%s", type->type_name));
}
void keyhash(const ddsi_serdata* /*data*/, ddsi_keyhash* hash, bool /*force_md5*/) {
  std::memset(hash, 0, sizeof(*hash));
}

ddsi_serdata_ops sample_operations() {
  ddsi_serdata_ops ops{};
  ops.eqkey = equal_keys;
  ops.get_size = size_of;
  ops.from_ser = from_network;
  ops.from_ser_iov = from_pieces;
  ops.from_keyhash = from_keyhash;
  ops.from_sample = from_sample;
  ops.to_ser = to_network;
  ops.to_ser_ref = to_network_by_reference;
  ops.to_ser_unref = end_reference;
  ops.to_sample = to_sample;
  ops.to_untyped = to_untyped;
  ops.untyped_to_sample = untyped_to_sample;
  ops.free = free_sample;
  ops.print = print;
  ops.get_keyhash = keyhash;
  return ops;
}

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete static_cast<CdrSertype*>(type);
}
// Called before a sample is given out by the typed calls; ours are never, so there is nothing to prepare or to free.
void zero_samples(const ddsi_sertype* /*type*/, void* /*samples*/, std::size_t /*count*/) {}
void realloc_samples(void** pointers, const ddsi_sertype* /*type*/, void* /*old*/, std::size_t /*old_count*/,
                     std::size_t count) {
  std::fill_n(pointers, count, nullptr);
}
void free_samples(const ddsi_sertype* /*type*/, void** /*pointers*/, std::size_t /*count*/, dds_free_op_t /*what*/) {}
bool equal_types(const ddsi_sertype* /*a*/, const ddsi_sertype* /*b*/) { return true; }  // the names are equal already
std::uint32_t hash_type(const ddsi_sertype* /*type*/) { return 0; }

ddsi_sertype_ops type_operations() {
  ddsi_sertype_ops ops{};
  ops.version = ddsi_sertype_v0;
  ops.free = free_type;
  ops.zero_samples = zero_samples;
  ops.realloc_samples = realloc_samples;
  ops.free_samples = free_samples;
  ops.equal = equal_types;
  ops.hash = hash_type;
  return ops;
}

}  // namespace

ddsi_sertype* make_cdr_sertype(const std::string& name) {
  static const ddsi_sertype_ops kTypeOperations = type_operations();
  static const ddsi_serdata_ops kSampleOperations = sample_operations();
  auto* type = new CdrSertype{};
  ddsi_sertype_init(type, name.c_str(), &kTypeOperations, &kSampleOperations, true);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return type;
}

ddsi_serdata* make_cdr_sample(const ddsi_sertype* type, std::vector<std::uint8_t> bytes) {
  auto* sample = new CdrSample{type, SDK_DATA};
  sample->size = bytes.size();
  sample->padded = std::move(bytes);
  sample->padded.resize((sample->size + 3) / 4 * 4, 0);
  return sample;
}

std::span<const std::uint8_t> cdr_bytes(const ddsi_serdata* sample) {
  const auto& cdr = sample_of(sample);
  return std::span{cdr.padded}.first(cdr.size);
}

}  // namespace docent::transport
