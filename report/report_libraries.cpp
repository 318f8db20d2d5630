#include "report/report_libraries.h"

#include <hpdf.h>
#include <libxml/parser.h>
#include <libxml/xmlversion.h>
#include <openssl/crypto.h>
#include <openssl/opensslv.h>
#include <png.h>
#include <qpdf/DLL.h>
#include <zlib.h>

#include <qpdf/QPDF.hh>

#include "base/numbers.h"

namespace telestrain {
namespace {

// libxml2 says "20914", or "20914-GITv2.9.14", for 2.9.14.
std::string Dotted(const std::string& number) {
  const auto value = ParseInt(number.substr(0, number.find('-')));
  if (!value) return number;
  return std::to_string(*value / 10000) + "." + std::to_string(*value / 100 % 100) + "." +
         std::to_string(*value % 100);
}

}  // namespace

std::vector<LibraryVersion> ReportLibraries() {
  return {{"libharu", HPDF_VERSION_TEXT, HPDF_GetVersion()},
          {"libpng", PNG_LIBPNG_VER_STRING, png_get_libpng_ver(nullptr)},
          {"libxml2", LIBXML_DOTTED_VERSION, Dotted(xmlParserVersion)},
          {"OpenSSL", OPENSSL_VERSION_STR, OpenSSL_version(OPENSSL_VERSION_STRING)},
          {"qpdf", QPDF_VERSION, QPDF::QPDFVersion()},
          {"zlib", ZLIB_VERSION, zlibVersion()}};
}

}  // namespace telestrain
