#pragma once

#include <string>

#include "base/result.h"

namespace telestrain {

// What a signature shows on the page.
struct SignaturePicture {
  std::string role, name, time, reason, place, fingerprint;
  bool demonstration = false;
  double width_pt = 0, height_pt = 0;
};

// A PDF of one page with the picture at its lower left corner, fonts embedded. Lines that are too
// wide are set smaller, down to 4 pt, then cut with "…". Fails as PdfDocument does.
Result<std::string> DrawSignaturePicture(const SignaturePicture& picture);

}  // namespace telestrain
