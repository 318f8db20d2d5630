#include "report/signature/pdf_update.h"

#include <algorithm>
#include <qpdf/Buffer.hh>
#include <qpdf/QPDF.hh>

#include "base/files.h"
#include "report/signature/certificate.h"
#include "report/signature/signed_layout.h"

namespace telestrain {
namespace {

std::string TextOf(QPDFObjectHandle object) {
  if (!object.isStream()) return object.unparseResolved();
  const auto data = object.getRawStreamData();
  QPDFObjectHandle dictionary = object.getDict().shallowCopy();
  dictionary.replaceKey("/Length",
                        QPDFObjectHandle::newInteger(static_cast<long long>(data->getSize())));
  return dictionary.unparse() + "\nstream\n" +
         std::string(reinterpret_cast<const char*>(data->getBuffer()), data->getSize()) +
         "\nendstream";
}

}  // namespace

PdfUpdate::PdfUpdate(QPDF& pdf, const std::string& bytes)
    : pdf_(pdf), old_bytes_(bytes), old_highest_(static_cast<int>(pdf.getObjectCount())) {}

PdfUpdate::Prepared PdfUpdate::Write(QPDFObjectHandle signature, const std::string& entries,
                                     std::size_t reserve_bytes) const {
  auto objects = touched_;
  int highest = old_highest_;
  for (QPDFObjectHandle object : pdf_.getAllObjects()) {
    highest = std::max(highest, object.getObjectID());
    if (IsNew(object)) objects[object.getObjectID()] = object;
  }
  objects.erase(signature.getObjectID());
  UpdateTail tail;
  tail.size = highest + 1;
  tail.root = pdf_.getRoot().unparse();
  Prepared prepared;
  prepared.bytes = old_bytes_;
  const auto append = [&](int number, const std::string& text) {
    tail.offsets[number] = prepared.bytes.size();
    prepared.bytes += text;
  };
  for (const auto& [number, object] : objects) append(number, ObjectText(number, TextOf(object)));
  // Last, as ReadSignedLayout expects.
  const SignatureRoom room = MakeSignatureRoom(signature.getObjectID(), entries, reserve_bytes);
  const std::size_t begin = prepared.bytes.size();
  append(signature.getObjectID(), room.text);
  QPDFObjectHandle trailer = pdf_.getTrailer();
  if (trailer.hasKey("/Info")) tail.info = trailer.getKey("/Info").unparse();
  tail.previous = LastTable(old_bytes_);
  tail.first_id = HexOf(trailer.getKey("/ID").getArrayItem(0).getStringValue());
  tail.second_id = Sha256Hex(prepared.bytes).substr(0, 32);
  prepared.bytes += TailText(tail, prepared.bytes.size());
  prepared.gap_begin = begin + room.gap_begin;
  prepared.gap_end = begin + room.gap_end;
  const std::string range =
      ByteRangeText(prepared.gap_begin, prepared.gap_end, prepared.bytes.size());
  prepared.bytes.replace(begin + room.range_begin, range.size(), range);
  return prepared;
}

}  // namespace telestrain
