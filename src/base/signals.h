#pragma once

#include <functional>
#include <list>
#include <string>

namespace telestrain {

// What the program does when the person or the system ends it: SIGINT (Ctrl-C), SIGTERM, SIGHUP.
// A thread waits for them, so that anything may be done then; no file is being written at that
// moment, unless the disk hangs for 5 s. The process ends with 128 + the signal's number: after
// those 5 s at the latest, and 5 s for what is to be done. A signal that whoever started the
// program had it ignore (nohup) stays ignored.

// To be called once, first of all in main, before there is another thread. Also: a reader of stdout
// that goes away (SIGPIPE) and a file beyond the limit (SIGXFSZ) become errors of the write, and
// stdin, stdout and stderr are open, so that no file of results takes their numbers.
void HandleSignals();

// "SIGINT", of the signals above.
std::string SignalName(int number);

enum class AfterSignal { kEnd, kGoOn };

// Something to be done at such a signal while the object lives, the latest first; kGoOn keeps the
// process alive and leaves the earlier ones undone.
class AtSignal {
 public:
  explicit AtSignal(std::function<AfterSignal(int number)> act);
  ~AtSignal();
  AtSignal(const AtSignal&) = delete;
  AtSignal& operator=(const AtSignal&) = delete;

 private:
  std::list<std::function<AfterSignal(int)>>::iterator place_;
};

// While one lives, no signal ends the process within 5 s: for what must be done whole. To be held
// for moments.
class NoSignalNow {
 public:
  NoSignalNow();
  ~NoSignalNow();
  NoSignalNow(const NoSignalNow&) = delete;
  NoSignalNow& operator=(const NoSignalNow&) = delete;
};

}  // namespace telestrain
