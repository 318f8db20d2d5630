#include "report/signature/contents_check.h"

#include "base/files.h"
#include "report/signature/certificate.h"
#include "report/signature/der.h"
#include "report/signature/openssl_objects.h"
#include "report/signature/sign_rules.h"
#include "report/signature/signed_data.h"
#include "report/signature/time_stamp.h"
#include "report/signature/utc_time.h"

namespace telestrain {
namespace {

// The DER in Contents: its hex, then zeros only.
std::string DerOfContents(std::string_view bytes, const RawSignature& signature) {
  const auto hex =
      bytes.substr(signature.gap_begin + 1, signature.gap_end - signature.gap_begin - 2);
  const auto decoded = BytesOfHex(hex);
  const std::size_t size = decoded ? DerLength(*decoded) : 0;
  if (size == 0 || decoded->find_first_not_of('\0', size) != std::string::npos) return "";
  return decoded->substr(0, size);
}

std::string SignedBytes(std::string_view bytes, const RawSignature& signature) {
  std::string covered(bytes.substr(0, signature.gap_begin));
  return covered.append(bytes.substr(signature.gap_end, signature.end - signature.gap_end));
}

// Whether the signer's key signed the attributes, by OpenSSL's reading of them.
bool AttributesAreSigned(const std::string& der) {
  const CmsPtr cms = FromDer<CmsPtr>(der, d2i_CMS_ContentInfo);
  const bool found = cms && CMS_set1_signers_certs(cms.get(), nullptr, 0) == 1;
  const bool valid = found && CMS_SignerInfo_verify(
                                  sk_CMS_SignerInfo_value(CMS_get0_SignerInfos(cms.get()), 0)) == 1;
  ERR_clear_error();
  return valid;
}

// Time stamp and chain.
std::string TrustFailure(const SignedData& data, const RawSignature& signature,
                         const std::vector<std::string>& trusted, ContentsCheck* check) {
  const auto claimed = ParsePdfTime(signature.claimed_time);
  if (!claimed) return "its time is not as telestrain writes it";
  ChainQuestion question{.signer = data.certificates[data.signer],
                         .embedded = data.certificates,
                         .trusted = trusted,
                         .time_s = *claimed};
  if (!data.time_stamp.empty()) {
    const TimeStamp stamp = CheckTimeStamp(data.time_stamp, data.signature, trusted);
    if (!stamp.failure.empty()) return stamp.failure;
    check->time_stamp_time = IsoTime(stamp.time_s);
    if (auto failure = ClockFailure(*claimed, stamp.time_s); !failure.empty()) return failure;
    question.time_s = stamp.time_s;
  }
  const std::string failure = ChainFailure(question);
  const long long now_s = CurrentTime_s();
  if (!failure.empty() || !data.time_stamp.empty() || now_s <= question.time_s) return failure;
  // The signer's own clock could have been set back to when the certificate was valid.
  question.time_s = now_s;
  return ChainFailure(question).empty()
             ? ""
             : "its certificate has expired and no time stamp proves that it was signed before";
}

}  // namespace

ContentsCheck CheckContents(std::string_view bytes, const RawSignature& signature,
                            const std::vector<std::string>* trusted) {
  ContentsCheck check;
  const auto fail = [&](const std::string& reason) {
    check.failure = signature.role + ": " + reason;
    return check;
  };
  const std::string der = DerOfContents(bytes, signature);
  const auto data = ReadSignedData(der, SignedData::Kind::kSignature);
  if (!data || data->digest != "SHA256" || EncodeSignedData(*data) != der)
    return fail("its signature is damaged or not as telestrain encodes it");
  const std::string& certificate = data->certificates[data->signer];
  check.signer = CommonName(certificate);
  check.fingerprint = Sha256Hex(certificate);
  if (!AttributesAreSigned(der)) return fail("its signature is not valid");
  const std::string digest = Sha256(SignedBytes(bytes, signature));
  if (DerSetOf(kDerSet, SignatureAttributes(digest, certificate)) != AttributesToSign(*data))
    return fail("the file or the certificate was changed after signing");
  if (!trusted) return check;
  const std::string failure = TrustFailure(*data, signature, *trusted, &check);
  return failure.empty() ? check : fail(failure);
}

}  // namespace telestrain
