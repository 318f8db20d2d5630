#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "session/made_from.h"
#include "session/session.h"

namespace telestrain {

// Removes the files of this step and of those that depend on it. A signed report is renamed, which
// is said on stderr.
Status RemoveOutputsFrom(const std::filesystem::path& results, Step step);

// Removes what `measure` makes at its end and the steps after it make of that, but not the files of
// the single states.
Status RemoveEndOfMeasure(const std::filesystem::path& results);
// Removes pipe_NNN.vtp of the states from `first` on.
Status RemoveSurfacesFrom(const std::filesystem::path& results, std::size_t first);

// The names of all pipe_NNN.vtp, sorted.
std::vector<std::string> SurfacesIn(const std::filesystem::path& results);

// The text of inputs.json: the session's facts, the program and the SHA-256 of every input file,
// among them `corners` when the target's corners come from there. Fails (kBadInput) when an image
// is unreadable, cut short or of another size than the sensor's, and when a ruler image has the
// bytes of a calibration image.
Result<std::string> InputsText(const Session& session, const std::filesystem::path& corners);

// Whether the results were made from given corners instead of calibration images.
Result<bool> CornersWereGiven(const std::filesystem::path& results);

// What inputs.json says of the session, without the folder.
Result<Session> RecordedSession(const std::filesystem::path& results);

// Fails (kBadInput) when inputs.json is missing or was made from another session.toml,
// tables or images.
Status RequireSameInputs(const Session& session, const std::filesystem::path& results);

// SHA-256 of every input file as inputs.json has it, by its path in the session.
Result<std::map<std::string, std::string>> RecordedHashes(const std::filesystem::path& results);

// SHA-256 of files of the results folder, for `made_from`.
Result<std::map<std::string, std::string>> HashesOf(const std::filesystem::path& results,
                                                    std::initializer_list<std::string> names);

}  // namespace telestrain
