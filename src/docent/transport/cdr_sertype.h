#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

struct ddsi_sertype;
struct ddsi_serdata;

// Cyclone DDS carries our bytes as they are: a type that is nothing but a name and a sample that is nothing but CDR.
// So a message has one definition, its `visit`, and damaged bytes come to our own decoder, which counts them.

namespace docent::transport {

/// A keyless type for dds_create_topic_sertype, which takes it over. `name` as DDS knows it: "pkg::msg::dds_::Name_".
[[nodiscard]] ddsi_sertype* make_cdr_sertype(const std::string& name);

/// A sample of `type` for dds_writecdr, which takes it over. `bytes` with the header of four bytes.
[[nodiscard]] ddsi_serdata* make_cdr_sample(const ddsi_sertype* type, std::vector<std::uint8_t> bytes);

/// The bytes of a sample that came from a reader of such a type; they live as long as the sample.
[[nodiscard]] std::span<const std::uint8_t> cdr_bytes(const ddsi_serdata* sample);

}  // namespace docent::transport
