#pragma once

#include <string>

class QPDF;
class QPDFObjectHandle;

namespace telestrain {

// The largest box of a signature: what a later signer draws in it covers no more of the page.
inline constexpr double kWidestBox_pt = 260, kHighestBox_pt = 90;

// Empty when the boxes of all signature fields are at most that large, inside their page and do not
// overlap (those without area are on no page for the eye); else what is wrong, naming the role.
std::string BoxesFailure(QPDF& pdf);

// Whether an appearance dictionary is one picture that fills the rectangle as it is: its BBox has
// the rectangle's size and nothing scales it.
bool FillsBox(QPDFObjectHandle appearance, QPDFObjectHandle rectangle);

}  // namespace telestrain
