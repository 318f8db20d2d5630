#include "report/signature/utc_time.h"

#include <cstdio>
#include <ctime>
#include <regex>

namespace telestrain {
namespace {

// The years that four digits can say.
constexpr long long kFirst_s = -62167219200, kLast_s = 253402300799;

// `format` takes year to second. Not strftime: it writes the year 987 with three digits.
std::string Formatted(long long time_s, const char* format) {
  const auto time = static_cast<std::time_t>(time_s);
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  char text[128];
  std::snprintf(text, sizeof text, format, parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday,
                parts.tm_hour, parts.tm_min, parts.tm_sec);
  return text;
}

int Number(const std::string& text) { return text.empty() ? 0 : std::stoi(text); }

// Groups 1 to 6 are year to second. A day that the calendar lacks is none.
std::optional<long long> TimeOf(const std::smatch& match) {
  std::tm parts{};
  parts.tm_year = Number(match[1]) - 1900;
  parts.tm_mon = Number(match[2]) - 1;
  parts.tm_mday = Number(match[3]);
  parts.tm_hour = Number(match[4]);
  parts.tm_min = Number(match[5]);
  parts.tm_sec = Number(match[6]);
  std::tm normal = parts;
  const std::time_t time = ::timegm(&normal);
  const bool same = normal.tm_mday == parts.tm_mday && normal.tm_mon == parts.tm_mon &&
                    normal.tm_hour == parts.tm_hour && normal.tm_min == parts.tm_min &&
                    normal.tm_sec == parts.tm_sec;
  return same ? std::optional<long long>(time) : std::nullopt;
}

}  // namespace

std::string IsoTime(long long time_s) {
  return Formatted(time_s, "%04d-%02d-%02dT%02d:%02d:%02dZ");
}
std::string PdfTime(long long time_s) { return Formatted(time_s, "D:%04d%02d%02d%02d%02d%02dZ"); }

std::optional<long long> ParseIsoTime(const std::string& text) {
  static const std::regex kForm(
      R"((\d{4})-(\d\d)-(\d\d)(?:T(\d\d):(\d\d)(?::(\d\d))?(?:Z|([+-])(\d\d):(\d\d))?)?)");
  std::smatch match;
  if (!std::regex_match(text, match, kForm)) return std::nullopt;
  const auto time = TimeOf(match);
  if (!time) return std::nullopt;
  const long long offset_s = Number(match[8]) * 3600LL + Number(match[9]) * 60LL;
  const long long time_s = match[7] == "-" ? *time + offset_s : *time - offset_s;
  return time_s < kFirst_s || time_s > kLast_s ? std::nullopt : std::optional(time_s);
}

std::optional<long long> ParsePdfTime(const std::string& text) {
  static const std::regex kForm(R"(D:(\d{4})(\d\d)(\d\d)(\d\d)(\d\d)(\d\d)Z)");
  std::smatch match;
  return std::regex_match(text, match, kForm) ? TimeOf(match) : std::nullopt;
}

long long CurrentTime_s() { return static_cast<long long>(std::time(nullptr)); }

}  // namespace telestrain
