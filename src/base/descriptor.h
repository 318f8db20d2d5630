#pragma once

#include <unistd.h>

#include <cerrno>
#include <utility>

namespace telestrain {

// An open file descriptor that closes itself; -1: none.
struct Descriptor {
  int value = -1;
  explicit Descriptor(int opened) : value(opened) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
  // What was written may turn out here not to have reached the disk. Returns 0 or errno.
  int Close() { return ::close(std::exchange(value, -1)) == 0 ? 0 : errno; }
};

}  // namespace telestrain
