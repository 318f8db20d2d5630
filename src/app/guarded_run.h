#pragma once

#include "app/command.h"
#include "app/instrument_log.h"

namespace telestrain {

// Runs the verb. A signal that ends it is said on stderr, with what is kept and how to go on, and
// logged as `run` with 128 + its number. Too little memory fails with kOutputFailed.
Result<int> RunGuarded(Command& command, const InstrumentLog& log, const LoggedRun& run,
                       Console& console);

// To be called once, first of all in main: where no exception can be caught (in a thread of a
// library), too little memory ends the process with the same message and exit code.
void HandleLackOfMemory();

}  // namespace telestrain
