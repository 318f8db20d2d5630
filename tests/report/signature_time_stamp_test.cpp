// RFC 3161 time stamps, from a responder on this machine.

#include <gtest/gtest.h>

#include "report/signature/time_stamp.h"
#include "signature_reports.h"
#include "signature_responder.h"

namespace telestrain {
namespace {

using Manner = TimeStampResponder::Manner;

Result<SignedReport> SignWith(const std::string& url, const SigningKey& key) {
  SignOptions options = OptionsOf("operator");
  options.time_stamp_url = url;
  return SignReport("report.pdf", UnsignedReport(), key, options);
}

TEST(TimeStamp, IsAskedForAndChecked) {
  TimeStampResponder responder;
  const auto made = SignWith(responder.url(), Pki().operator_.ForSigning());
  ASSERT_TRUE(made) << made.error().message;
  const SignatureCheck check = Check(made->bytes);
  EXPECT_EQ(check.failure, "");
  ASSERT_EQ(check.signatures.size(), 1U);
  EXPECT_EQ(check.signatures[0].claimed_time, "2026-01-31T12:00:00Z");
  EXPECT_EQ(check.signatures[0].timestamp_time, "2026-01-31T12:01:00Z");
  const SignatureCheck more = Check(Sign(made->bytes, "reviewer"));
  EXPECT_EQ(more.failure, "");
}

TEST(TimeStamp, HasNoFreeBit) {
  TimeStampResponder responder;
  const std::string signature = "a signature";
  const std::vector<std::string> trusted = {Pki().root.Der()};
  auto token = RequestTimeStamp(responder.url(), signature);
  ASSERT_TRUE(token) << token.error().message;
  EXPECT_EQ(CheckTimeStamp(*token, signature, trusted).failure, "");
  for (std::size_t bit = 0; bit < 8 * token->size(); ++bit) {
    std::string changed = *token;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ 1 << bit % 8);
    EXPECT_NE(CheckTimeStamp(changed, signature, trusted).failure, "")
        << "bit " << bit % 8 << " of byte " << bit / 8 << " of " << token->size();
  }
}

TEST(TimeStamp, BadAnswersAreNamedAndNothingIsSigned) {
  const auto expect = [](Manner manner, const std::string& wanted) {
    TimeStampResponder responder(manner);
    const auto made = SignWith(responder.url(), Pki().operator_.ForSigning());
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().kind, ErrorKind::kOutputFailed);
    EXPECT_NE(made.error().message.find(wanted), std::string::npos) << made.error().message;
    EXPECT_NE(made.error().message.find(responder.url()), std::string::npos);
  };
  expect(Manner::kRefuses, "refused: ");
  expect(Manner::kRepeats, "does not belong to this signature");
  expect(Manner::kBabbles, "gave no answer");
  expect(Manner::kHangsUp, "gave no answer");
}

TEST(TimeStamp, OnlyHttpIsSpoken) {
  for (const char* url : {"https://127.0.0.1/tsa", "ftp://127.0.0.1/tsa", "responder", "http://"}) {
    const auto made = SignWith(url, Pki().operator_.ForSigning());
    ASSERT_FALSE(made) << url;
    EXPECT_NE(made.error().message.find("want http://host/path"), std::string::npos)
        << made.error().message;
  }
}

TEST(TimeStamp, OfAnUnknownAuthorityIsRejected) {
  TimeStampResponder responder(Manner::kForeignKey);
  const auto made = SignWith(responder.url(), Pki().operator_.ForSigning());
  ASSERT_TRUE(made) << made.error().message;
  const std::string failure = Check(made->bytes).failure;
  EXPECT_NE(failure.find("operator: time stamp: the certificate of Unknown time stamps is not "
                         "trusted"),
            std::string::npos)
      << failure;
}

TEST(TimeStamp, IsNotMoreThanADayFromTheSignersClock) {
  TimeStampResponder responder;
  SignOptions options = OptionsOf("operator");
  options.time_stamp_url = responder.url();
  options.time_s = kSigned_s + 2 * 86400;
  const auto made =
      SignReport("report.pdf", UnsignedReport(), Pki().operator_.ForSigning(), options);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("is more than a day from 2026-01-31T12:01:00Z"),
            std::string::npos)
      << made.error().message;
}

// The signer's clock says that the certificate is valid; a minute later it is not.
TEST(TimeStamp, CountsInsteadOfTheSignersClock) {
  TimeStampResponder responder;
  const Identity brief = Issue({.name = "Brief", .issuer = &Pki().root, .until_s = kSigned_s + 30});
  EXPECT_EQ(Check(Sign(UnsignedReport(), "operator", brief.ForSigning())).failure,
            "operator: its certificate has expired and no time stamp proves that it was signed "
            "before");
  const auto made = SignWith(responder.url(), brief.ForSigning());
  ASSERT_TRUE(made) << made.error().message;
  const std::string failure = Check(made->bytes).failure;
  EXPECT_NE(failure.find("Brief is not trusted: certificate has expired"), std::string::npos)
      << failure;
}

}  // namespace
}  // namespace telestrain
