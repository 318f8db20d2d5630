#include "report/signature/object_names.h"

#include <qpdf/QPDFPageDocumentHelper.hh>
#include <vector>

#include "report/signature/opened_pdf.h"

namespace telestrain {
namespace {

// Names objects; the first name of an object stays.
class Naming {
 public:
  explicit Naming(QPDF& pdf) : pdf_(pdf) {}
  std::map<int, std::string> Run() {
    QPDFObjectHandle root = pdf_.getRoot();
    Name(root, "the catalog");
    Name(pdf_.getTrailer().getKey("/Info"), "the document's information");
    Name(root.getKey("/Metadata"), "the XMP metadata");
    NamePages();
    NameFields();
    NameAttachments(root.getKey("/AF"));
    NameBelow(root.getKey("/Names"), "the list of names", 6);
    NameBelow(root.getKey("/Outlines"), "the bookmarks", 8);
    NameBelow(root.getKey("/OutputIntents"), "the colour profile", 3);
    Name(root.getKey("/Pages"), "the list of pages");
    NameBelow(root.getKey("/StructTreeRoot"), "the structure for reading aids", 30);
    return std::move(names_);
  }

 private:
  void Name(QPDFObjectHandle object, const std::string& name) {
    if (object.isIndirect() && !object.isNull()) names_.emplace(object.getObjectID(), name);
  }

  // This object and all it refers to, down to a depth; stops where something has a name.
  void NameBelow(QPDFObjectHandle object, const std::string& name, int depth) {
    if (depth < 0) return;
    if (object.isIndirect() && !names_.emplace(object.getObjectID(), name).second) return;
    if (object.isArray())
      for (const QPDFObjectHandle& item : object.getArrayAsVector())
        NameBelow(item, name, depth - 1);
    QPDFObjectHandle dictionary = object.isStream() ? object.getDict() : object;
    if (!dictionary.isDictionary()) return;
    for (auto& [key, value] : dictionary.getDictAsMap()) NameBelow(value, name, depth - 1);
  }

  void NamePages() {
    int number = 0;
    const auto pages = pdf_.getAllPages();
    for (QPDFObjectHandle page : pages) Name(page, "page " + std::to_string(++number));
    number = 0;
    for (QPDFObjectHandle page : pages) {
      const std::string whose = "page " + std::to_string(++number) + "'s ";
      Name(page.getKey("/Contents"), whose + "content");
      if (page.getKey("/Contents").isArray())
        for (const QPDFObjectHandle& part : page.getKey("/Contents").getArrayAsVector())
          Name(part, whose + "content");
      Name(page.getKey("/Annots"), whose + "list of links and fields");
      NameResources(page.getKey("/Resources"), whose);
    }
  }

  void NameResources(QPDFObjectHandle resources, const std::string& whose) {
    if (!resources.isDictionary()) return;
    NameBelow(resources.getKey("/XObject"), whose + "picture", 3);
    NameBelow(resources.getKey("/Font"), whose + "font", 5);
    NameBelow(resources, whose + "resources", 3);
  }

  void NameFields() {
    for (SignatureField& field : SignatureFieldsOf(pdf_)) {
      Name(field.field, "the field of the " + field.role);
      Name(field.field.getKey("/V"), "the " + field.role + "'s signature");
      NameBelow(field.field.getKey("/AP"), "the picture of the " + field.role + "'s signature", 5);
    }
    QPDFObjectHandle form = pdf_.getRoot().getKey("/AcroForm");
    Name(form, "the form");
    if (form.isDictionary()) Name(form.getKey("/Fields"), "the list of signature fields");
  }

  void NameAttachments(QPDFObjectHandle list) {
    if (!list.isArray()) return;
    Name(list, "the list of attachments");
    for (QPDFObjectHandle file : list.getArrayAsVector()) {
      if (!file.isDictionary()) continue;
      QPDFObjectHandle name = file.getKey(file.hasKey("/UF") ? "/UF" : "/F");
      NameBelow(file, "the attachment " + (name.isString() ? name.getUTF8Value() : ""), 3);
    }
  }

  QPDF& pdf_;
  std::map<int, std::string> names_;
};

}  // namespace

std::map<int, std::string> NamesOfObjects(QPDF& pdf) { return Naming(pdf).Run(); }

}  // namespace telestrain
