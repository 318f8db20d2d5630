#include "report/reading/attached_files.h"

#include <set>
#include <stdexcept>
#include <utility>

#include "report/reading/page_text.h"

namespace telestrain {
namespace {

using Files = std::map<std::string, std::string>;
using ObjectIds = std::set<QPDFObjGen>;

void Require(bool holds, const std::string& reason) {
  if (!holds) throw std::runtime_error(reason);
}

// The list [name, file, name, file …], empty without one.
std::vector<QPDFObjectHandle> ListOfFiles(QPDF& pdf) {
  QPDFObjectHandle names = pdf.getRoot().getKey("/Names");
  if (names.isNull()) return {};
  Require(names.isDictionary(), "its list of attachments is malformed");
  QPDFObjectHandle files = names.getKey("/EmbeddedFiles");
  if (files.isNull()) return {};
  Require(files.isDictionary() && files.getKeys() == std::set<std::string>{"/Names"} &&
              files.getKey("/Names").isArray(),
          "its list of attachments is not as ours are");
  const auto list = files.getKey("/Names").getArrayAsVector();
  Require(list.size() % 2 == 0, "its list of attachments is malformed");
  return list;
}

QPDFObjectHandle StreamOf(const std::string& name, QPDFObjectHandle file) {
  Require(file.isIndirect() && file.isDictionary(), "attachment " + name + " is malformed");
  for (const char* key : {"/F", "/UF"}) {
    QPDFObjectHandle other = file.getKey(key);
    Require(other.isString() && other.getUTF8Value() == name,
            "attachment " + name + " has another name too");
  }
  QPDFObjectHandle by_system = file.getKey("/EF");
  Require(by_system.isDictionary() && by_system.getKeys() == std::set<std::string>{"/F", "/UF"},
          "attachment " + name + " is malformed");
  QPDFObjectHandle stream = by_system.getKey("/F");
  Require(stream.isStream(), "attachment " + name + " has no bytes");
  Require(stream.getObjGen() == by_system.getKey("/UF").getObjGen(),
          "attachment " + name + " has other bytes for other readers");
  return stream;
}

// The files of the whole document (ISO 19005-3) are the listed ones.
void RequireAssociated(QPDF& pdf, const ObjectIds& listed) {
  ObjectIds associated;
  QPDFObjectHandle files = pdf.getRoot().getKey("/AF");
  if (files.isArray())
    for (QPDFObjectHandle file : files.getArrayAsVector()) associated.insert(file.getObjGen());
  Require(files.isNull() || files.isArray(), "its associated files are malformed");
  Require(associated == listed, "its associated files are not its attachments");
}

void RequireNoneElsewhere(QPDF& pdf, const ObjectIds& listed) {
  for (QPDFObjectHandle object : pdf.getAllObjects())
    Require(!object.isDictionary() || !object.hasKey("/EF") || listed.contains(object.getObjGen()),
            "a file is attached outside its list of attachments");
  for (QPDFObjectHandle page : pdf.getAllPages()) {
    Require(!page.hasKey("/AF"), "a page of it has a file of its own");
    QPDFObjectHandle notes = page.getKey("/Annots");
    Require(notes.isNull() || notes.isArray(), "the links of a page are malformed");
    if (notes.isNull()) continue;
    for (QPDFObjectHandle note : notes.getArrayAsVector())
      Require(note.isDictionary() && !note.hasKey("/FS") && !note.hasKey("/AF") &&
                  (note.getKey("/Subtype").isNameAndEquals("/Link") ||
                   note.getKey("/Subtype").isNameAndEquals("/Widget")),
              "a page of it has an annotation that is neither a link nor a field");
  }
}

}  // namespace

Files AttachedFiles(QPDF& pdf, std::size_t limit) {
  const auto list = ListOfFiles(pdf);
  Files files;
  ObjectIds listed;
  std::string before;
  for (std::size_t i = 0; i < list.size(); i += 2) {
    QPDFObjectHandle key = list[i], file = list[i + 1];
    const std::string name = key.isString() ? key.getUTF8Value() : "";
    Require(!name.empty(), "an attachment of it has no name");
    Require(!files.contains(name), "two attachments are named " + name);
    Require(before < name, "its attachments are not in the order of their names");
    std::string bytes = StreamBytes(StreamOf(name, file), limit);
    limit -= bytes.size();
    Require(listed.insert(file.getObjGen()).second, "an attachment of it has two names");
    files.emplace(name, std::move(bytes));
    before = name;
  }
  RequireAssociated(pdf, listed);
  RequireNoneElsewhere(pdf, listed);
  return files;
}

}  // namespace telestrain
