#pragma once

#include <map>
#include <string>

#include "base/result.h"
#include "measurement/pipe_measurement.h"

namespace telestrain {

inline constexpr const char* kStateSchema = "telestrain.strain_state/1";

// A measured state as one line of strain_states.jsonl: all that a later run needs instead of
// measuring it again, to the bit. Points, the table's row and the gauges are not in it.
struct StateRecord {
  std::string image;                             // as the table names it
  std::map<std::string, std::string> made_from;  // what -> SHA-256 or text, the image's among them
  std::string surface_sha256;                    // of pipe_NNN.vtp
  MeasuredState state;
};

// With the line end; holds no other.
std::string StateRecordLine(const StateRecord& record);
// Fails (kBadInput) when the line is no whole record of this version.
Result<StateRecord> ReadStateRecord(const std::string& line);

// All that decides about a result, as words; the number of threads does not.
std::string PipeOptionsText(const PipeOptions& options);

}  // namespace telestrain
