#include "report/pdf_annotations.h"

namespace telestrain {
namespace {

constexpr int kPrinted = 4;  // PDF 32000-1, table 165: bit 3; PDF/A wants it of every annotation

// Table 219: there are signature fields, and a change must be an update that keeps what is signed.
constexpr int kSignaturesExist = 1, kAppendOnly = 2;

}  // namespace

void PdfAnnotations::AddDestination(const std::string& name, HPDF_Page page, double top_pt) {
  destinations_.insert({name, {page, top_pt}});
}

void PdfAnnotations::AddLink(const PageBox& box, const std::string& destination, HPDF_Page page) {
  const std::string& words = structure_.OpenAlternativeText();
  links_.push_back({box, destination, words.empty() ? destination : words, page,
                    structure_.ReserveAnnotation()});
}

void PdfAnnotations::AddSignatureField(const std::string& name, const std::string& tip,
                                       const PageBox& box, HPDF_Page page) {
  for (const Field& field : fields_)
    if (field.name == name) return;
  fields_.push_back({name, tip, box, page, structure_.ReserveAnnotation(PdfTag{"Form"})});
}

HPDF_Dict PdfAnnotations::MakeAnnotation(const char* kind, const PageBox& box, HPDF_Page page) {
  HPDF_Dict annotation = objects_.MakeDictionary();
  objects_.SetName(annotation, "Type", "Annot");
  objects_.SetName(annotation, "Subtype", kind);
  objects_.Set(annotation, "Rect",
               objects_.MakeNumbers({box.left_pt, box.bottom_pt, box.right_pt(), box.top_pt()}));
  objects_.SetNumber(annotation, "F", kPrinted);
  objects_.Set(annotation, "P", page);
  objects_.AppendTo(page, "Annots", annotation);
  return annotation;
}

void PdfAnnotations::WriteLink(const Link& link, const Destination& target) {
  HPDF_Dict annotation = MakeAnnotation("Link", link.box, link.page);
  objects_.Set(annotation, "Border", objects_.MakeNumbers({0, 0, 0}));
  objects_.SetText(annotation, "Contents", link.description);
  objects_.Set(annotation, "Dest", objects_.MakeDestination(target.page, target.top_pt));
  structure_.Connect(link.reservation, link.page, annotation);
}

// An empty appearance: PDF/A wants one, and the signature brings its own.
HPDF_Dict PdfAnnotations::MakeField(const Field& field) {
  HPDF_Dict form = objects_.MakeStream("", true);
  objects_.SetName(form, "Type", "XObject");
  objects_.SetName(form, "Subtype", "Form");
  objects_.Set(form, "BBox", objects_.MakeNumbers({0, 0, field.box.width_pt, field.box.height_pt}));
  objects_.Set(form, "Resources", objects_.MakeDirectDictionary());
  HPDF_Dict appearance = objects_.MakeDirectDictionary();
  objects_.Set(appearance, "N", form);
  HPDF_Dict widget = MakeAnnotation("Widget", field.box, field.page);
  objects_.SetName(widget, "FT", "Sig");
  objects_.SetText(widget, "T", field.name);
  objects_.SetText(widget, "TU", field.tip);
  objects_.Set(widget, "AP", appearance);
  structure_.Connect(field.reservation, field.page, widget);
  return widget;
}

void PdfAnnotations::Write(HPDF_Dict catalog) {
  for (const Link& link : links_) {
    const auto target = destinations_.find(link.destination);
    if (target != destinations_.end()) WriteLink(link, target->second);
  }
  if (fields_.empty()) return;
  HPDF_Array fields = objects_.MakeArray();
  for (const Field& field : fields_) objects_.Append(fields, MakeField(field));
  HPDF_Dict form = objects_.MakeDictionary();
  objects_.Set(form, "Fields", fields);
  objects_.SetNumber(form, "SigFlags", kSignaturesExist | kAppendOnly);
  objects_.Set(catalog, "AcroForm", form);
}

}  // namespace telestrain
