#pragma once

#include "app/command.h"
#include "app/instrument_log.h"
#include "base/signals.h"

namespace telestrain {

// Runs the verb. Too little memory fails with kOutputFailed.
Result<int> RunGuarded(Command& command, Console& console);

// At a signal that ends the program: says so on stderr, with what is kept and how to go on, and
// logs `run` with 128 + its number.
AfterSignal EndLogged(const InstrumentLog& log, LoggedRun run, int signal);

// To be called once, first of all in main: where no exception can be caught (in a thread of a
// library), too little memory ends the process with the same message and exit code.
void HandleLackOfMemory();

}  // namespace telestrain
