// What a signature shows in its box.

#include "report/signature/signature_picture.h"

#include <gtest/gtest.h>

#include <qpdf/Buffer.hh>
#include <qpdf/QPDF.hh>
#include <regex>

#include "pdf_tools.h"
#include "signature_pki.h"

namespace telestrain {
namespace {

SignaturePicture PictureOf(const std::string& reason, double width_pt, double height_pt) {
  return {"operator", "Zhang Wei 张伟", "2026-01-31T12:00:00Z",
          reason,     "Laboratory 2",   "0123456789abcdef0123",
          true,       width_pt,         height_pt};
}

// The numbers before an operator of the picture's content.
std::vector<double> NumbersBefore(const std::string& bytes, const std::string& operation) {
  QPDF pdf;
  pdf.processMemoryFile("picture", bytes.data(), bytes.size());
  QPDFObjectHandle page = pdf.getAllPages().at(0);
  QPDFObjectHandle content = page.getKey("/Contents");
  if (content.isArray()) content = content.getArrayItem(0);
  const auto data = content.getStreamData();
  const std::string text(reinterpret_cast<const char*>(data->getBuffer()), data->getSize());
  const std::regex number("([-0-9.]+) " + operation);
  std::vector<double> found;
  for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at)
    found.push_back(std::stod((*at)[1]));
  return found;
}

TEST(SignaturePicture, IsReadableWhateverTheReason) {
  const std::string lengthy =
      "All strains lie within the limits of the drawing; view 3 was cleaned and taken again "
      "before the last load step, and the ruler was checked twice";
  for (const std::string& reason : {std::string("Checked"), lengthy, std::string(3000, 'x')})
    for (const auto& [width_pt, height_pt] : {std::pair{142.0, 60.0}, {233.0, 30.0}}) {
      const auto drawn = DrawSignaturePicture(PictureOf(reason, width_pt, height_pt));
      ASSERT_TRUE(drawn) << drawn.error().message;
      const auto sizes_pt = NumbersBefore(*drawn, "Tf"), heights_pt = NumbersBefore(*drawn, "Tm");
      ASSERT_GE(heights_pt.size(), 4U);
      for (const double size_pt : sizes_pt) EXPECT_GE(size_pt, 5.5);
      // Descenders reach a fifth of the size below the base line.
      for (const double base_pt : heights_pt) EXPECT_GE(base_pt, 0.2 * 5.5) << reason;
    }
}

TEST(SignaturePicture, ShowsPlaceAndTheWholeOfALongReason) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  for (const auto& [width_pt, height_pt] : {std::pair{142.0, 60.0}, {233.0, 30.0}}) {
    const auto drawn =
        DrawSignaturePicture(PictureOf("Results checked by hand", width_pt, height_pt));
    ASSERT_TRUE(drawn) << drawn.error().message;
    const std::string file = WriteTestFile("picture.pdf", *drawn).string();
    const std::string text =
        RunTool(std::string(TELESTRAIN_TOOL_PDFTOTEXT) + " '" + file + "' -").output;
    for (const char* wanted : {"Laboratory 2", "Results checked by hand", "0123456789abcdef",
                               "Operator, 2026-01-31T12:00:00Z", "Demonstration key"})
      EXPECT_NE(text.find(wanted), std::string::npos) << wanted << " in " << text;
  }
}

}  // namespace
}  // namespace telestrain
