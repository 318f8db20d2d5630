#pragma once

#include <qpdf/QPDF.hh>
#include <string>
#include <vector>

namespace telestrain {

// A box on a page, in points from the lower left corner of its media box's coordinates.
struct DrawnBox {
  double left_pt = 0, bottom_pt = 0, right_pt = 0, top_pt = 0;

  bool IsEmpty() const { return right_pt <= left_pt || top_pt <= bottom_pt; }
  bool Contains(double x_pt, double y_pt) const {
    return x_pt >= left_pt && x_pt <= right_pt && y_pt >= bottom_pt && y_pt <= top_pt;
  }
  bool Contains(const DrawnBox& other) const {
    return Contains(other.left_pt, other.bottom_pt) && Contains(other.right_pt, other.top_pt);
  }
  bool Overlaps(const DrawnBox& other) const {
    return left_pt < other.right_pt && other.left_pt < right_pt && bottom_pt < other.top_pt &&
           other.bottom_pt < top_pt;
  }
};
DrawnBox Common(const DrawnBox& a, const DrawnBox& b);

// Something that covers what was drawn before it.
struct PaintedBox {
  DrawnBox box;
  double luminance = -1;   // 0 black to 1 white; negative: not known (images)
  bool is_filled = false;  // the whole box, not only parts of it
  std::size_t order = 0;
};

// A text from one place to the next.
struct TextPiece {
  std::string text;           // UTF-8
  double x_pt = 0, y_pt = 0;  // where its base line starts
  double size_pt = 0;         // the smaller of height and width of the type
  double luminance = 0;
  bool is_upright = true;  // reads from left to right, not mirrored, with a known place
  DrawnBox box;            // about what it takes, from the base line up
  DrawnBox clip;           // where it can be seen
  std::size_t order = 0;
};

// What a page draws, in drawing order. The boxes of annotations that have looks of their own come
// last: they lie over the page.
struct PageDrawing {
  std::vector<TextPiece> pieces;
  std::vector<PaintedBox> boxes;
};

// Throws std::runtime_error when the page uses what reports of ours do not use: other operators
// (text render modes, transparency, shadings, inline images), fonts that are not Type0 with 16-bit
// Unicode codes, form objects, layers, a crop box or a rotation; and when there is too much of it.
PageDrawing ReadDrawing(QPDF& pdf, QPDFObjectHandle page, const std::string& content);

}  // namespace telestrain
