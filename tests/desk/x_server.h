#pragma once

#include <sys/types.h>

#include <string>

namespace telestrain::desk_test {

// An X server without a screen (Xvfb) for as long as this object lives, on a display number of its
// own; DISPLAY names it meanwhile.
class XServer {
 public:
  XServer();
  ~XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

  // Why there is none; empty when it runs.
  const std::string& problem() const { return problem_; }

 private:
  pid_t process_ = -1;
  std::string problem_;
};

}  // namespace telestrain::desk_test
