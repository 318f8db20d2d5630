#pragma once

#include <map>
#include <string>

class QPDF;

namespace telestrain {

// What a reader calls the objects of a PDF, by number: "page 3", "page 3's content", "the
// attachment results.json", "the document's information". Objects that have no such name are left
// out.
std::map<int, std::string> NamesOfObjects(QPDF& pdf);

}  // namespace telestrain
