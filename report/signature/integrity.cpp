#include "report/signature/integrity.h"

#include <set>

#include "report/signature/contents_check.h"
#include "report/signature/opened_pdf.h"
#include "report/signature/revision_changes.h"
#include "report/signature/roles.h"
#include "report/signature/sign_rules.h"
#include "report/signature/signature_boxes.h"
#include "report/signature/signed_layout.h"
#include "report/signature/utc_time.h"

namespace telestrain {
namespace {

using Object = QPDFObjectHandle;

// What the DocMDP seal must say: filling in and signing only.
bool IsSeal(Object references) {
  if (!references.isArray() || references.getArrayNItems() != 1) return false;
  Object reference = references.getArrayItem(0);
  if (!reference.isDictionary()) return false;
  Object parameters = reference.getKey("/TransformParams");
  return reference.getKey("/TransformMethod").isNameAndEquals("/DocMDP") &&
         parameters.isDictionary() && parameters.getKey("/P").isInteger() &&
         parameters.getKey("/P").getIntValue() == 2;
}

// The signature's dictionary holds what telestrain writes and nothing else.
std::string ValueFailure(Object value, const RawSignature& raw) {
  static const std::set<std::string> kKeys = {"/Type",     "/Filter",   "/SubFilter", "/M",
                                              "/Name",     "/Reason",   "/Location",  "/ByteRange",
                                              "/Contents", "/Reference"};
  for (const std::string& key : value.getKeys())
    if (kKeys.count(key) == 0) return "its signature has an unknown entry " + key;
  if (!value.getKey("/Type").isNameAndEquals("/Sig") ||
      !value.getKey("/SubFilter").isNameAndEquals("/ETSI.CAdES.detached"))
    return "its signature is of another kind than ETSI.CAdES.detached";
  if (!value.getKey("/M").isString() || value.getKey("/M").getUTF8Value() != raw.claimed_time)
    return "its signature has two times";
  if (raw.role == kSealingRole && !IsSeal(value.getKey("/Reference")))
    return "the instrument's seal does not forbid changes (DocMDP, P 2)";
  if (raw.role != kSealingRole && value.hasKey("/Reference"))
    return "only the instrument seals (DocMDP)";
  return "";
}

// The names of the signed fields against the signatures of the file.
std::string FieldsFailure(QPDF& pdf, const std::vector<RawSignature>& signatures) {
  std::set<std::string> names;
  std::size_t signed_fields = 0;
  for (SignatureField& field : SignatureFieldsOf(pdf)) {
    if (!names.insert(field.role).second) return field.role + ": two fields have this name";
    if (!field.IsSigned()) continue;
    ++signed_fields;
    if (!IsSigningRole(field.role)) return field.role + ": is none of the roles that sign";
    bool found = false;
    for (const RawSignature& signature : signatures)
      found = found || (signature.role == field.role && field.field.getKey("/V").isIndirect() &&
                        field.field.getKey("/V").getObjectID() == signature.object);
    if (!found) return field.role + ": its field does not name its signature";
  }
  return signed_fields == signatures.size() ? "" : "a signature belongs to no field of the form";
}

class IntegrityCheck {
 public:
  IntegrityCheck(const std::string& bytes, const std::vector<std::string>* trusted)
      : bytes_(bytes), trusted_(trusted), layout_(ReadSignedLayout(bytes)) {}

  SignatureCheck Run() {
    result_.failure = layout_.failure;
    if (result_.failure.empty()) CheckAllContents();
    if (result_.failure.empty()) result_.failure = RevisionsFailure();
    if (result_.failure.empty()) result_.failure = OrderFailure(result_.signatures);
    return result_;
  }

 private:
  // The last first: it covers the whole file, so a change of any byte shows there.
  void CheckAllContents() {
    result_.signatures.resize(layout_.signatures.size());
    for (std::size_t i = layout_.signatures.size(); i-- > 0;) {
      const RawSignature& raw = layout_.signatures[i];
      const ContentsCheck check = CheckContents(bytes_, raw, trusted_);
      const auto claimed = ParsePdfTime(raw.claimed_time);
      result_.signatures[i] = {raw.role,
                               check.signer,
                               check.fingerprint,
                               claimed ? IsoTime(*claimed) : "",
                               check.time_stamp_time,
                               raw.end};
      if (check.failure.empty()) continue;
      result_.failure = check.failure;
      return;
    }
  }

  // What each update changed, from what was written first to the end.
  std::string RevisionsFailure() {
    std::string previous_bytes =
        layout_.signatures.empty() ? bytes_ : bytes_.substr(0, layout_.signatures[0].begin);
    OpenedPdf previous = OpenPdf(previous_bytes);
    if (!previous.pdf) return previous.failure;
    // One that was there before the first: an update that ReadSignedLayout does not know.
    if (previous_bytes.find("startxref\n") != previous_bytes.rfind("startxref\n") ||
        previous.pdf->getTrailer().hasKey("/Prev") || previous.pdf->getTrailer().hasKey("/XRefStm"))
      return "the file has a revision that no signature made";
    if (const auto failure = FieldsFailure(*previous.pdf, {}); !failure.empty()) return failure;
    if (!layout_.signatures.empty())
      if (const auto failure = BoxesFailure(*previous.pdf); !failure.empty()) return failure;
    for (std::size_t i = 0; i < layout_.signatures.size(); ++i) {
      const RawSignature& raw = layout_.signatures[i];
      std::string bytes = bytes_.substr(0, raw.end);
      OpenedPdf next = OpenPdf(bytes);
      if (!next.pdf) return raw.role + ": " + next.failure;
      const std::string failure = UpdateFailure(*previous.pdf, *next.pdf, i);
      if (!failure.empty()) return failure;
      previous = std::move(next);
      previous_bytes.swap(bytes);
    }
    return "";
  }

  std::string UpdateFailure(QPDF& before, QPDF& after, std::size_t index) {
    const RawSignature& raw = layout_.signatures[index];
    const std::string name = raw.role + ": ";
    Object value = after.getObjectByID(raw.object, 0);
    if (!value.isDictionary()) return name + "its signature is missing";
    if (raw.role == kSealingRole && index != 0) return name + "seals after another signature";
    if (const auto failure = ValueFailure(value, raw); !failure.empty()) return name + failure;
    const std::string change = ForbiddenChange(before, after, {raw.role, raw.object});
    if (!change.empty() && index == 0) return name + "while it was signed, " + change;
    if (!change.empty())
      return "after the signature of the " + layout_.signatures[index - 1].role + ", " + change +
             " (signed by the " + raw.role + ")";
    Object seals = after.getRoot().getKey("/Perms");
    const bool sealed = seals.isDictionary() && seals.hasKey("/DocMDP");
    if (sealed != (layout_.signatures[0].role == kSealingRole))
      return name + "the catalog's /Perms do not fit the instrument's seal";
    const std::vector<RawSignature> so_far(layout_.signatures.begin(),
                                           layout_.signatures.begin() + index + 1);
    return FieldsFailure(after, so_far);
  }

  const std::string& bytes_;
  const std::vector<std::string>* trusted_;
  SignedLayout layout_;
  SignatureCheck result_;
};

}  // namespace

SignatureCheck CheckIntegrity(const std::string& bytes, const std::vector<std::string>* trusted) {
  try {
    return IntegrityCheck(bytes, trusted).Run();
  } catch (const std::exception& error) {  // libqpdf throws where an object is damaged
    SignatureCheck check;
    check.failure = std::string("the PDF is damaged: ") + error.what();
    return check;
  }
}

}  // namespace telestrain
