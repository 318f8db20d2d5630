// The encodings below a signature.

#include <gtest/gtest.h>

#include "report/signature/der.h"
#include "report/signature/signed_layout.h"
#include "report/signature/utc_time.h"

namespace telestrain {
namespace {

TEST(Der, WritesTheShortestLengthAndReadsItBack) {
  for (const std::size_t size : {0UL, 1UL, 127UL, 128UL, 255UL, 256UL, 65535UL, 65536UL}) {
    const std::string content(size, 'x');
    const std::string der = Der(kDerOctets, content);
    const std::size_t header = size < 128 ? 2 : size < 256 ? 3 : size < 65536 ? 4 : 5;
    EXPECT_EQ(der.size(), size + header);
    EXPECT_EQ(DerLength(der + "more"), der.size());
    const auto node = ReadDer(der);
    ASSERT_TRUE(node);
    EXPECT_EQ(node->tag, kDerOctets);
    EXPECT_EQ(node->content, content);
  }
}

TEST(Der, RefusesWhatIsCutShortOrHasNoLength) {
  const std::string der = Der(kDerSequence, Der(kDerInteger, "1") + Der(kDerOctets, "content"));
  for (std::size_t size = 0; size < der.size(); ++size) {
    EXPECT_FALSE(ReadDer(der.substr(0, size))) << size;
    EXPECT_EQ(DerLength(der.substr(0, size)), 0U) << size;
  }
  EXPECT_FALSE(ReadDer(der + "x"));
  EXPECT_EQ(DerLength(std::string("\x30\x80\x00\x00", 4)), 0U);  // indefinite
}

TEST(Der, OrdersASet) {
  EXPECT_EQ(DerSetOf(kDerSet, {"\x04\x01\xFF", "\x04\x01\x01", "\x02\x01\x05"}),
            std::string("\x31\x09\x02\x01\x05\x04\x01\x01\x04\x01\xFF"));
}

TEST(UtcTime, ReadsIsoTimesAndWritesThem) {
  EXPECT_EQ(ParseIsoTime("2026-01-31T12:00:00Z"), 1769860800);
  EXPECT_EQ(ParseIsoTime("2026-01-31T13:00:00+01:00"), 1769860800);
  EXPECT_EQ(ParseIsoTime("2026-01-31T06:30-05:30"), 1769860800);
  EXPECT_EQ(ParseIsoTime("2026-01-31"), 1769860800 - 43200);
  for (const char* bad : {"", "yesterday", "2026-02-30", "2026-01-31T25:00", "2026-01-31 12:00"})
    EXPECT_FALSE(ParseIsoTime(bad)) << bad;
  EXPECT_EQ(IsoTime(1769860800), "2026-01-31T12:00:00Z");
  EXPECT_EQ(PdfTime(1769860800), "D:20260131120000Z");
  EXPECT_EQ(ParsePdfTime("D:20260131120000Z"), 1769860800);
  EXPECT_FALSE(ParsePdfTime("D:20260131120000+00'00'"));
}

TEST(SignedLayout, AFileWithoutSignaturesHasNone) {
  EXPECT_EQ(ReadSignedLayout("").failure, "");
  EXPECT_TRUE(ReadSignedLayout("%PDF-1.7\n").signatures.empty());
  // A ByteRange that is spelled otherwise is the trace of a signature that was tampered with.
  EXPECT_NE(ReadSignedLayout("/ByteRange[0 1 2 3]").failure, "");
  EXPECT_NE(ReadSignedLayout("/ByteRange [0 1 2 3").failure, "");
}

TEST(SignedLayout, ByteRangeHasOneWidth) {
  EXPECT_EQ(ByteRangeText(1, 2, 3).size(), ByteRangeText(99999999, 999999999, 9999999999).size());
}

}  // namespace
}  // namespace telestrain
