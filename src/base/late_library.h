#pragma once

#include <mutex>
#include <string>

namespace telestrain {

// A shared library that is loaded when it is first asked for and then stays: OpenCV's codecs bring
// two hundred others along, which takes longer than most verbs work.
class LateLibrary {
 public:
  // `file` as the loader knows it, such as libopencv_imgcodecs.so.406. Never fails; Find does.
  explicit LateLibrary(const std::string& file);

  // The function of this linker's name as a pointer of this type; null when the library or the
  // function is not there, of which Failure() tells. Thread-safe.
  template <class Function>
  Function* Find(const char* symbol) const {
    return reinterpret_cast<Function*>(Address(symbol));
  }
  // What is not there of the library and all that was asked for, and the remedy; else empty.
  std::string Failure() const;

 private:
  void* Address(const char* symbol) const;

  std::string file_;
  void* library_;
  mutable std::mutex mutex_;
  mutable std::string failure_;  // under the mutex
};

}  // namespace telestrain
