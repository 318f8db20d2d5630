#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/file_limits.h"
#include "base/result.h"

namespace telestrain {

// The whole file as bytes, at most `most_bytes` (file_limits.h has the limit of each kind). Never
// waits and never fills the memory: a folder, pipe, device or socket is refused, and a file that is
// larger or grows beyond the limit while it is read. Links are followed. Fails (kBadInput) with the
// path, the system's reason or the limit, and the remedy.
Result<std::string> ReadFile(const std::filesystem::path& path, std::size_t most_bytes);

// Writes `bytes` under a temporary name beside `path`, syncs and renames, so that `path` is
// either the old file or the whole new one, with the permissions of the old one. A symbolic link is
// replaced, not followed. Fails (kOutputFailed) with the path, the system's reason and what to do,
// and removes the temporary.
Status WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes);

// Adds `bytes` to the end of a file, which is made when it is missing, and syncs. Other readers see
// the old end or the new one; a program that is killed, or the machine, may leave a part, a write
// that fails does not. Fails (kOutputFailed).
Status AppendToFile(const std::filesystem::path& path, std::string_view bytes);

// The error of a file that could not be written, with the remedy that fits the errno.
Error CannotWrite(const std::filesystem::path& path, int error_number);
// The same of a file that cannot be taken away; `what` it is stands before the words.
Error CannotRemove(const std::filesystem::path& path, const std::string& what, int error_number);

// The name of this process's file that becomes `path` when it is whole; `ending`, such as ".mp4",
// is for those who ask for one. A file that has the name, which a killed program left, is removed.
std::filesystem::path TemporaryFor(const std::filesystem::path& path,
                                   const std::string& ending = "");
bool IsTemporary(const std::string& name);
// Removes what programs that do not run any more left of that in the folder.
Status RemoveTemporaries(const std::filesystem::path& folder);

// Creates the folder and its parents; fails (kOutputFailed) when `path` exists and is no folder.
Status EnsureFolder(const std::filesystem::path& path);

// SHA-256 as 64 lower-case hexadecimal digits. A file is read in pieces, so that its size does not
// matter; what is no file is refused as by ReadFile.
std::string Sha256Hex(std::string_view bytes);
Result<std::string> Sha256HexOfFile(const std::filesystem::path& path);

}  // namespace telestrain
