#pragma once

#include <cstddef>

namespace telestrain {

// The most bytes that are read of each kind of file. A file of ours stays far below its limit; what
// is larger is another file or was made to fill the memory, and is refused by its size.
constexpr std::size_t kMebibyte = std::size_t{1} << 20;

// session.toml, layouts, texts, keys and certificates: a person wrote them, or as much as one
// could.
constexpr std::size_t kMostTextBytes = kMebibyte;
// Tables of a session: as many rows of 800 bytes as results can tell of.
constexpr std::size_t kMostTableBytes = 4 * kMebibyte;
constexpr std::size_t kMostTableRows = 5000;
// Tables and lists of results, as residuals.csv: kMostTableRows images of 4 views with 117 corners
// of 160 bytes.
constexpr std::size_t kMostResultBytes = 512 * kMebibyte;
// JSON of results: kMostTableRows states of 20 kB. Parsed, it takes some ten times as much memory.
constexpr std::size_t kMostJsonBytes = 128 * kMebibyte;
// Images: 100 million pixels (kMostPixels of image_file.cpp) of four bytes.
constexpr std::size_t kMostImageBytes = 400'000'000;
// Reports, and films and pages that are read back.
constexpr std::size_t kMostReportBytes = 256 * kMebibyte;
// audit.jsonl, the instrument's log and strain_states.jsonl: they grow with every step or state.
constexpr std::size_t kMostLogBytes = 256 * kMebibyte;

}  // namespace telestrain
