#include "report/pdf_metadata.h"

#include <cctype>

#include "report/signature/utc_time.h"
#include "report/unicode_text.h"

namespace telestrain {
namespace {

constexpr const char* kProducer = "Haru Free PDF Library 2.3.0";

// Characters that XML 1.0 (2.2) cannot hold become U+FFFD, control characters blanks.
std::string CleanText(const std::string& text) {
  std::string clean;
  for (const char32_t point : CodePoints(text)) {
    const bool control = point < 0x20 || (point >= 0x7F && point < 0xA0);
    const bool nothing = point == 0xFFFE || point == 0xFFFF || point == 0xFEFF;
    clean += control ? " " : Utf8(nothing ? 0xFFFD : point);
  }
  const std::size_t first = clean.find_first_not_of(' '), last = clean.find_last_not_of(' ');
  return first == std::string::npos ? "" : clean.substr(first, last - first + 1);
}

// RFC 3066: 1 to 8 letters, then parts of letters and digits; "en" for anything else.
std::string CleanLanguage(const std::string& language) {
  std::size_t length = 0;
  bool first = true, fits = !language.empty();
  for (const char c : language + "-") {
    if (c == '-') {
      fits = fits && length >= 1 && length <= 8;
      length = 0;
      first = false;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      fits = fits && (std::isalpha(byte) != 0 || (!first && std::isdigit(byte) != 0));
      ++length;
    }
  }
  return fits ? language : "en";
}

std::string Escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    if (c == '&')
      xml += "&amp;";
    else if (c == '<')
      xml += "&lt;";
    else if (c == '>')
      xml += "&gt;";
    else
      xml += c;
  }
  return xml;
}

std::string Element(const std::string& name, const std::string& content) {
  return content.empty() ? "" : "  <" + name + ">" + content + "</" + name + ">\n";
}

std::string Alternatives(const std::string& text) {
  if (text.empty()) return "";
  return "<rdf:Alt><rdf:li xml:lang=\"x-default\">" + Escaped(text) + "</rdf:li></rdf:Alt>";
}

std::string List(const std::string& kind, const std::string& text) {
  if (text.empty()) return "";
  return "<rdf:" + kind + "><rdf:li>" + Escaped(text) + "</rdf:li></rdf:" + kind + ">";
}

// PDF/A (ISO 19005-3, 6.6.2.3) wants every schema described that it does not know itself.
constexpr const char* kUniversalAccess =
    R"( <rdf:Description rdf:about="" xmlns:pdfuaid="http://www.aiim.org/pdfua/ns/id/">
  <pdfuaid:part>1</pdfuaid:part>
 </rdf:Description>
 <rdf:Description rdf:about="" xmlns:pdfaExtension="http://www.aiim.org/pdfa/ns/extension/" xmlns:pdfaSchema="http://www.aiim.org/pdfa/ns/schema#" xmlns:pdfaProperty="http://www.aiim.org/pdfa/ns/property#">
  <pdfaExtension:schemas><rdf:Bag><rdf:li rdf:parseType="Resource">
   <pdfaSchema:schema>PDF/UA identification schema</pdfaSchema:schema>
   <pdfaSchema:namespaceURI>http://www.aiim.org/pdfua/ns/id/</pdfaSchema:namespaceURI>
   <pdfaSchema:prefix>pdfuaid</pdfaSchema:prefix>
   <pdfaSchema:property><rdf:Seq><rdf:li rdf:parseType="Resource">
    <pdfaProperty:name>part</pdfaProperty:name>
    <pdfaProperty:valueType>Integer</pdfaProperty:valueType>
    <pdfaProperty:category>internal</pdfaProperty:category>
    <pdfaProperty:description>Part of ISO 14289 to which the file conforms</pdfaProperty:description>
   </rdf:li></rdf:Seq></pdfaSchema:property>
  </rdf:li></rdf:Bag></pdfaExtension:schemas>
 </rdf:Description>
)";

constexpr const char* kPacketBegin =
    "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
    R"(<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
 <rdf:Description rdf:about="" xmlns:dc="http://purl.org/dc/elements/1.1/" xmlns:xmp="http://ns.adobe.com/xap/1.0/" xmlns:pdf="http://ns.adobe.com/pdf/1.3/" xmlns:pdfaid="http://www.aiim.org/pdfa/ns/id/">
)";

// Of a clean info (ISO 16684-1; PDF/A and PDF/UA identification after ISO 19005-3, 6.6.4 and ISO
// 14289-1, 5, with the extension schema that the latter needs in PDF/A).
std::string XmpPacket(const PdfInfo& info, ArchiveLevel level) {
  const bool tagged = level == ArchiveLevel::k3a;
  const auto created_s = ParsePdfTime(info.created);
  const std::string date = created_s ? IsoTime(*created_s) : "";
  std::string packet = kPacketBegin;
  packet += Element("pdfaid:part", tagged ? "3" : "1");
  packet += Element("pdfaid:conformance", tagged ? "A" : "B");
  packet += Element("dc:format", "application/pdf");
  packet += Element("dc:language", List("Bag", info.language));
  packet += Element("dc:title", Alternatives(info.title));
  packet += Element("dc:creator", List("Seq", info.author));
  packet += Element("dc:description", Alternatives(info.subject));
  packet += Element("pdf:Keywords", Escaped(info.keywords));
  packet += Element("pdf:Producer", kProducer);
  packet += Element("xmp:CreatorTool", Escaped(info.creator));
  for (const char* name : {"xmp:CreateDate", "xmp:ModifyDate", "xmp:MetadataDate"})
    packet += Element(name, date);
  packet += " </rdf:Description>\n";
  if (tagged) packet += kUniversalAccess;
  return packet + "</rdf:RDF></x:xmpmeta>\n<?xpacket end=\"r\"?>";
}

}  // namespace

PdfInfo CleanInfo(const PdfInfo& info) {
  PdfInfo clean = info;
  for (std::string* text :
       {&clean.title, &clean.author, &clean.subject, &clean.keywords, &clean.creator})
    *text = CleanText(*text);
  if (clean.title.empty()) clean.title = "Report";
  if (!ParsePdfTime(clean.created)) clean.created.clear();
  clean.language = CleanLanguage(clean.language);
  return clean;
}

void WriteMetadata(PdfObjects& objects, HPDF_Doc document, const PdfInfo& info,
                   ArchiveLevel level) {
  const auto set = [&](const char* key, const std::string& text) {
    if (!text.empty()) objects.SetText(document->info, key, text);
  };
  set("Title", info.title);
  set("Author", info.author);
  set("Subject", info.subject);
  set("Keywords", info.keywords);
  set("Creator", info.creator);
  set("Producer", kProducer);
  set("CreationDate", info.created);
  set("ModDate", info.created);
  HPDF_Dict packet = objects.MakeStream(XmpPacket(info, level), false);
  objects.SetName(packet, "Type", "Metadata");
  objects.SetName(packet, "Subtype", "XML");
  objects.Set(document->catalog, "Metadata", packet);
  objects.SetText(document->catalog, "Lang", info.language);
  HPDF_Dict preferences = objects.MakeDirectDictionary();
  objects.SetTrue(preferences, "DisplayDocTitle");
  objects.Set(document->catalog, "ViewerPreferences", preferences);
}

void WriteOutputIntent(PdfObjects& objects, HPDF_Doc document, const std::string& profile) {
  constexpr const char* kName = "sRGB IEC61966-2.1";
  HPDF_Dict icc = objects.MakeStream(profile, true);
  objects.SetNumber(icc, "N", 3);
  HPDF_Dict intent = objects.MakeDictionary();
  objects.SetName(intent, "Type", "OutputIntent");
  objects.SetName(intent, "S", "GTS_PDFA1");
  objects.SetText(intent, "OutputConditionIdentifier", kName);
  objects.SetText(intent, "Info", kName);
  objects.Set(intent, "DestOutputProfile", icc);
  objects.AppendTo(document->catalog, "OutputIntents", intent);
}

}  // namespace telestrain
