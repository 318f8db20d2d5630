#pragma once

#include <qpdf/QPDF.hh>
#include <string>
#include <vector>

#include "report/reading/printed_hashes.h"

namespace telestrain {

// A stream's decoded bytes. Throws std::runtime_error when it cannot be decoded or would be longer
// than `limit` bytes: a small file may hold a stream of any length.
std::string StreamBytes(QPDFObjectHandle stream, std::size_t limit);

struct PageText {
  std::string text;  // UTF-8, a line per piece (from one place to the next), in drawing order
  std::vector<PrintedHash> hashes;  // those that can be seen
};

// What a page says. Throws std::exception when the page is malformed, draws otherwise than our
// reports do, or its content is longer than `limit` bytes, of which its length is taken.
PageText ReadPage(QPDF& pdf, QPDFObjectHandle page, std::size_t& limit);

}  // namespace telestrain
