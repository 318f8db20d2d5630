#include "report/declared_time.h"

#include <cstdlib>
#include <optional>

#include "base/numbers.h"
#include "report/signature/utc_time.h"

namespace telestrain {

std::string DeclaredTime(const Json& document) {
  const std::string date = TextAt(document, "/date");
  if (!date.empty()) return date;
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const auto seconds = epoch ? ParseDouble(epoch) : std::nullopt;
  constexpr double kYear9999_s = 2.5e11;
  return seconds && *seconds >= 0 && *seconds < kYear9999_s
             ? IsoTime(static_cast<long long>(*seconds))
             : "";
}

}  // namespace telestrain
