#include "dcc_reader.h"

#include <libxml/parser.h>
#include <libxml/xpath.h>
#include <libxml/xpathInternals.h>

#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace telestrain {
namespace {

const xmlChar* Chars(const char* text) { return reinterpret_cast<const xmlChar*>(text); }

std::vector<std::string> Words(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

std::string TextOf(xmlNodePtr node) {
  xmlChar* content = xmlNodeGetContent(node);
  std::string text = reinterpret_cast<const char*>(content);
  xmlFree(content);
  const std::size_t from = text.find_first_not_of(" \n"), to = text.find_last_not_of(" \n");
  return from == std::string::npos ? "" : text.substr(from, to - from + 1);
}

// A certificate with what XPath needs.
class Document {
 public:
  explicit Document(const std::string& xml)
      : document_(xmlReadMemory(xml.data(), static_cast<int>(xml.size()), "dcc.xml", nullptr,
                                XML_PARSE_NONET | XML_PARSE_NOERROR),
                  &xmlFreeDoc) {
    if (!document_) throw std::runtime_error("not XML");
    context_.reset(xmlXPathNewContext(document_.get()));
    xmlXPathRegisterNs(context_.get(), Chars("dcc"), Chars("https://ptb.de/dcc"));
    xmlXPathRegisterNs(context_.get(), Chars("si"), Chars("https://ptb.de/si"));
  }

  std::vector<xmlNodePtr> Find(const std::string& xpath, xmlNodePtr from = nullptr) {
    context_->node = from ? from : xmlDocGetRootElement(document_.get());
    const std::unique_ptr<xmlXPathObject, decltype(&xmlXPathFreeObject)> found(
        xmlXPathEvalExpression(Chars(xpath.c_str()), context_.get()), &xmlXPathFreeObject);
    if (!found || !found->nodesetval) return {};
    xmlNodePtr* first = found->nodesetval->nodeTab;
    return {first, first + found->nodesetval->nodeNr};
  }
  std::string Text(const std::string& xpath, xmlNodePtr from) {
    const auto nodes = Find(xpath, from);
    return nodes.empty() ? "" : TextOf(nodes.front());
  }

 private:
  std::unique_ptr<xmlDoc, decltype(&xmlFreeDoc)> document_;
  std::unique_ptr<xmlXPathContext, decltype(&xmlXPathFreeContext)> context_{nullptr,
                                                                            &xmlXPathFreeContext};
};

ReadQuantity Read(Document& document, xmlNodePtr node) {
  const auto text = [&](const char* xpath) { return document.Text(xpath, node); };
  ReadQuantity quantity;
  quantity.ref_types = text("@refType");
  quantity.name = text("dcc:name/dcc:content");
  quantity.text = text("dcc:noQuantity | dcc:charsXMLList");
  quantity.values = Words(text("si:real/si:value | si:realListXMLList/si:valueXMLList"));
  quantity.units = Words(text("si:real/si:unit | si:realListXMLList/si:unitXMLList"));
  quantity.uncertainties = Words(text("*//si:valueExpandedMU | *//si:valueExpandedMUXMLList"));
  quantity.coverage_factor = text("si:*//si:coverageFactor | si:*//si:coverageFactorXMLList");
  quantity.coverage_probability =
      text("si:*//si:coverageProbability | si:*//si:coverageProbabilityXMLList");
  quantity.conformity = Words(text("*//dcc:conformity | *//dcc:conformityXMLList"));
  quantity.lower = text("*//dcc:quantity[@refType='basic_acceptanceLimitLower']//si:value");
  quantity.upper = text("*//dcc:quantity[@refType='basic_acceptanceLimitUpper']//si:value");
  quantity.non_si_unit = text("*//dcc:nonSIUnit");
  return quantity;
}

}  // namespace

std::vector<ReadQuantity> ReadQuantities(const std::string& xml) {
  Document document(xml);
  std::vector<ReadQuantity> quantities;
  for (xmlNodePtr node :
       document.Find("//dcc:result/dcc:data/dcc:quantity | //dcc:result//dcc:list/dcc:quantity"))
    quantities.push_back(Read(document, node));
  return quantities;
}

std::vector<std::string> TextsAt(const std::string& xml, const std::string& xpath) {
  Document document(xml);
  std::vector<std::string> texts;
  for (xmlNodePtr node : document.Find(xpath)) texts.push_back(TextOf(node));
  return texts;
}

std::string Printed(const Json& cell) {
  return cell.is_string() ? cell.get<std::string>() : TextAt(cell, "/printed");
}

ReadQuantity QuantityOf(const std::vector<ReadQuantity>& quantities, const std::string& ref_type) {
  for (const ReadQuantity& quantity : quantities)
    for (const std::string& type : Words(quantity.ref_types))
      if (type == ref_type) return quantity;
  return {};
}

}  // namespace telestrain
