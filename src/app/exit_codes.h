#pragma once

#include <array>

namespace telestrain {

struct ExitCode {
  const char* code;
  const char* meaning;
};

// How the program may end; help and manual pages say the same.
inline constexpr std::array kExitCodes = {ExitCode{"0", "accepted"},
                                          ExitCode{"1", "measured but not accepted"},
                                          ExitCode{"2", "wrong usage"},
                                          ExitCode{"3", "bad input data"},
                                          ExitCode{"4", "estimation failed"},
                                          ExitCode{"5", "rendering or report failed"},
                                          ExitCode{"70", "a defect of the program"},
                                          ExitCode{"128+N", "ended by signal N"}};
inline constexpr int kUsageExit = 2, kOutputExit = 5, kDefectExit = 70;

}  // namespace telestrain
