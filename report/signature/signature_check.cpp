#include "report/signature/signature_check.h"

#include <algorithm>

#include "report/signature/certificate.h"
#include "report/signature/integrity.h"

namespace telestrain {

std::string TimeText(const PdfSignature& signature) {
  return signature.timestamp_time.empty() ? "signed " + signature.claimed_time + " by its own clock"
                                          : "time-stamped " + signature.timestamp_time;
}

Result<SignatureCheck> CheckSignatures(const std::string& bytes, const TrustOptions& trust) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto trusted, ReadCertificates(trust.certificates));
  SignatureCheck check = CheckIntegrity(bytes, trusted.empty() ? nullptr : &trusted);
  if (!check.failure.empty()) return check;
  if (!check.signatures.empty() && trusted.empty())
    check.failure =
        "whose signatures these are cannot be decided: no trusted certificate was given (--trust)";
  for (const std::string& role : trust.required_roles)
    if (check.failure.empty() &&
        std::none_of(check.signatures.begin(), check.signatures.end(),
                     [&](const PdfSignature& signature) { return signature.role == role; }))
      check.failure = role + ": has not signed";
  return check;
}

}  // namespace telestrain
