#include "pdf_structure_check.h"

#include <map>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <set>

namespace telestrain {
namespace {

using Object = QPDFObjectHandle;

const std::set<std::string> kTypes = {"/Document", "/Sect",  "/H1",      "/H2",    "/H3",
                                      "/P",        "/Table", "/TR",      "/TH",    "/TD",
                                      "/L",        "/LI",    "/Lbl",     "/LBody", "/Link",
                                      "/Figure",   "/Form",  "/Caption", "/Span",  "/Note"};
const std::set<std::string> kPaints = {"f", "F",  "f*", "B",  "B*", "b", "b*", "S",
                                       "s", "Do", "sh", "Tj", "TJ", "'", "\""};

using Faults = std::vector<std::string>;

// The marks of one page.
class MarkReader : public Object::ParserCallbacks {
 public:
  explicit MarkReader(Faults& faults, const std::string& where) : faults_(faults), where_(where) {}
  std::multiset<int> marks;

  void handleObject(Object object) override {
    if (!object.isOperator()) {
      operands_.push_back(object);
      return;
    }
    const std::string name = object.getOperatorValue();
    if (name == "BDC" || name == "BMC") Begin();
    if (name == "EMC") End();
    if (name == "BT" || name == "ET") depth_at_text_ = name == "BT" ? depth_ : Check(name);
    if (name == "q") ++saved_;
    if (name == "Q") --saved_;
    if (kPaints.count(name) > 0 && depth_ != 1)
      faults_.push_back(where_ + ": " + name + " in " + std::to_string(depth_) + " marks");
    operands_.clear();
  }
  void handleEOF() override {
    if (depth_ != 0) faults_.push_back(where_ + ": a mark is open at the end");
    if (saved_ != 0) faults_.push_back(where_ + ": q without Q");
  }

 private:
  int Check(const std::string& name) {
    if (depth_at_text_ != depth_) faults_.push_back(where_ + ": a mark crosses " + name);
    return -1;
  }
  void Begin() {
    if (++depth_ > 1) faults_.push_back(where_ + ": a mark in a mark");
    const bool artifact = operands_.at(0).getName() == "/Artifact";
    Object mcid = operands_.size() > 1 ? operands_[1].getKey("/MCID") : Object::newNull();
    if (artifact == mcid.isInteger()) faults_.push_back(where_ + ": an artifact or an MCID");
    if (mcid.isInteger()) marks.insert(mcid.getIntValueAsInt());
  }
  void End() {
    if (--depth_ < 0) faults_.push_back(where_ + ": EMC without BDC");
    if (depth_at_text_ > depth_) faults_.push_back(where_ + ": a mark ends in a text");
  }

  Faults& faults_;
  std::string where_;
  std::vector<Object> operands_;
  int depth_ = 0, saved_ = 0, depth_at_text_ = -1;
};

class StructureCheck {
 public:
  explicit StructureCheck(QPDF& pdf) : pdf_(pdf) {}
  Faults Run();

 private:
  void Expect(bool good, const std::string& fault) {
    if (!good) faults_.push_back(fault);
  }
  void ReadParentTree();
  void ReadPages();
  void ReadAnnotations(Object page, const std::string& where);
  void Visit(Object element, Object parent);
  void VisitKid(Object element, Object kid, const std::string& name);
  void CheckElement(Object element, const std::string& type, std::size_t kids);
  void CheckTable(Object table);
  void CheckHeading(const std::string& type);
  static std::vector<Object> Kids(Object element) {
    Object kids = element.getKey("/K");
    if (kids.isNull()) return {};
    return kids.isArray() ? kids.getArrayAsVector() : std::vector<Object>{kids};
  }

  QPDF& pdf_;
  Faults faults_;
  std::map<int, Object> parent_tree_;
  std::map<QPDFObjGen, std::multiset<int>> marks_of_page_;  // of the content streams
  std::map<QPDFObjGen, int> key_of_page_;
  std::set<QPDFObjGen> annotations_;  // that elements refer to
  int heading_ = 0;
};

void StructureCheck::ReadParentTree() {
  Object numbers = pdf_.getRoot().getKey("/StructTreeRoot").getKey("/ParentTree").getKey("/Nums");
  Expect(numbers.isArray(), "no parent tree");
  if (!numbers.isArray()) return;
  for (int i = 0; i + 1 < numbers.getArrayNItems(); i += 2)
    parent_tree_[numbers.getArrayItem(i).getIntValueAsInt()] = numbers.getArrayItem(i + 1);
}

void StructureCheck::ReadPages() {
  int number = 0;
  for (QPDFPageObjectHelper& helper : QPDFPageDocumentHelper(pdf_).getAllPages()) {
    Object page = helper.getObjectHandle();
    const std::string where = "page " + std::to_string(++number);
    MarkReader reader(faults_, where);
    helper.parseContents(&reader);
    marks_of_page_[page.getObjGen()] = reader.marks;
    Expect(page.getKey("/StructParents").isInteger(), where + ": no StructParents");
    Expect(page.getKey("/Tabs").isNameAndEquals("/S"), where + ": Tabs is not S");
    if (page.getKey("/StructParents").isInteger())
      key_of_page_[page.getObjGen()] = page.getKey("/StructParents").getIntValueAsInt();
  }
}

// After the elements were visited.
void StructureCheck::ReadAnnotations(Object page, const std::string& where) {
  Object annotations = page.getKey("/Annots");
  if (!annotations.isArray()) return;
  for (Object annotation : annotations.getArrayAsVector()) {
    const std::string kind = annotation.getKey("/Subtype").getName();
    const bool link = kind == "/Link";
    Expect(link || kind == "/Widget", where + ": annotation " + kind);
    Expect(annotations_.count(annotation.getObjGen()) > 0, where + ": no element has " + kind);
    Expect(annotation.getKey("/F").isInteger() && annotation.getKey("/F").getIntValueAsInt() == 4,
           where + ": flags of " + kind);
    Expect(annotation.getKey(link ? "/Contents" : "/TU").isString(), where + ": words of " + kind);
    Expect(link || annotation.getKey("/AP").getKey("/N").isStream(), where + ": appearance");
    Object key = annotation.getKey("/StructParent");
    Expect(key.isInteger() && parent_tree_.count(key.getIntValueAsInt()) > 0 &&
               parent_tree_[key.getIntValueAsInt()].getKey("/S").isNameAndEquals(link ? "/Link"
                                                                                      : "/Form"),
           where + ": parent of " + kind);
  }
}

void StructureCheck::CheckHeading(const std::string& type) {
  if (type.size() != 3 || type[1] != 'H' || type[2] < '1' || type[2] > '6') return;
  const int level = type[2] - '0';
  Expect(level <= heading_ + 1, type + " behind H" + std::to_string(heading_));
  heading_ = level;
}

void StructureCheck::CheckTable(Object table) {
  std::set<std::size_t> columns;
  for (Object row : Kids(table))
    if (row.isDictionary() && row.getKey("/S").isNameAndEquals("/TR"))
      columns.insert(Kids(row).size());
  Expect(columns.size() == 1, "a table's rows have different numbers of cells");
}

void StructureCheck::CheckElement(Object element, const std::string& type, std::size_t kids) {
  const std::string parent =
      element.getKey("/P").getKey("/S").isName() ? element.getKey("/P").getKey("/S").getName() : "";
  Expect(kTypes.count(type) > 0, "type " + type);
  Expect(kids > 0 || type == "/TD", "empty " + type);
  const bool cell = type == "/TD" || type == "/TH";
  Expect(cell == (parent == "/TR"), type + " in " + parent);
  Expect((type == "/TR" || type == "/Caption") == (parent == "/Table"), type + " in " + parent);
  Expect((type == "/LI") == (parent == "/L"), type + " in " + parent);
  Expect((type == "/Lbl" || type == "/LBody") == (parent == "/LI"), type + " in " + parent);
  Object attributes = element.getKey("/A");
  if (type == "/TH") {
    Object scope = attributes.isDictionary() ? attributes.getKey("/Scope") : Object::newNull();
    Expect(scope.isNameAndEquals("/Row") || scope.isNameAndEquals("/Column"), "scope of a TH");
  }
  if (type == "/Figure") {
    Object words = element.getKey("/Alt");
    Expect(words.isString() && !words.getUTF8Value().empty(), "a figure without words");
    Expect(attributes.isDictionary() && attributes.getKey("/BBox").isRectangle(), "figure's BBox");
  }
  if (type == "/Form") Expect(kids == 1, "a form with more than its field");
  if (type == "/Table") CheckTable(element);
  CheckHeading(type);
}

void StructureCheck::VisitKid(Object element, Object kid, const std::string& name) {
  if (kid.isDictionary() && kid.getKey("/Type").isNameAndEquals("/OBJR")) {
    annotations_.insert(kid.getKey("/Obj").getObjGen());
    Expect(name == "/Link" || name == "/Form", "an annotation in " + name);
    return;
  }
  const bool reference = kid.isDictionary() && kid.getKey("/Type").isNameAndEquals("/MCR");
  if (!kid.isInteger() && !reference) return Visit(kid, element);
  const bool groups = name == "/Table" || name == "/TR" || name == "/L" || name == "/LI" ||
                      name == "/Document" || name == "/Caption" || name == "/Sect";
  Expect(!groups, name + " has content of its own");
  Object page = reference && kid.hasKey("/Pg") ? kid.getKey("/Pg") : element.getKey("/Pg");
  const int mark = reference ? kid.getKey("/MCID").getIntValueAsInt() : kid.getIntValueAsInt();
  auto& marks = marks_of_page_[page.getObjGen()];
  Expect(marks.count(mark) == 1, "mark " + std::to_string(mark) + " of " + name);
  marks.erase(mark);
  Object elements = parent_tree_[key_of_page_[page.getObjGen()]];
  Expect(elements.isArray() && mark < elements.getArrayNItems() &&
             elements.getArrayItem(mark).getObjGen() == element.getObjGen(),
         "parent tree of mark " + std::to_string(mark) + " of " + name);
}

void StructureCheck::Visit(Object element, Object parent) {
  Expect(element.isDictionary() && element.getKey("/S").isName(), "an element without type");
  if (!element.isDictionary() || !element.getKey("/S").isName()) return;
  const std::string type = element.getKey("/S").getName();
  Expect(element.getKey("/P").getObjGen() == parent.getObjGen(), "/P of " + type);
  const std::vector<Object> kids = Kids(element);
  CheckElement(element, type, kids.size());
  for (const Object& kid : kids) VisitKid(element, kid, type);
}

Faults StructureCheck::Run() {
  Object root = pdf_.getRoot();
  Object marked = root.getKey("/MarkInfo");
  Expect(marked.isDictionary() && marked.getKey("/Marked").isBool() &&
             marked.getKey("/Marked").getBoolValue(),
         "not marked");
  Expect(root.getKey("/Lang").isString(), "no language");
  Object preferences = root.getKey("/ViewerPreferences");
  Expect(preferences.isDictionary() && preferences.getKey("/DisplayDocTitle").isBool(),
         "the title is not displayed");
  Object tree = root.getKey("/StructTreeRoot");
  if (!tree.isDictionary()) return {"no structure tree"};
  ReadParentTree();
  ReadPages();
  Visit(tree.getKey("/K"), tree);
  Expect(heading_ > 0, "no heading");
  for (const auto& [page, marks] : marks_of_page_)
    Expect(marks.empty(), "marks of no element on object " + page.unparse());
  int number = 0;
  for (QPDFPageObjectHelper& page : QPDFPageDocumentHelper(pdf_).getAllPages())
    ReadAnnotations(page.getObjectHandle(), "page " + std::to_string(++number));
  return faults_;
}

}  // namespace

std::vector<std::string> StructureFaults(const std::string& bytes) {
  QPDF pdf;
  pdf.setSuppressWarnings(true);
  try {
    pdf.processMemoryFile("report.pdf", bytes.data(), bytes.size());
    Faults faults = StructureCheck(pdf).Run();
    for (const QPDFExc& warning : pdf.getWarnings()) faults.push_back(warning.what());
    return faults;
  } catch (const std::exception& error) {
    return {error.what()};
  }
}

std::string XmpOf(const std::string& bytes) {
  QPDF pdf;
  pdf.processMemoryFile("report.pdf", bytes.data(), bytes.size());
  const auto data = pdf.getRoot().getKey("/Metadata").getStreamData();
  return {reinterpret_cast<const char*>(data->getBuffer()), data->getSize()};
}

std::string InfoEntry(const std::string& bytes, const std::string& key) {
  QPDF pdf;
  pdf.processMemoryFile("report.pdf", bytes.data(), bytes.size());
  Object entry = pdf.getTrailer().getKey("/Info").getKey("/" + key);
  return entry.isString() ? entry.getUTF8Value() : "";
}

std::string XmpValue(const std::string& xmp, const std::string& name) {
  const std::string begin = "<" + name + ">", end = "</" + name + ">";
  const std::size_t from = xmp.find(begin), to = xmp.find(end);
  if (from == std::string::npos || to == std::string::npos) return "";
  std::string text;
  bool in_tag = false;
  for (const char c : xmp.substr(from, to - from)) {
    if (c == '<') in_tag = true;
    if (!in_tag) text += c;
    if (c == '>') in_tag = false;
  }
  for (const auto& [entity, character] :
       {std::pair("&lt;", "<"), std::pair("&gt;", ">"), std::pair("&amp;", "&")})
    for (std::size_t at = text.find(entity); at != std::string::npos;
         at = text.find(entity, at + 1))
      text.replace(at, std::string(entity).size(), character);
  return text;
}

}  // namespace telestrain
