#include "report/signature/sign_rules.h"

#include <algorithm>
#include <cstdlib>

#include "report/signature/roles.h"
#include "report/signature/utc_time.h"

namespace telestrain {
namespace {

constexpr long long kMostDifference_s = 86400;

auto RankOf(const std::string& role) {
  return std::find(kSigningRoles.begin(), kSigningRoles.end(), role);
}

std::string PairFailure(const PdfSignature& earlier, const PdfSignature& later) {
  if (RankOf(later.role) <= RankOf(earlier.role))
    return later.role + ": signs after the " + earlier.role +
           "; the order is instrument, operator, reviewer, approver";
  // ISO 8601 in UTC sorts as text.
  if (later.claimed_time < earlier.claimed_time)
    return later.role + ": its time, " + later.claimed_time + ", is before that of the " +
           earlier.role + ", who signed before it at " + earlier.claimed_time;
  if (earlier.role != kSealingRole && later.fingerprint == earlier.fingerprint)
    return later.role + ": has the certificate that signed as " + earlier.role + " (" +
           earlier.signer + "); each person signs with a certificate of their own";
  return "";
}

}  // namespace

std::string OrderFailure(const std::vector<PdfSignature>& signatures) {
  for (std::size_t later = 1; later < signatures.size(); ++later)
    for (std::size_t earlier = 0; earlier < later; ++earlier)
      if (const auto failure = PairFailure(signatures[earlier], signatures[later]);
          !failure.empty())
        return failure;
  return "";
}

std::string ClockFailure(long long claimed_s, long long stamped_s) {
  if (std::abs(claimed_s - stamped_s) <= kMostDifference_s) return "";
  return "its own clock's time, " + IsoTime(claimed_s) + ", is more than a day from " +
         IsoTime(stamped_s) + " of its time stamp";
}

}  // namespace telestrain
