#pragma once

#include <string>

#include "base/result.h"
#include "report/pdf_document.h"

namespace telestrain {

// Behind a signature's picture and its box.
inline constexpr Color kSignatureGround = ColorOf(0xFAFBFC);

// What a signature shows on the page.
struct SignaturePicture {
  std::string role, name, time, reason, place, fingerprint;
  bool demonstration = false;
  double width_pt = 0, height_pt = 0;
};

// A PDF of one page with the picture at its lower left corner, fonts embedded; opaque. The reason
// is wrapped. What does not fit is set smaller, down to 5.5 pt, then cut with "…". Fails as
// PdfDocument does.
Result<std::string> DrawSignaturePicture(const SignaturePicture& picture);

}  // namespace telestrain
