#pragma once

#include <string>
#include <vector>

namespace telestrain {

// What stands for the value of an option in help, man pages and completion; the completion offers
// files for kFile, folders for kFolder and both for kPath.
inline constexpr const char* kFile = "FILE";
inline constexpr const char* kFolder = "FOLDER";
inline constexpr const char* kPath = "PATH";
inline constexpr const char* kCount = "N";
inline constexpr const char* kPixels = "PX";
inline constexpr const char* kMillimetres = "MM";
inline constexpr const char* kSeconds = "SECONDS";

// The name of a type for an option whose usual values are these, while others are looked at later:
// "TEXT:{acceptance,calibration}", as CLI11 writes it for its own checks.
std::string Among(const std::vector<std::string>& values);

}  // namespace telestrain
