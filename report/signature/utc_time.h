#pragma once

#include <optional>
#include <string>

namespace telestrain {

// Times of signatures: seconds since 1970 in UTC, and their texts.

// "2026-01-31T12:30:00Z".
std::string IsoTime(long long time_s);
// "D:20260131123000Z", as PDF writes it.
std::string PdfTime(long long time_s);

// "2026-01-31", "2026-01-31T12:30:00", with "Z" or an offset "+01:00" behind; without one it is
// UTC. Nothing when it is no such time.
std::optional<long long> ParseIsoTime(const std::string& text);
// Only what PdfTime writes.
std::optional<long long> ParsePdfTime(const std::string& text);

long long CurrentTime_s();

}  // namespace telestrain
