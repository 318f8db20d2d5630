#pragma once

#include <mutex>
#include <string>

namespace telestrain::viz {

// The right to use VTK, and what VTK would print meanwhile. VTK reports failures only as texts to
// one process-wide window, and its text rendering is not thread-safe: construction waits until no
// other thread holds one. One thread must not hold two. Warnings are dropped.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  // First error since construction on one line, without addresses; empty when there was none.
  std::string FirstError() const;

 private:
  std::unique_lock<std::mutex> lock_;
};

}  // namespace telestrain::viz
