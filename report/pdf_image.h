#pragma once

// Included by the pdf_*.cpp files only: libharu stays inside them.

#include <future>
#include <list>
#include <string>

#include "report/pdf_objects.h"
#include "report/rgb_image.h"

namespace telestrain {

// The pictures of a document, compressed (flate over predicted rows, without loss) while the pages
// are drawn: libharu would do it one after the other when it saves and keep all pixels until then.
// At most two are in work, so two more pictures' pixels are held than the caller holds.
class PdfImages {
 public:
  explicit PdfImages(PdfObjects& objects) : objects_(objects) {}
  // An image object without its bytes yet, which `Finish` supplies.
  HPDF_Dict Add(RgbImage image);
  void Finish();

 private:
  struct Work {
    HPDF_Dict image;
    std::future<std::string> bytes;
  };
  void FinishOldest();

  PdfObjects& objects_;
  std::list<Work> in_work_;
};

}  // namespace telestrain
