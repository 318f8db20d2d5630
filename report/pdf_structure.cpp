#include "report/pdf_structure.h"

#include <algorithm>
#include <set>

#include "base/check.h"

namespace telestrain {
namespace {

// Elements that group others and have nothing on the page of their own (PDF 32000-1, 14.8.4.2, and
// the inner nodes of lists and tables).
bool OnlyGroups(const std::string& type) {
  static const std::set<std::string> kTypes = {"Document", "Part", "Sect",  "Div",   "Caption",
                                               "Table",    "TR",   "THead", "TBody", "TFoot",
                                               "L",        "LI",   "TOC",   "TOCI"};
  return kTypes.count(type) > 0;
}

bool IsCell(const std::string& type) { return type == "TD" || type == "TH"; }

bool IsHeading(const std::string& type) {
  return type.size() == 2 && type[0] == 'H' && type[1] >= '1' && type[1] <= '6';
}

const char* DecorationMark(Decoration kind) {
  switch (kind) {
    case Decoration::kPageHeader:
      return "/Artifact <</Type /Pagination /Subtype /Header>> BDC\n";
    case Decoration::kPageFooter:
      return "/Artifact <</Type /Pagination /Subtype /Footer>> BDC\n";
    case Decoration::kLayout:
      break;
  }
  return "/Artifact <</Type /Layout>> BDC\n";
}

}  // namespace

PdfStructure::PdfStructure(PdfObjects& objects, bool enabled)
    : objects_(objects), enabled_(enabled) {
  elements_.push_back({{"Document"}, kNothing, {}, nullptr});
}

int PdfStructure::Add(const PdfTag& tag, int parent) {
  const int number = static_cast<int>(elements_.size());
  elements_.push_back({tag, parent, {}, nullptr});
  Part part;
  part.child = number;
  elements_[static_cast<std::size_t>(parent)].parts.push_back(part);
  return number;
}

int PdfStructure::Begin(const PdfTag& tag) {
  open_.push_back(Add(tag, open_.empty() ? 0 : open_.back()));
  return open_.back();
}

void PdfStructure::Resume(int number) {
  TELESTRAIN_CHECK(number > 0 && number < static_cast<int>(elements_.size()),
                   "only a tag that was begun can be resumed");
  open_.push_back(number);
}

void PdfStructure::End() {
  TELESTRAIN_CHECK(!open_.empty(), "EndTag without BeginTag");
  open_.pop_back();
}

void PdfStructure::EndDecoration() {
  TELESTRAIN_CHECK(!decorations_.empty(), "EndDecoration without BeginDecoration");
  decorations_.pop_back();
}

int PdfStructure::Target() const {
  if (!decorations_.empty() || open_.empty()) return kArtifact;
  const Element& element = elements_[static_cast<std::size_t>(open_.back())];
  return OnlyGroups(element.tag.type) ? kArtifact : open_.back();
}

void PdfStructure::AddPage(HPDF_Page page) { pages_.push_back(page); }

void PdfStructure::CloseMark() {
  if (marked_ != kNothing) objects_.Write(marked_page_, "EMC\n");
  marked_ = kNothing;
}

void PdfStructure::Mark(HPDF_Page page) {
  if (!enabled_) return;
  const int target = Target();
  const Decoration kind = decorations_.empty() ? Decoration::kLayout : decorations_.back();
  const bool same_kind = target != kArtifact || kind == marked_decoration_;
  if (marked_page_ == page && marked_ == target && same_kind) return;
  CloseMark();
  marked_page_ = page;
  marked_ = target;
  marked_decoration_ = kind;
  if (target == kArtifact) return objects_.Write(page, DecorationMark(kind));
  auto& elements = elements_of_marks_[page];
  Element& element = elements_[static_cast<std::size_t>(target)];
  Part part;
  part.mark = static_cast<int>(elements.size());
  part.page = page;
  element.parts.push_back(part);
  elements.push_back(target);
  objects_.Write(page,
                 "/" + element.tag.type + " <</MCID " + std::to_string(part.mark) + ">> BDC\n");
}

const std::string& PdfStructure::OpenAlternativeText() const {
  const int open = open_.empty() ? 0 : open_.back();
  return elements_[static_cast<std::size_t>(open)].tag.alternative_text;
}

int PdfStructure::ReserveAnnotation() {
  const int element = open_.empty() ? 0 : open_.back();
  auto& parts = elements_[static_cast<std::size_t>(element)].parts;
  parts.emplace_back();
  reservations_.push_back({element, parts.size() - 1});
  return static_cast<int>(reservations_.size()) - 1;
}

int PdfStructure::ReserveAnnotation(const PdfTag& tag) {
  open_.push_back(Add(tag, 0));
  const int reservation = ReserveAnnotation();
  open_.pop_back();
  return reservation;
}

void PdfStructure::Connect(int reservation, HPDF_Page page, HPDF_Dict annotation) {
  if (!enabled_) return;
  const Reservation& place = reservations_[static_cast<std::size_t>(reservation)];
  Part& part = elements_[static_cast<std::size_t>(place.element)].parts[place.part];
  part.annotation = annotation;
  part.page = page;
  // Numbers of the parent tree: first the pages, then the annotations.
  objects_.SetNumber(annotation, "StructParent",
                     static_cast<int>(pages_.size() + elements_of_annotations_.size()));
  elements_of_annotations_.push_back(place.element);
}

bool PdfStructure::IsWanted(const Element& element) const {
  if (IsCell(element.tag.type)) return true;  // a row keeps its columns
  return std::any_of(element.parts.begin(), element.parts.end(), [&](const Part& part) {
    if (part.child >= 0) return IsWanted(elements_[static_cast<std::size_t>(part.child)]);
    return part.mark >= 0 || part.annotation != nullptr;
  });
}

// Headings as PDF/UA-1 (7.4.2) wants them: the first is H1 and none is more than one level below
// the one before, whatever the layout says; headings of equal rank keep an equal level.
void PdfStructure::CloseUpHeadings() {
  std::vector<char> ranks;  // of the headings above, outermost first
  for (Element& element : elements_) {
    if (!IsHeading(element.tag.type) || !IsWanted(element)) continue;
    const char rank = element.tag.type[1];
    while (!ranks.empty() && ranks.back() >= rank) ranks.pop_back();
    ranks.push_back(rank);
    element.tag.type[1] = static_cast<char>('0' + ranks.size());
  }
}

// A link to nowhere is only a text.
std::string PdfStructure::TypeToWrite(const Element& element) const {
  const bool leads = std::any_of(element.parts.begin(), element.parts.end(),
                                 [](const Part& part) { return part.annotation != nullptr; });
  return element.tag.type == "Link" && !leads ? "Span" : element.tag.type;
}

void PdfStructure::WriteAttributes(const Element& element) {
  const PdfTag& tag = element.tag;
  if (!tag.scope.empty()) {
    HPDF_Dict attributes = objects_.MakeDirectDictionary();
    objects_.SetName(attributes, "O", "Table");
    objects_.SetName(attributes, "Scope", tag.scope.c_str());
    objects_.Set(element.object, "A", attributes);
  }
  if (tag.box) {
    HPDF_Dict attributes = objects_.MakeDirectDictionary();
    objects_.SetName(attributes, "O", "Layout");
    objects_.SetName(attributes, "Placement", "Block");
    objects_.Set(attributes, "BBox",
                 objects_.MakeNumbers({tag.box->left_pt, tag.box->bottom_pt, tag.box->right_pt(),
                                       tag.box->top_pt()}));
    objects_.Set(element.object, "A", attributes);
  }
}

void* PdfStructure::PartObject(const Part& part, HPDF_Page own_page) {
  if (part.child >= 0) return elements_[static_cast<std::size_t>(part.child)].object;
  HPDF_Dict reference = objects_.MakeDirectDictionary();
  objects_.SetName(reference, "Type", part.annotation ? "OBJR" : "MCR");
  if (part.page != own_page || part.annotation) objects_.Set(reference, "Pg", part.page);
  if (part.annotation)
    objects_.Set(reference, "Obj", part.annotation);
  else
    objects_.SetNumber(reference, "MCID", part.mark);
  return reference;
}

void PdfStructure::WriteParts(const Element& element) {
  const auto first = std::find_if(element.parts.begin(), element.parts.end(),
                                  [](const Part& part) { return part.mark >= 0; });
  HPDF_Page own_page = first == element.parts.end() ? nullptr : first->page;
  if (own_page) objects_.Set(element.object, "Pg", own_page);
  HPDF_Array kids = objects_.MakeArray();
  for (const Part& part : element.parts) {
    if (part.child >= 0 && !elements_[static_cast<std::size_t>(part.child)].object) continue;
    if (part.child < 0 && part.mark < 0 && !part.annotation) continue;
    if (part.mark >= 0 && part.page == own_page)
      objects_.AppendNumber(kids, part.mark);
    else
      objects_.Append(kids, PartObject(part, own_page));
  }
  objects_.Set(element.object, "K", kids);
}

void PdfStructure::WriteElement(int number, HPDF_Dict parent) {
  Element& element = elements_[static_cast<std::size_t>(number)];
  element.object = objects_.MakeDictionary();
  objects_.SetName(element.object, "Type", "StructElem");
  objects_.SetName(element.object, "S", TypeToWrite(element).c_str());
  objects_.Set(element.object, "P", parent);
  const PdfTag& tag = element.tag;
  if (!tag.alternative_text.empty() && tag.type != "Link")
    objects_.SetText(element.object, "Alt", tag.alternative_text);
  // Notes need a name each (PDF/UA-1, 7.9).
  if (tag.type == "Note") objects_.SetText(element.object, "ID", "note-" + std::to_string(number));
  WriteAttributes(element);
  for (const Part& part : element.parts)
    if (part.child >= 0 && IsWanted(elements_[static_cast<std::size_t>(part.child)]))
      WriteElement(part.child, element.object);
  WriteParts(element);
}

void PdfStructure::WriteParentTree(HPDF_Dict root) {
  HPDF_Array numbers = objects_.MakeArray();
  int key = 0;
  for (HPDF_Page page : pages_) {
    HPDF_Array elements = objects_.MakeArray();
    for (const int element : elements_of_marks_[page])
      objects_.Append(elements, elements_[static_cast<std::size_t>(element)].object);
    objects_.SetNumber(page, "StructParents", key);
    objects_.AppendNumber(numbers, key++);
    objects_.Append(numbers, elements);
  }
  for (const int element : elements_of_annotations_) {
    objects_.AppendNumber(numbers, key++);
    objects_.Append(numbers, elements_[static_cast<std::size_t>(element)].object);
  }
  HPDF_Dict tree = objects_.MakeDictionary();
  objects_.Set(tree, "Nums", numbers);
  objects_.Set(root, "ParentTree", tree);
  objects_.SetNumber(root, "ParentTreeNextKey", key);
}

void PdfStructure::Write(HPDF_Dict catalog) {
  if (!enabled_) return;
  CloseMark();
  CloseUpHeadings();
  HPDF_Dict marked = objects_.MakeDirectDictionary();
  objects_.SetTrue(marked, "Marked");
  objects_.Set(catalog, "MarkInfo", marked);
  HPDF_Dict root = objects_.MakeDictionary();
  objects_.SetName(root, "Type", "StructTreeRoot");
  WriteElement(0, root);
  objects_.Set(root, "K", elements_[0].object);
  WriteParentTree(root);
  objects_.Set(catalog, "StructTreeRoot", root);
}

}  // namespace telestrain
