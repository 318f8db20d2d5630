#include "report/pdf_attachments.h"

#include <algorithm>

namespace telestrain {
namespace {

HPDF_Dict EmbeddedFile(PdfObjects& objects, const PdfAttachment& attachment,
                       const std::string& created) {
  HPDF_Dict parameters = objects.MakeDirectDictionary();
  objects.SetNumber(parameters, "Size", static_cast<int>(attachment.bytes.size()));
  if (!created.empty()) {
    objects.SetText(parameters, "CreationDate", created);
    objects.SetText(parameters, "ModDate", created);
  }
  HPDF_Dict file = objects.MakeStream(attachment.bytes, true);
  objects.SetName(file, "Type", "EmbeddedFile");
  objects.SetName(file, "Subtype", attachment.media_type.c_str());
  objects.Set(file, "Params", parameters);
  return file;
}

HPDF_Dict FileSpecification(PdfObjects& objects, const PdfAttachment& attachment,
                            const std::string& created) {
  HPDF_Dict file = EmbeddedFile(objects, attachment, created);
  HPDF_Dict by_system = objects.MakeDirectDictionary();
  objects.Set(by_system, "F", file);
  objects.Set(by_system, "UF", file);
  HPDF_Dict specification = objects.MakeDictionary();
  objects.SetName(specification, "Type", "Filespec");
  objects.SetText(specification, "F", attachment.name);
  objects.SetText(specification, "UF", attachment.name);
  objects.SetText(specification, "Desc", attachment.description);
  objects.SetName(specification, "AFRelationship", attachment.relationship.c_str());
  objects.Set(specification, "EF", by_system);
  return specification;
}

}  // namespace

void WriteAttachments(PdfObjects& objects, HPDF_Dict catalog,
                      std::vector<PdfAttachment> attachments, const std::string& created) {
  if (attachments.empty()) return;
  std::sort(attachments.begin(), attachments.end(),
            [](const PdfAttachment& a, const PdfAttachment& b) { return a.name < b.name; });
  HPDF_Array names = objects.MakeArray();
  for (const PdfAttachment& attachment : attachments) {
    HPDF_Dict specification = FileSpecification(objects, attachment, created);
    objects.Append(names, objects.MakeText(attachment.name));
    objects.Append(names, specification);
    objects.AppendTo(catalog, "AF", specification);
  }
  HPDF_Dict files = objects.MakeDictionary();
  objects.Set(files, "Names", names);
  HPDF_Dict all_names = objects.MakeDictionary();
  objects.Set(all_names, "EmbeddedFiles", files);
  objects.Set(catalog, "Names", all_names);
}

}  // namespace telestrain
