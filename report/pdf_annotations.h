#pragma once

// Included by the pdf_*.cpp files only: libharu stays inside them.

#include <map>
#include <string>
#include <vector>

#include "report/pdf_document.h"
#include "report/pdf_objects.h"
#include "report/pdf_structure.h"

namespace telestrain {

// Links and signature fields, collected while the pages are drawn and written at the end, when the
// places that links lead to are known.
class PdfAnnotations {
 public:
  PdfAnnotations(PdfObjects& objects, PdfStructure& structure)
      : objects_(objects), structure_(structure) {}

  void AddDestination(const std::string& name, HPDF_Page page, double top_pt);
  void AddLink(const PageBox& box, const std::string& destination, HPDF_Page page);
  void AddSignatureField(const std::string& name, const std::string& tip, const PageBox& box,
                         HPDF_Page page);

  // Into the pages and, for the fields, the catalog's AcroForm; once.
  void Write(HPDF_Dict catalog);

 private:
  struct Destination {
    HPDF_Page page;
    double top_pt;
  };
  struct Link {
    PageBox box;
    std::string destination, description;
    HPDF_Page page;
    int reservation;
  };
  struct Field {
    std::string name, tip;
    PageBox box;
    HPDF_Page page;
    int reservation;
  };
  HPDF_Dict MakeAnnotation(const char* kind, const PageBox& box, HPDF_Page page);
  void WriteLink(const Link& link, const Destination& target);
  HPDF_Dict MakeField(const Field& field);

  PdfObjects& objects_;
  PdfStructure& structure_;
  std::map<std::string, Destination> destinations_;
  std::vector<Link> links_;
  std::vector<Field> fields_;
};

}  // namespace telestrain
