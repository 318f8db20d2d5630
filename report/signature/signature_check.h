#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace telestrain {

// One signature of a PDF, as found.
struct PdfSignature {
  std::string role;              // "instrument", "operator", "reviewer", "approver"
  std::string signer;            // common name of the certificate
  std::string fingerprint;       // SHA-256 of the certificate, hex
  std::string claimed_time;      // the signer's own clock, ISO 8601
  std::string timestamp_time;    // of the RFC 3161 token, ISO 8601; empty without one
  std::size_t signed_bytes = 0;  // it covers the file up to here
};

// "signed 2026-01-31T12:00:00Z by its own clock" or "time-stamped 2026-01-31T12:01:00Z".
std::string TimeText(const PdfSignature& signature);

struct SignatureCheck {
  std::vector<PdfSignature> signatures;  // in the order they were made
  // Empty when all are valid; else the first reason, naming the role and, for a forbidden change,
  // the object.
  std::string failure;
};

// Who may sign. Without certificates a signed file fails: whose signatures they are is unknown.
struct TrustOptions {
  std::vector<std::filesystem::path> certificates;  // PEM files, roots or the signers' own
  std::vector<std::string> required_roles;          // each must have signed
};

// Checks every signature: byte range, CMS and canonical encoding, certificate chain, time stamp,
// that the last covers the whole file, that after each only what a later signature needs was added,
// and that roles, times and persons follow one another as they must (OrderFailure). A signature
// without a time stamp fails once its certificate has expired. An unsigned file has no signatures
// and no failure (unless a role is required). Fails (kBadInput) only when a certificate file cannot
// be read; a damaged PDF is a failure in words.
Result<SignatureCheck> CheckSignatures(const std::string& bytes, const TrustOptions& trust);

}  // namespace telestrain
