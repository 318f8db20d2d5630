#include <libxml/catalog.h>
#include <libxml/parser.h>
#include <libxml/xmlschemas.h>

#include <memory>
#include <mutex>

#include "base/files.h"
#include "report/dcc/dcc.h"
#include "report/dcc/dcc_xml.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

template <typename T>
using Owned = std::unique_ptr<T, void (*)(T*)>;

// libxml2 has one loader per process and hands it no context of ours.
std::mutex loader_mutex;
xmlExternalEntityLoader file_loader = nullptr;
xmlCatalogPtr catalog = nullptr;

// Looks an address up in the catalogue and reads files only.
xmlParserInputPtr LoadThroughCatalog(const char* url, const char* id, xmlParserCtxtPtr context) {
  const auto* address = reinterpret_cast<const xmlChar*>(url);
  xmlChar* found = url ? xmlACatalogResolveURI(catalog, address) : nullptr;
  if (url && !found) found = xmlACatalogResolveSystem(catalog, address);
  const std::string place = found ? reinterpret_cast<const char*>(found) : url ? url : "";
  xmlFree(found);
  const bool is_file = place.starts_with("file:") || place.find("://") == std::string::npos;
  return is_file && !place.empty() ? file_loader(place.c_str(), id, context) : nullptr;
}

// While it lives, libxml2 reads through the catalogue of one folder.
class CatalogLoader {
 public:
  explicit CatalogLoader(const fs::path& file) : lock_(loader_mutex) {
    catalog = xmlLoadACatalog(fs::absolute(file).c_str());
    file_loader = xmlGetExternalEntityLoader();
    xmlSetExternalEntityLoader(&LoadThroughCatalog);
  }
  ~CatalogLoader() {
    xmlSetExternalEntityLoader(file_loader);
    if (catalog) xmlFreeCatalog(catalog);
    catalog = nullptr;
  }
  CatalogLoader(const CatalogLoader&) = delete;
  CatalogLoader& operator=(const CatalogLoader&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
};

// Keeps the first complaint, as "line 12: …".
void KeepFirst(void* first, const xmlError* error) {
  auto& text = *static_cast<std::string*>(first);
  if (!text.empty() || !error || error->level < XML_ERR_ERROR) return;
  text = "line " + std::to_string(error->line) + ": " +
         XmlText(error->message ? error->message : "malformed");
}

void OnError(void* first, xmlErrorPtr error) { KeepFirst(first, error); }

Owned<xmlSchema> ReadSchema(const fs::path& file, std::string& complaint) {
  const Owned<xmlSchemaParserCtxt> context(xmlSchemaNewParserCtxt(file.c_str()),
                                           &xmlSchemaFreeParserCtxt);
  if (!context) return {nullptr, &xmlSchemaFree};
  xmlSchemaSetParserStructuredErrors(context.get(), &OnError, &complaint);
  return {xmlSchemaParse(context.get()), &xmlSchemaFree};
}

Owned<xmlDoc> ReadDocument(const std::string& name, const std::string& xml,
                           std::string& complaint) {
  const Owned<xmlParserCtxt> context(xmlNewParserCtxt(), &xmlFreeParserCtxt);
  if (!context) return {nullptr, &xmlFreeDoc};
  xmlDocPtr document = xmlCtxtReadMemory(
      context.get(), xml.data(), static_cast<int>(xml.size()), name.c_str(), nullptr,
      XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_BIG_LINES);
  KeepFirst(&complaint, xmlCtxtGetLastError(context.get()));
  return {document, &xmlFreeDoc};
}

}  // namespace

Status ValidateDcc(const std::string& name, const std::string& xml, const fs::path& schema_folder) {
  const fs::path schema_file = schema_folder / "dcc.xsd",
                 catalog_file = schema_folder / "catalog.xml";
  for (const fs::path& file : {schema_file, catalog_file})
    if (!fs::is_regular_file(file))
      return BadInput(file.string() +
                      ": not found; give the folder with dcc.xsd of DCC 3.3.0 and the catalog.xml "
                      "that names the files of its imports");
  xmlInitParser();
  const CatalogLoader loader(catalog_file);
  std::string complaint;
  const auto schema = ReadSchema(schema_file, complaint);
  if (!schema) return BadInput(schema_file.string() + ": not a schema: " + complaint);
  const auto document = ReadDocument(name, xml, complaint);
  if (!document) return BadInput(name + ": " + complaint + " (not XML)");
  const Owned<xmlSchemaValidCtxt> context(xmlSchemaNewValidCtxt(schema.get()),
                                          &xmlSchemaFreeValidCtxt);
  if (!context) return OutputFailed(name + ": out of memory while it was checked");
  xmlSchemaSetValidStructuredErrors(context.get(), &OnError, &complaint);
  if (xmlSchemaValidateDoc(context.get(), document.get()) == 0) return {};
  return BadInput(name + ": " + complaint + " (DCC 3.3.0)");
}

}  // namespace telestrain
