#pragma once

#include <string>

#include "report/pdf_document.h"

namespace telestrain {

// The colours and sizes of a report.
struct Look {
  Color ink = ColorOf(0x202020);
  Color accent = ColorOf(0x14324F);
  Color muted = ColorOf(0x56616B);
  Color line = ColorOf(0xD3DAE1);
  Color zebra = ColorOf(0xF2F5F8);
  Color measured = ColorOf(0x1F5FA8);
  Color reference = ColorOf(0xB3261E);
  Color pass = ColorOf(0x1B7F3B);
  Color doubt = ColorOf(0x9A5B00);
  Color fail = ColorOf(0xB3261E);

  double base_size_pt = 9;  // of the body text; the other sizes follow it

  // A size that was chosen for a body of 9 pt.
  double Scaled_pt(double size_pt) const { return size_pt * base_size_pt / 9; }
  TextStyle Body() const { return {Face::kRegular, Scaled_pt(9), ink}; }
  TextStyle Note() const { return {Face::kRegular, Scaled_pt(8), muted}; }
  TextStyle Strong() const { return {Face::kBold, Scaled_pt(9), ink}; }
  Color OfVerdict(const std::string& verdict) const;
};

// Fills pages from the top down and starts a new one when something does not fit.
class PageFlow {
 public:
  PageFlow(PdfDocument& pdf, const Look& look);

  PdfDocument& pdf() { return pdf_; }
  const Look& look() const { return look_; }
  double left_pt() const;
  double width_pt() const;
  double right_pt() const { return left_pt() + width_pt(); }
  double y_pt() const { return y_pt_; }  // the top of the free part of the page
  double Free_pt() const;                // what is left of this page
  double PageBody_pt() const;            // the height of an empty page's free part

  void StartPage();
  void StartPageUnlessEmpty();
  // Starts a new page when less than `height_pt` is free and the page is not empty.
  void Require(double height_pt);
  void Advance(double height_pt) { y_pt_ -= height_pt; }
  void MoveTo(double y_pt) { y_pt_ = y_pt; }

  // A wrapped paragraph over the whole width; at least two lines stand on each side of a break.
  void Paragraph(const TextStyle& style, const std::string& text, const PdfTag& tag = {"P"});
  // Wrapped lines with their first base line just below `top_pt`, a part of the open tag; returns
  // their height.
  double TextBlock(const TextStyle& style, PagePoint top_left, double width_pt,
                   const std::string& text, Align align = Align::kLeft);
  double TextHeight_pt(const TextStyle& style, double width_pt, const std::string& text);

 private:
  PdfDocument& pdf_;
  Look look_;
  double y_pt_ = 0;
};

}  // namespace telestrain
