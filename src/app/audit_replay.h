#pragma once

#include <filesystem>

#include "base/console.h"
#include "base/result.h"

namespace telestrain {

// `telestrain audit replay`.
struct ReplayChoices {
  std::filesystem::path results;
  std::filesystem::path session;  // empty: where session.path says
  std::filesystem::path keep;     // where to work, made when missing; empty: a folder that goes
};

// Runs every step that the audit trail has since the session was last opened again, with the
// recorded options, in another folder, and compares every byte of what each made with what the
// trail and the results folder have. Signatures cannot be made again: a signed report must begin
// with the bytes made anew. Says what it compared, or the first difference; the value is the exit
// code, 1 for a difference. Fails with kBadInput when the trail or the session cannot be read.
Result<int> ReplayAudit(const ReplayChoices& choices, Console& console);

}  // namespace telestrain
