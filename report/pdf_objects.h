#pragma once

// Included by the pdf_*.cpp files only: libharu stays inside them.

#include <hpdf.h>
#include <hpdf_doc.h>
#include <hpdf_objects.h>

#include <initializer_list>
#include <string>

namespace telestrain {

// Makes the objects of a PDF that libharu 2.3.0 has no calls for, through its object interface. The
// first failure (no memory) stays and makes the rest do nothing useful; the caller asks once, at
// the end. Texts are UTF-8 and are written as ASCII or UTF-16, numbers with 5 decimals.
class PdfObjects {
 public:
  explicit PdfObjects(HPDF_Doc document) : document_(document) {}

  bool ok() const { return ok_; }
  void Require(bool done) { ok_ = ok_ && done; }

  // With an object number of its own, so that several others can refer to it.
  HPDF_Dict MakeDictionary();
  // Inside the one object that it is added to.
  HPDF_Dict MakeDirectDictionary();
  HPDF_Array MakeArray();
  HPDF_Array MakeNumbers(std::initializer_list<double> values);
  HPDF_Dict MakeStream(const std::string& bytes, bool compressed);
  void WriteStream(HPDF_Dict stream, const std::string& bytes);  // behind what it holds
  void* MakeText(const std::string& utf8);
  void* MakeBytes(const std::string& bytes);
  // [page /XYZ null top null]: libharu's own destinations force a zoom factor upon the reader.
  HPDF_Array MakeDestination(HPDF_Page page, double top_pt);

  void Set(HPDF_Dict dictionary, const char* key, void* object);
  void SetName(HPDF_Dict dictionary, const char* key, const char* name);
  void SetNumber(HPDF_Dict dictionary, const char* key, int number);
  void SetTrue(HPDF_Dict dictionary, const char* key);
  void SetText(HPDF_Dict dictionary, const char* key, const std::string& utf8);
  void Append(HPDF_Array array, void* object);
  void AppendNumber(HPDF_Array array, int number);
  // Adds to the array `key` of the dictionary, which is made when it is missing.
  void AppendTo(HPDF_Dict dictionary, const char* key, void* object);
  // Raw operators behind what the page holds.
  void Write(HPDF_Page page, const std::string& operators);

 private:
  template <class Object>
  Object Made(Object object) {
    ok_ = ok_ && object != nullptr;
    return object;
  }
  void RequireOk(HPDF_STATUS status) { Require(status == HPDF_OK); }

  HPDF_Doc document_;
  bool ok_ = true;
};

}  // namespace telestrain
