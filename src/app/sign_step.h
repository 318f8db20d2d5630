#pragma once

#include <string>

#include "base/console.h"
#include "base/result.h"

namespace telestrain {

// The command line of `telestrain sign`.
struct SignArguments {
  std::string report, role;
  std::string p12, key, certificate, chain, password_file;
  std::string name, reason, place, time, time_stamp_url, out;
};

// Signs, replaces the file as a whole (behind a symbolic link, the file itself) and, when it goes
// to a results folder, adds a "sign" entry to its audit trail. Others who sign there wait. Nothing
// is written when anything fails before, or the trail is damaged or cannot be continued.
Result<int> SignStep(const SignArguments& arguments, Console& console);

}  // namespace telestrain
