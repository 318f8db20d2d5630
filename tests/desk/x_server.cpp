#include "desk/x_server.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace telestrain::desk_test {
namespace {

// The child: becomes the server, which writes its display number to `to_us`.
[[noreturn]] void BecomeServer(int to_us) {
  const std::string number = std::to_string(to_us);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  ::execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1280x1024x24",
           "-nolisten", "tcp", nullptr);
  ::_exit(127);
}

}  // namespace

XServer::XServer() {
  int ends[2];
  if (::pipe(ends) != 0) {
    problem_ = "no pipe to Xvfb";
    return;
  }
  process_ = ::fork();
  if (process_ == 0) {
    ::close(ends[0]);
    BecomeServer(ends[1]);
  }
  ::close(ends[1]);
  // The server says its number when it is ready; without Xvfb the pipe ends at once.
  std::string number;
  for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) number.push_back(c);
  ::close(ends[0]);
  if (number.empty())
    problem_ = "Xvfb does not run here (package xvfb)";
  else
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
}

XServer::~XServer() {
  if (process_ <= 0) return;
  ::kill(process_, SIGTERM);
  ::waitpid(process_, nullptr, 0);
}

}  // namespace telestrain::desk_test
