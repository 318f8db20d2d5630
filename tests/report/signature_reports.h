#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/signature/sign_report.h"
#include "report/signature/signature_check.h"
#include "signature_pki.h"

class QPDF;

namespace telestrain {

class PdfUpdate;

// A report of two pages with attachments and the four signature fields.
const std::string& UnsignedReport();
// The same without fields.
const std::string& ReportWithoutFields();

// One field, of the operator, in this box of page two (pt).
std::string ReportWithBox(double left_pt, double bottom_pt, double width_pt, double height_pt);

SignOptions OptionsOf(const std::string& role);

// Signs with the test PKI's identity of the role, or with another; fails the test if refused.
std::string Sign(const std::string& report, const std::string& role);
std::string Sign(const std::string& report, const std::string& role, const SigningKey& key);
// By all four, in order; made once.
const std::string& FourTimesSigned();
// The first `count` of them.
std::string SignedBy(int count);

// Checks with the test root trusted.
SignatureCheck Check(const std::string& report, std::vector<std::string> required_roles = {});

// What an attacker with our own tools and a key of his would append: any change of objects, then a
// signature of his in the role's field. Sets nothing right.
std::string Forge(const std::string& report, const std::string& role, const SigningKey& key,
                  const std::function<void(QPDF&, PdfUpdate&)>& change);

}  // namespace telestrain
