#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/signature/signature_check.h"
#include "report/signature/signed_layout.h"

namespace telestrain {

// The CMS of one signature, against the bytes it covers.
struct ContentsCheck {
  std::string signer, fingerprint, time_stamp_time;  // as PdfSignature
  std::string failure;                               // empty when it holds
};
// Cheap checks first: encoding, signature, digest of the bytes, time stamp, chains. Without
// `trusted` the chains are left out.
ContentsCheck CheckContents(std::string_view bytes, const RawSignature& signature,
                            const std::vector<std::string>* trusted);

}  // namespace telestrain
