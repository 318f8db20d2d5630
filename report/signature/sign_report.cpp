#include "report/signature/sign_report.h"

#include <exception>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "base/files.h"
#include "report/signature/certificate.h"
#include "report/signature/integrity.h"
#include "report/signature/opened_pdf.h"
#include "report/signature/pdf_update.h"
#include "report/signature/roles.h"
#include "report/signature/sign_rules.h"
#include "report/signature/signature_boxes.h"
#include "report/signature/signature_picture.h"
#include "report/signature/signed_data.h"
#include "report/signature/signed_layout.h"
#include "report/signature/time_stamp.h"
#include "report/signature/utc_time.h"

namespace telestrain {
namespace {

using Object = QPDFObjectHandle;

constexpr std::size_t kReserve_bytes = 2048;            // beside the certificates
constexpr std::size_t kTimeStampReserve_bytes = 12288;  // tokens with chains are of 3 to 8 kB

bool IsOurs(QPDF& pdf, const std::string& bytes) {
  Object info = pdf.getTrailer().getKey("/Info");
  Object creator = info.isDictionary() ? info.getKey("/Creator") : info;
  Object id = pdf.getTrailer().getKey("/ID");
  return creator.isString() && creator.getUTF8Value().starts_with("telestrain") && id.isArray() &&
         id.getArrayNItems() == 2 && LastTable(bytes) != 0;
}

// Earlier signatures hold and leave room for this one, at its time and with its certificate.
Status CheckEarlier(const std::string& bytes, const SigningKey& key, const SignOptions& options) {
  const std::string& role = options.role;
  SignatureCheck earlier = CheckIntegrity(bytes, nullptr);
  if (!earlier.failure.empty()) return BadInput(earlier.failure + "; it cannot be signed");
  for (const PdfSignature& signature : earlier.signatures)
    if (signature.role == role)
      return BadInput("the " + role + " has already signed (" + signature.signer + ", " +
                      signature.claimed_time + "); a role signs once");
  if (role == kSealingRole && !earlier.signatures.empty())
    return BadInput("the instrument seals first, but the " + earlier.signatures[0].role +
                    " has signed; write the report again and begin with the instrument");
  PdfSignature next;
  next.role = role;
  next.fingerprint = Sha256Hex(key.certificate);
  next.claimed_time = IsoTime(options.time_s);
  earlier.signatures.push_back(next);
  const std::string failure = OrderFailure(earlier.signatures);
  return failure.empty() ? Status() : BadInput(failure);
}

// The certificate's name; what the signer gives as name only stands beside it.
std::string ShownName(const std::string& common_name, const std::string& given) {
  return given.empty() || given == common_name ? common_name : common_name + " (" + given + ")";
}

class Signing {
 public:
  Signing(QPDF& pdf, const std::string& bytes, const SigningKey& key, const SignOptions& options)
      : pdf_(pdf),
        key_(key),
        options_(options),
        update_(pdf, bytes),
        signer_(CommonName(key.certificate)),
        name_(ShownName(signer_, options.name)) {}

  Result<SignedReport> Run() {
    signature_ = pdf_.makeIndirectObject(Object::newDictionary());
    Object field = FieldOfRole();
    field.replaceKey("/V", signature_);
    TELESTRAIN_RETURN_IF_ERROR(DrawIn(field));
    if (options_.role == kSealingRole) Seal();
    auto prepared = update_.Write(signature_, Entries(), Reserve_bytes());
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string der, MakeCms(Sha256(prepared.SignedBytes())));
    if (der.size() > Reserve_bytes())
      return OutputFailed("the signature takes " + std::to_string(der.size()) + " bytes, " +
                          std::to_string(Reserve_bytes()) +
                          " are reserved; use a responder with a shorter certificate chain");
    prepared.bytes.replace(prepared.gap_begin + 1, 2 * der.size(), HexOf(der));
    if (const auto check = CheckIntegrity(prepared.bytes, nullptr); !check.failure.empty())
      return OutputFailed("the signed file would not hold: " + check.failure);
    return SignedReport{prepared.bytes, signer_, Sha256Hex(key_.certificate)};
  }

 private:
  // The existing field, or a new invisible one on the last page.
  Object FieldOfRole() {
    Object form = Form();
    form.replaceKey("/SigFlags", Object::newInteger(3));  // signed; only to be appended to
    for (SignatureField& field : SignatureFieldsOf(pdf_)) {
      if (field.role != options_.role) continue;
      update_.Touch(field.field);
      return field.field;
    }
    Object page = pdf_.getAllPages().back();
    Object field = pdf_.makeIndirectObject(
        Object::parse("<< /Type /Annot /Subtype /Widget /FT /Sig /F 132 /Rect [0 0 0 0] >>"));
    field.replaceKey("/T", Object::newString(options_.role));
    field.replaceKey("/P", page);
    Append(form, form, "/Fields", field);
    Append(page, page, "/Annots", field);
    return field;
  }

  // The form; the object it stands in is written again.
  Object Form() {
    Object root = pdf_.getRoot();
    Object form = root.getKey("/AcroForm");
    if (!form.isDictionary()) {
      form = pdf_.makeIndirectObject(Object::parse("<< /Fields [] >>"));
      root.replaceKey("/AcroForm", form);
      update_.Touch(root);
    }
    update_.Touch(form.isIndirect() ? form : root);
    return form;
  }

  // `written`: what holds the list if that is no object of its own.
  void Append(Object owner, Object written, const char* key, Object item) {
    if (!owner.getKey(key).isArray()) owner.replaceKey(key, Object::newArray());
    Object list = owner.getKey(key);
    list.appendItem(item);
    if (list.isIndirect())
      update_.Touch(list);
    else if (written.isIndirect())
      update_.Touch(written);
  }

  // The picture as the field's appearance, unless the field is invisible.
  Status DrawIn(Object field) {
    const auto box = field.getKey("/Rect").getArrayAsRectangle();
    SignaturePicture picture{options_.role,
                             name_,
                             IsoTime(options_.time_s),
                             options_.reason,
                             options_.place,
                             Sha256Hex(key_.certificate),
                             IsDemonstration(),
                             box.urx - box.llx,
                             box.ury - box.lly};
    if (picture.width_pt <= 0 || picture.height_pt <= 0) return {};
    TELESTRAIN_ASSIGN_OR_RETURN(picture_bytes_, DrawSignaturePicture(picture));
    picture_pdf_.processMemoryFile("picture", picture_bytes_.data(), picture_bytes_.size());
    Object page = picture_pdf_.getAllPages().at(0);
    Object drawn = pdf_.copyForeignObject(QPDFPageObjectHelper(page).getFormXObjectForPage());
    drawn.getDict().removeKey("/Group");  // PDF/A has no transparency here
    drawn.getDict().replaceKey(
        "/BBox", Object::newFromRectangle({0, 0, picture.width_pt, picture.height_pt}));
    Object appearance = Object::newDictionary();
    appearance.replaceKey("/N", drawn);
    field.replaceKey("/AP", appearance);
    return {};
  }

  bool IsDemonstration() const {
    std::string subject = SubjectText(key_.certificate);
    for (char& c : subject) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return subject.find("demonstration") != std::string::npos;
  }

  void Seal() {
    Object permissions = Object::newDictionary();
    permissions.replaceKey("/DocMDP", signature_);
    pdf_.getRoot().replaceKey("/Perms", permissions);
    update_.Touch(pdf_.getRoot());
  }

  std::string Entries() const {
    std::string entries = std::string(kSignatureHead) + PdfTime(options_.time_s) + ")";
    const auto add = [&](const char* key, const std::string& text) {
      if (!text.empty())
        entries += std::string("\n") + key + " " + Object::newUnicodeString(text).unparseBinary();
    };
    add("/Name", name_);
    add("/Reason", options_.reason);
    add("/Location", options_.place);
    if (options_.role == kSealingRole)
      entries +=
          "\n/Reference [<< /Type /SigRef /TransformMethod /DocMDP /TransformParams "
          "<< /Type /TransformParams /P 2 /V /1.2 >> >>]";
    return entries;
  }

  std::size_t Reserve_bytes() const {
    std::size_t bytes = kReserve_bytes + key_.certificate.size();
    for (const std::string& certificate : key_.chain) bytes += certificate.size();
    return options_.time_stamp_url.empty() ? bytes : bytes + kTimeStampReserve_bytes;
  }

  Result<std::string> MakeCms(const std::string& digest) const {
    SignedData data;
    data.certificates = {key_.certificate};
    data.certificates.insert(data.certificates.end(), key_.chain.begin(), key_.chain.end());
    data.digest = "SHA256";
    data.attributes = SignatureAttributes(digest, key_.certificate);
    TELESTRAIN_ASSIGN_OR_RETURN(data.signature, SignBytes(key_, AttributesToSign(data)));
    if (!options_.time_stamp_url.empty()) {
      TELESTRAIN_ASSIGN_OR_RETURN(data.time_stamp,
                                  RequestTimeStamp(options_.time_stamp_url, data.signature));
      const long long stamped_s = CheckTimeStamp(data.time_stamp, data.signature, {}).time_s;
      if (const auto failure = ClockFailure(options_.time_s, stamped_s); !failure.empty())
        return BadInput(options_.role + ": " + failure + "; set the clock or --time right");
    }
    return EncodeSignedData(data);
  }

  QPDF& pdf_;
  const SigningKey& key_;
  const SignOptions& options_;
  PdfUpdate update_;
  std::string signer_, name_;  // of the certificate, and as shown
  Object signature_;
  std::string picture_bytes_;  // outlives what is copied from it
  QPDF picture_pdf_;
};

}  // namespace

Result<SignedReport> SignReport(const std::string& file, const std::string& bytes,
                                const SigningKey& key, const SignOptions& options) {
  if (!IsSigningRole(options.role))
    return Error{ErrorKind::kUsage, "the role '" + options.role +
                                        "' is none of instrument, operator, reviewer, approver"};
  TELESTRAIN_RETURN_IF_ERROR(CheckSigningKey(key, options.time_s));
  if (!bytes.starts_with("%PDF-")) return BadInput(file + ": is not a PDF");
  const OpenedPdf opened = OpenPdf(bytes);
  if (!opened.pdf) return BadInput(file + ": " + opened.failure + "; it is not signed");
  try {
    if (!IsOurs(*opened.pdf, bytes))
      return BadInput(file + ": is no report that telestrain wrote; only those are signed");
    if (const Status earlier = CheckEarlier(bytes, key, options); !earlier)
      return BadInput(file + ": " + earlier.error().message);
    if (const auto boxes = BoxesFailure(*opened.pdf); !boxes.empty())
      return BadInput(file + ": " + boxes + "; it is not signed");
    return Signing(*opened.pdf, bytes, key, options).Run();
  } catch (const std::exception& error) {  // libqpdf throws where an object is damaged
    return BadInput(file + ": the PDF is damaged: " + error.what());
  }
}

}  // namespace telestrain
