#pragma once

#include <map>
#include <qpdf/QPDFObjectHandle.hh>
#include <string>

namespace telestrain {

// An incremental update of a PDF that adds one signature: the objects that changed, those that were
// made with libqpdf since, the signature's value, a cross-reference table and a trailer.
class PdfUpdate {
 public:
  // `bytes` is what `pdf` was read from; both must outlive the update.
  PdfUpdate(QPDF& pdf, const std::string& bytes);

  // The object, or the one it stands in, is to be written again.
  void Touch(QPDFObjectHandle object) { touched_[object.getObjectID()] = object; }
  bool IsNew(QPDFObjectHandle object) const { return object.getObjectID() > old_highest_; }

  // The file with room for the signature's DER.
  struct Prepared {
    std::string bytes;
    std::size_t gap_begin = 0, gap_end = 0;
    std::string SignedBytes() const { return bytes.substr(0, gap_begin) + bytes.substr(gap_end); }
  };
  Prepared Write(QPDFObjectHandle signature, const std::string& entries,
                 std::size_t reserve_bytes) const;

 private:
  QPDF& pdf_;
  const std::string& old_bytes_;
  int old_highest_;
  std::map<int, QPDFObjectHandle> touched_;
};

}  // namespace telestrain
