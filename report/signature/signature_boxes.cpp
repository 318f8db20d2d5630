#include "report/signature/signature_boxes.h"

#include <cmath>
#include <cstdio>
#include <qpdf/QPDFPageObjectHelper.hh>
#include <vector>

#include "report/signature/opened_pdf.h"

namespace telestrain {
namespace {

using Object = QPDFObjectHandle;
using Rectangle = QPDFObjectHandle::Rectangle;

constexpr double kRounding_pt = 1e-3;  // numbers in a PDF have 5 decimals

double Width_pt(const Rectangle& box) { return box.urx - box.llx; }
double Height_pt(const Rectangle& box) { return box.ury - box.lly; }

struct Box {
  std::string role;
  Rectangle where;
  std::size_t page = 0;
};

std::string Whose(const std::string& role) { return "the box of the " + role + "'s signature "; }

// All pages that show the field.
std::vector<std::size_t> PagesOf(QPDF& pdf, Object field) {
  std::vector<std::size_t> shown;
  const auto& pages = pdf.getAllPages();
  for (std::size_t i = 0; i < pages.size(); ++i) {
    Object list = Object(pages[i]).getKey("/Annots");
    if (!list.isArray()) continue;
    for (const Object& item : list.getArrayAsVector())
      if (item.getObjGen() == field.getObjGen()) shown.push_back(i);
  }
  return shown;
}

bool IsInside(const Rectangle& box, Object page) {
  for (const char* key : {"/MediaBox", "/CropBox"}) {
    Object edge = QPDFPageObjectHelper(page).getAttribute(key, false);
    if (edge.isNull() && key == std::string("/CropBox")) continue;
    if (!edge.isRectangle()) return false;
    const Rectangle outer = edge.getArrayAsRectangle();
    if (box.llx < outer.llx || box.lly < outer.lly || box.urx > outer.urx || box.ury > outer.ury)
      return false;
  }
  return true;
}

// Fills in the box of a field; one without area keeps a width of 0.
std::string ReadBox(QPDF& pdf, Object field, Box* box) {
  Object rectangle = field.getKey("/Rect");
  if (!rectangle.isRectangle() || field.hasKey("/Kids"))
    return Whose(box->role) + "is not one rectangle";
  box->where = rectangle.getArrayAsRectangle();
  if (Width_pt(box->where) <= 0 && Height_pt(box->where) <= 0) return "";
  if (Width_pt(box->where) > kWidestBox_pt || Height_pt(box->where) > kHighestBox_pt) {
    char size[80];
    std::snprintf(size, sizeof size, "has %.0f × %.0f pt; want at most %.0f × %.0f pt",
                  Width_pt(box->where), Height_pt(box->where), kWidestBox_pt, kHighestBox_pt);
    return Whose(box->role) + size + ", so that it covers nothing";
  }
  const auto pages = PagesOf(pdf, field);
  if (pages.size() != 1)
    return Whose(box->role) + "is on " + std::to_string(pages.size()) + " pages; want one";
  box->page = pages[0];
  return IsInside(box->where, pdf.getAllPages().at(box->page))
             ? ""
             : Whose(box->role) + "is not inside its page";
}

bool Overlap(const Box& a, const Box& b) {
  return a.page == b.page && a.where.llx < b.where.urx && b.where.llx < a.where.urx &&
         a.where.lly < b.where.ury && b.where.lly < a.where.ury;
}

}  // namespace

std::string BoxesFailure(QPDF& pdf) {
  std::vector<Box> boxes;
  for (SignatureField& field : SignatureFieldsOf(pdf)) {
    Box box{field.role, {}, 0};
    if (const auto failure = ReadBox(pdf, field.field, &box); !failure.empty()) return failure;
    for (const Box& other : boxes)
      if (Overlap(box, other)) return Whose(box.role) + "overlaps that of the " + other.role;
    boxes.push_back(box);
  }
  return "";
}

bool FillsBox(Object appearance, Object rectangle) {
  if (!appearance.isDictionary() || appearance.getKeys().size() != 1 || !rectangle.isRectangle())
    return false;
  Object picture = appearance.getKey("/N");
  if (!picture.isStream()) return false;
  Object facts = picture.getDict();
  if (facts.hasKey("/Matrix") || !facts.getKey("/BBox").isRectangle()) return false;
  const Rectangle inner = facts.getKey("/BBox").getArrayAsRectangle();
  const Rectangle outer = rectangle.getArrayAsRectangle();
  return inner.llx == 0 && inner.lly == 0 && std::abs(inner.urx - Width_pt(outer)) < kRounding_pt &&
         std::abs(inner.ury - Height_pt(outer)) < kRounding_pt;
}

}  // namespace telestrain
