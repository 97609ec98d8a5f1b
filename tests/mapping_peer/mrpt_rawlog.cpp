// docent_mrpt_rawlog LOG OUT.rawlog: a recording as MRPT's rbpf-slam wants it.
#include <mrpt/io/CFileGZOutputStream.h>

#include <cstdio>

#include "mrpt_scan.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: docent_mrpt_rawlog LOG OUT.rawlog\n", stderr);
    return 2;
  }
  const auto log = docent::recording::read_laser_log(argv[1]);
  if (!log) {
    std::fprintf(stderr, "%s\n", log.error().message.c_str());
    return 1;
  }
  mrpt::io::CFileGZOutputStream file;
  if (!file.open(argv[2])) {
    std::fprintf(stderr, "%s: cannot be written\n", argv[2]);
    return 1;
  }
  auto archive = mrpt::serialization::archiveFrom(file);
  docent::peers::write_rawlog(*log, archive);
  return 0;
}
