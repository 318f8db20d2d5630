#pragma once

#include <string>
#include <vector>

#include "report/signature/signature_check.h"

namespace telestrain {

// CheckSignatures without its certificates: `trusted` are DERs; null leaves out who signed.
SignatureCheck CheckIntegrity(const std::string& bytes, const std::vector<std::string>* trusted);

}  // namespace telestrain
