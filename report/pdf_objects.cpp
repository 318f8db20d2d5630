#include "report/pdf_objects.h"

#include <hpdf_pages.h>

#include <algorithm>

#include "report/unicode_text.h"

namespace telestrain {
namespace {

static_assert(HPDF_VERSION_ID == 20300, "the object interface below is that of libharu 2.3.0");

constexpr unsigned kHighSurrogate = 0xD800, kLowSurrogate = 0xDC00;

void AppendUtf16(std::string& bytes, unsigned unit) {
  bytes.push_back(static_cast<char>(unit >> 8));
  bytes.push_back(static_cast<char>(unit & 0xFF));
}

// PDF 32000-1, 7.9.2.2: a text string that is not ASCII begins with a byte order mark.
std::string Utf16(const std::string& utf8) {
  std::string bytes = "\xFE\xFF";
  for (const char32_t point : CodePoints(utf8)) {
    const unsigned value = point;
    if (value < 0x10000) {
      AppendUtf16(bytes, value);
    } else {
      AppendUtf16(bytes, kHighSurrogate + ((value - 0x10000) >> 10));
      AppendUtf16(bytes, kLowSurrogate + ((value - 0x10000) & 0x3FF));
    }
  }
  return bytes;
}

bool IsPrintableAscii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 32 && c < 127; });
}

}  // namespace

HPDF_Dict PdfObjects::MakeDictionary() {
  HPDF_Dict dictionary = MakeDirectDictionary();
  if (dictionary) RequireOk(HPDF_Xref_Add(document_->xref, dictionary));
  return dictionary;
}

HPDF_Dict PdfObjects::MakeDirectDictionary() { return Made(HPDF_Dict_New(document_->mmgr)); }

HPDF_Array PdfObjects::MakeArray() { return Made(HPDF_Array_New(document_->mmgr)); }

HPDF_Array PdfObjects::MakeNumbers(std::initializer_list<double> values) {
  HPDF_Array array = MakeArray();
  for (const double value : values)
    if (ok_) RequireOk(HPDF_Array_AddReal(array, static_cast<HPDF_REAL>(value)));
  return array;
}

HPDF_Dict PdfObjects::MakeStream(const std::string& bytes, bool compressed) {
  HPDF_Dict stream = Made(HPDF_DictStream_New(document_->mmgr, document_->xref));
  if (!stream) return nullptr;
  stream->filter = compressed ? HPDF_STREAM_FILTER_FLATE_DECODE : HPDF_STREAM_FILTER_NONE;
  WriteStream(stream, bytes);
  return stream;
}

void PdfObjects::WriteStream(HPDF_Dict stream, const std::string& bytes) {
  if (!ok_ || bytes.empty()) return;
  RequireOk(HPDF_Stream_Write(stream->stream, reinterpret_cast<const HPDF_BYTE*>(bytes.data()),
                              static_cast<HPDF_UINT>(bytes.size())));
}

void* PdfObjects::MakeText(const std::string& utf8) {
  if (!IsPrintableAscii(utf8)) return MakeBytes(Utf16(utf8));
  return Made(HPDF_String_New(document_->mmgr, utf8.c_str(), nullptr));
}

void* PdfObjects::MakeBytes(const std::string& bytes) {
  auto* data = reinterpret_cast<HPDF_BYTE*>(const_cast<char*>(bytes.data()));  // copied, not kept
  return Made(HPDF_Binary_New(document_->mmgr, data, static_cast<HPDF_UINT>(bytes.size())));
}

HPDF_Array PdfObjects::MakeDestination(HPDF_Page page, double top_pt) {
  HPDF_Array target = MakeArray();
  Append(target, page);
  if (ok_) RequireOk(HPDF_Array_AddName(target, "XYZ"));
  Append(target, Made(HPDF_Null_New(document_->mmgr)));
  if (ok_) RequireOk(HPDF_Array_AddReal(target, static_cast<HPDF_REAL>(top_pt)));
  Append(target, Made(HPDF_Null_New(document_->mmgr)));
  return target;
}

void PdfObjects::Set(HPDF_Dict dictionary, const char* key, void* object) {
  if (ok_) RequireOk(HPDF_Dict_Add(dictionary, key, object));
}

void PdfObjects::SetName(HPDF_Dict dictionary, const char* key, const char* name) {
  if (ok_) RequireOk(HPDF_Dict_AddName(dictionary, key, name));
}

void PdfObjects::SetNumber(HPDF_Dict dictionary, const char* key, int number) {
  if (ok_) RequireOk(HPDF_Dict_AddNumber(dictionary, key, number));
}

void PdfObjects::SetTrue(HPDF_Dict dictionary, const char* key) {
  if (ok_) RequireOk(HPDF_Dict_AddBoolean(dictionary, key, HPDF_TRUE));
}

void PdfObjects::SetText(HPDF_Dict dictionary, const char* key, const std::string& utf8) {
  Set(dictionary, key, MakeText(utf8));
}

void PdfObjects::Append(HPDF_Array array, void* object) {
  if (ok_) RequireOk(HPDF_Array_Add(array, object));
}

void PdfObjects::AppendNumber(HPDF_Array array, int number) {
  if (ok_) RequireOk(HPDF_Array_AddNumber(array, number));
}

void PdfObjects::AppendTo(HPDF_Dict dictionary, const char* key, void* object) {
  if (!ok_) return;
  auto* array = static_cast<HPDF_Array>(HPDF_Dict_GetItem(dictionary, key, HPDF_OCLASS_ARRAY));
  if (!array) {
    array = MakeArray();
    Set(dictionary, key, array);
  }
  Append(array, object);
}

void PdfObjects::Write(HPDF_Page page, const std::string& operators) {
  if (!ok_) return;
  auto* attributes = static_cast<HPDF_PageAttr>(page->attr);
  RequireOk(HPDF_Stream_WriteStr(attributes->stream, operators.c_str()));
}

}  // namespace telestrain
