// No bit of a signed report is free.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "report/signature/signed_layout.h"
#include "signature_reports.h"
#include "signature_responder.h"

namespace telestrain {
namespace {

// The report with one byte changed, put back afterwards.
class Flipper {
 public:
  explicit Flipper(std::string report) : report_(std::move(report)) {
    EXPECT_EQ(Check(report_).failure, "");
  }
  void ExpectRejected(std::size_t at, unsigned char mask) {
    const char before = report_[at];
    report_[at] = static_cast<char>(report_[at] ^ mask);
    EXPECT_NE(Check(report_).failure, "")
        << "byte " << at << " xor " << int(mask) << " in "
        << report_.substr(std::max<std::size_t>(at, 80) - 80, 160);
    report_[at] = before;
  }

 private:
  std::string report_;
};

TEST(SignatureFlips, AThousandRandomBytesOfAFourTimesSignedReport) {
  Flipper flipper(FourTimesSigned());
  std::mt19937_64 random(20260131);
  for (int i = 0; i < 1000; ++i) {
    const std::size_t at = random() % FourTimesSigned().size();
    flipper.ExpectRejected(at, static_cast<unsigned char>(1 + random() % 255));
  }
}

// The change of a hex digit into another: one of its four bits, in turn.
unsigned char MaskOf(char digit, std::size_t at) {
  static const std::string kDigits = "0123456789abcdef";
  const std::size_t value = kDigits.find(digit);
  if (value == std::string::npos) return 1;  // < and >
  return static_cast<unsigned char>(digit ^ kDigits[value ^ (1U << at % 4)]);
}

// Only its own encoding guards the last Contents: no signature covers it.
void FlipAllOfTheLastContents(const std::string& report) {
  Flipper flipper(report);
  const SignedLayout layout = ReadSignedLayout(report);
  ASSERT_FALSE(layout.signatures.empty()) << layout.failure;
  const RawSignature& last = layout.signatures.back();
  for (std::size_t at = last.gap_begin; at < last.gap_end; ++at)
    flipper.ExpectRejected(at, MaskOf(report[at], at));
}

TEST(SignatureFlips, EveryByteOfTheLastContents) { FlipAllOfTheLastContents(FourTimesSigned()); }

TEST(SignatureFlips, EveryByteOfTheLastContentsWithChainAndTimeStamp) {
  const Identity between = Issue({.name = "Division",
                                  .issuer = &Pki().root,
                                  .usage = "critical,keyCertSign",
                                  .authority = true});
  SigningKey key = Issue({.name = "Below", .issuer = &between}).ForSigning();
  key.chain = {between.Der()};
  TimeStampResponder responder;
  SignOptions options = OptionsOf("approver");
  options.time_stamp_url = responder.url();
  const auto made = SignReport("report.pdf", SignedBy(1), key, options);
  ASSERT_TRUE(made) << made.error().message;
  FlipAllOfTheLastContents(made->bytes);
}

}  // namespace
}  // namespace telestrain
