#pragma once

#include <string>
#include <vector>

namespace telestrain {

// What is wrong with the tags of a PDF, read with libqpdf and compared with ISO 14289-1 (PDF/UA-1)
// and ISO 32000-1, 14.6 to 14.8: one line each, empty for a good file.
//
// Of the pages: everything painted stands in exactly one mark, an artifact or one with an MCID;
// marks do not cross text objects; every MCID is used once and its element is the parent tree's.
// Of the elements: standard types, /P is the parent, none is empty but cells, figures have Alt and
// BBox, header cells a scope, tables are rectangular, headings start at H1 and skip no level, links
// and fields have their annotation and the annotations their element, description and print flag.
std::vector<std::string> StructureFaults(const std::string& pdf);

// The text between <name> and </name> of the XMP packet without other tags, entities decoded;
// empty when it is not there.
std::string XmpValue(const std::string& xmp, const std::string& name);

// The XMP packet, and an entry of the information dictionary as UTF-8.
std::string XmpOf(const std::string& pdf);
std::string InfoEntry(const std::string& pdf, const std::string& key);

}  // namespace telestrain
