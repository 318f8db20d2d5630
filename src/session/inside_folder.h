#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"

namespace telestrain {

// The path `inside` a folder with symbolic links followed, relative to the folder, whose own links
// count as the folder's place. What is not there is given as it would be. Fails (kBadInput) when
// the path is absolute or climbs out, or when a link leads out; the message begins with `subject`,
// which says where the path stands, and names what it is ("the image 'a.png'").
Result<std::filesystem::path> PathInside(const std::string& subject,
                                         const std::filesystem::path& folder,
                                         const std::filesystem::path& inside);

// The same of a file of a session that has a fixed place in it, as session.toml: it may be a link
// to another file of the folder.
Status StaysInside(const std::filesystem::path& file);

}  // namespace telestrain
