#pragma once

#include <stdexcept>
#include <string>

// For broken contracts (defects of ours), never for bad input: throws std::logic_error with the
// place and the condition. The program turns it into exit code 70.
#define TELESTRAIN_CHECK(condition, message)                                                 \
  do {                                                                                       \
    if (!(condition))                                                                        \
      throw std::logic_error(std::string(__FILE__) + ":" + std::to_string(__LINE__) + ": " + \
                             #condition + ": " + (message));                                 \
  } while (false)
