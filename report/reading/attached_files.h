#pragma once

#include <map>
#include <qpdf/QPDF.hh>
#include <string>

namespace telestrain {

// The attachments by name. There is one way to see them: every reader must find the same bytes
// under the same name, whichever of the entries it follows. Throws std::runtime_error with what is
// not so, for a file that is attached elsewhere than in the document's one list, and when all
// together are longer than `limit` bytes.
std::map<std::string, std::string> AttachedFiles(QPDF& pdf, std::size_t limit);

}  // namespace telestrain
