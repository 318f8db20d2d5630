#pragma once

// Included by the pdf_*.cpp files only: libharu stays inside them.

#include <map>
#include <string>
#include <vector>

#include "report/pdf_document.h"
#include "report/pdf_objects.h"

namespace telestrain {

// The tags of a document: which marks on which page are a piece of what (PDF 32000-1, 14.7 and
// 14.8). Marks are made late: `Mark` is called before everything that is drawn and opens one only
// when the open one is of another piece, so that a mark never crosses a text object or a page.
class PdfStructure {
 public:
  PdfStructure(PdfObjects& objects, bool enabled);

  int Begin(const PdfTag& tag);
  void Resume(int number);
  void End();
  void BeginDecoration(Decoration kind) { decorations_.push_back(kind); }
  void EndDecoration();

  void AddPage(HPDF_Page page);  // the pages in their order
  // What is drawn on the page next belongs to the open tag, or is decoration.
  void Mark(HPDF_Page page);
  void CloseMark();  // before another page

  // The text for an annotation of the open tag.
  const std::string& OpenAlternativeText() const;
  // Makes the annotation a part of the open tag or of a new tag below the document's root; returns
  // what `Connect` wants. An annotation that is never connected leaves no trace.
  int ReserveAnnotation();
  int ReserveAnnotation(const PdfTag& tag);
  void Connect(int reservation, HPDF_Page page, HPDF_Dict annotation);

  // The StructTreeRoot in the catalog, once.
  void Write(HPDF_Dict catalog);

 private:
  struct Part {  // exactly one of them
    int child = -1;
    int mark = -1;  // of `page`
    HPDF_Dict annotation = nullptr;
    HPDF_Page page = nullptr;
  };
  struct Element {
    PdfTag tag;
    int parent = -1;
    std::vector<Part> parts;
    HPDF_Dict object = nullptr;
  };
  struct Reservation {
    int element = 0;
    std::size_t part = 0;  // its place among the parts
  };

  int Add(const PdfTag& tag, int parent);
  int Target() const;  // the element that what is drawn now belongs to, or kArtifact
  bool IsWanted(const Element& element) const;
  void CloseUpHeadings();
  std::string TypeToWrite(const Element& element) const;
  void WriteElement(int number, HPDF_Dict parent);
  void WriteAttributes(const Element& element);
  void WriteParts(const Element& element);
  void* PartObject(const Part& part, HPDF_Page own_page);
  void WriteParentTree(HPDF_Dict root);

  static constexpr int kNothing = -1, kArtifact = -2;

  PdfObjects& objects_;
  bool enabled_;
  std::vector<Element> elements_;  // the first is the document
  std::vector<int> open_;
  std::vector<Decoration> decorations_;
  std::vector<Reservation> reservations_;
  std::vector<HPDF_Page> pages_;
  std::map<HPDF_Page, std::vector<int>> elements_of_marks_;
  std::vector<int> elements_of_annotations_;
  HPDF_Page marked_page_ = nullptr;
  int marked_ = kNothing;
  Decoration marked_decoration_ = Decoration::kLayout;
};

}  // namespace telestrain
