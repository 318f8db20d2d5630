#pragma once

#include <string>
#include <vector>

#include "report/signature/signature_check.h"

namespace telestrain {

// What signing and its check both ask of who signs when. Each returns what is wrong, naming the
// role, or nothing.

// Signatures in the order they were made: roles in the order of kSigningRoles (one may be left
// out), claimed times that do not go back, and another certificate for each person.
std::string OrderFailure(const std::vector<PdfSignature>& signatures);

// A claimed time (seconds since 1970) against the one of the time stamp: at most a day apart.
std::string ClockFailure(long long claimed_s, long long stamped_s);

}  // namespace telestrain
