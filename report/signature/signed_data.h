#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace telestrain {

// CMS SignedData (RFC 5652) with one signer: a signature of a PDF, or an RFC 3161 time-stamp token.
// It is kept in parts, and there is one way to encode them: what is not signed (versions,
// algorithm names, their parameters, the signer's name) follows from what is. A file that differs
// from `Encode(Read(file))` is refused, so no bit of it is free.
struct SignedData {
  enum class Kind { kSignature, kTimeStamp };
  Kind kind = Kind::kSignature;
  std::string content;                    // of a token: the TSTInfo
  std::vector<std::string> certificates;  // DER
  std::size_t signer = 0;                 // index of the signer's
  std::string digest;                     // "SHA256", "SHA384" or "SHA512"
  std::vector<std::string> attributes;    // signed ones, DER each
  std::string signature;
  std::string time_stamp;  // a token in DER, or empty
};

// Nothing when `der` is not of this form.
std::optional<SignedData> ReadSignedData(std::string_view der, SignedData::Kind kind);
// Fails to encode (empty) when the signer's key is neither RSA nor EC.
std::string EncodeSignedData(const SignedData& data);

// What the signer's key signs: the attributes as DER SET.
std::string AttributesToSign(const SignedData& data);

// The attributes of a PAdES baseline signature: content type, digest of the document and the hash
// of the signer's certificate (signing-certificate-v2). The time stands in the PDF's /M instead.
std::vector<std::string> SignatureAttributes(std::string_view document_sha256,
                                             std::string_view certificate);

}  // namespace telestrain
