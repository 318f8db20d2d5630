#pragma once

#include <qpdf/QPDF.hh>
#include <string>

namespace telestrain {

// A stream's decoded bytes. Throws std::runtime_error when it cannot be decoded or would be longer
// than `limit` bytes: a small file may hold a stream of any length.
std::string StreamBytes(QPDFObjectHandle stream, std::size_t limit);

// The text that a page draws, UTF-8: a line per piece (from one place to the next), in drawing
// order. Text of fonts other than this program's kind (Type0 with 16-bit Unicode codes) is left
// out. Throws std::exception when the page is malformed or its content longer than `limit` bytes.
std::string PageText(QPDF& pdf, QPDFObjectHandle page, std::size_t limit);

}  // namespace telestrain
