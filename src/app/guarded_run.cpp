#include "app/guarded_run.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <new>
#include <string>

#include "base/utf8.h"

namespace telestrain {
namespace {

constexpr const char* kTooLittleMemory =
    "there is not enough memory; end other programs or allow more (ulimit -v), then give the "
    "command again: every file is the old one or the new one";

// As cv::Exception says it, and the system of threads that have no room for their stacks.
bool TellsOfMemory(const std::string& what) {
  for (const std::string& words :
       {std::string("Insufficient memory"), std::string("Failed to allocate"),
        std::string(std::strerror(EAGAIN)), std::string(std::strerror(ENOMEM))})
    if (what.find(words) != std::string::npos) return true;
  return false;
}

// Without the console, which may be waiting for a reader.
void SayOnStderr(const std::string& line) {
  const std::string text = (::isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "") + line + "\n";
  [[maybe_unused]] const ssize_t said = ::write(STDERR_FILENO, text.data(), text.size());
}

void SayEnded(const LoggedRun& run, int signal) {
  const bool goes_on = run.verb == "run" || run.verb == "measure";
  const std::string place = run.results.empty() ? "" : " in " + PrintableText(run.results.string());
  SayOnStderr(
      "telestrain " + run.verb + ": ended by " + SignalName(signal) + "; " +
      (goes_on ? "what is finished is kept" + place + ", the same command goes on from there"
               : "every file" + place + " is the old one or the new one, give the command again"));
}

std::terminate_handler otherwise = nullptr;

void EndForLackOfMemory() {
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::exception& e) {
    if (dynamic_cast<const std::bad_alloc*>(&e) != nullptr || TellsOfMemory(e.what())) {
      SayOnStderr(std::string("telestrain: ") + kTooLittleMemory);
      ::_exit(static_cast<int>(ErrorKind::kOutputFailed));
    }
  } catch (...) {
  }
  otherwise();
}

}  // namespace

AfterSignal EndLogged(const InstrumentLog& log, LoggedRun run, int signal) {
  SayEnded(run, signal);
  run.exit_code = 128 + signal;
  if (const Status logged = LogRun(log, run); !logged) SayOnStderr(logged.error().message);
  return AfterSignal::kEnd;
}

Result<int> RunGuarded(Command& command, Console& console) {
  try {
    return command.Run(console);
  } catch (const std::bad_alloc&) {
    return OutputFailed(kTooLittleMemory);
  } catch (const std::exception& e) {  // libraries have their own
    if (!TellsOfMemory(e.what())) throw;
    return OutputFailed(kTooLittleMemory);
  }
}

void HandleLackOfMemory() { otherwise = std::set_terminate(EndForLackOfMemory); }

}  // namespace telestrain
