// Loading keys and certificates.

#include <gtest/gtest.h>

#include "signature_reports.h"

namespace telestrain {
namespace {

Result<SigningKey> Load(const std::vector<std::string>& files, const std::string& password = "") {
  KeySources sources;
  sources.sources = files;
  sources.password = [password](const std::string& source) -> Result<std::string> {
    if (password.empty()) return BadInput(source + ": no password here");
    return password;
  };
  return LoadSigningKey(sources);
}

void ExpectRefused(const Result<SigningKey>& key, const std::string& wanted) {
  ASSERT_FALSE(key);
  EXPECT_NE(key.error().message.find(wanted), std::string::npos) << key.error().message;
}

std::string PemFile(const std::string& name, const std::string& text) {
  return WriteTestFile(name, text).string();
}

TEST(SigningKey, ComesFromPkcs12WithAPassword) {
  const Identity& signer = Pki().operator_;
  const std::string file = PemFile("operator.p12", Pkcs12(signer, Pki().root, "geheim"));
  const auto key = Load({file}, "geheim");
  ASSERT_TRUE(key) << key.error().message;
  EXPECT_EQ(key->certificate, signer.Der());
  EXPECT_TRUE(key->chain.empty());  // the root is for the verifier to have
  EXPECT_EQ(Check(Sign(UnsignedReport(), "operator", *key)).failure, "");
  ExpectRefused(Load({file}, "falsch"), "the password is wrong");
  ExpectRefused(Load({file}), "no password here");
}

TEST(SigningKey, ComesFromPemFilesLockedOrNot) {
  const Identity& signer = Pki().reviewer;
  const std::string cert = PemFile("reviewer.pem", signer.Pem());
  EXPECT_TRUE(Load({PemFile("reviewer.key", signer.KeyPem()), cert}));
  const std::string locked = PemFile("locked.key", signer.KeyPem("geheim"));
  EXPECT_TRUE(Load({locked, cert}, "geheim"));
  ExpectRefused(Load({locked, cert}, "falsch"), "cannot be unlocked");
}

TEST(SigningKey, BringsTheAuthoritiesBetweenItAndTheRoot) {
  const Identity between = Issue({.name = "Division",
                                  .issuer = &Pki().root,
                                  .usage = "critical,keyCertSign",
                                  .authority = true});
  const Identity signer = Issue({.name = "Below", .issuer = &between});
  const auto key = Load({PemFile("below.key", signer.KeyPem()), PemFile("below.pem", signer.Pem()),
                         PemFile("chain.pem", between.Pem() + Pki().root.Pem())});
  ASSERT_TRUE(key) << key.error().message;
  EXPECT_EQ(key->chain, std::vector<std::string>{between.Der()});
  const std::string report = Sign(UnsignedReport(), "operator", *key);
  EXPECT_EQ(Check(report).failure, "");
  // Nothing vouches for the authority when only the signer is trusted.
  const auto check = CheckSignatures(report, {{PemFile("below_only.pem", signer.Pem())}, {}});
  ASSERT_TRUE(check);
  EXPECT_NE(check->failure.find("Division came with it but is no part"), std::string::npos)
      << check->failure;
}

TEST(SigningKey, MustBelongToTheCertificate) {
  ExpectRefused(
      Load({PemFile("a.key", Pki().operator_.KeyPem()), PemFile("b.pem", Pki().reviewer.Pem())}),
      "none of the 1 certificates belongs to the private key");
  ExpectRefused(Load({PemFile("b.pem", Pki().reviewer.Pem())}), "0 found");
  ExpectRefused(Load({"/nonexistent/key.pem"}), "/nonexistent/key.pem: cannot be read");
  ExpectRefused(Load({PemFile("text.pem", "no key\n")}), "has no key and no certificate");
}

TEST(SigningKey, MustBeOfAKindThatReadersVerify) {
  const auto load = [](const std::string& kind) {
    const Identity signer = Issue({.name = "Odd", .key = kind});
    return Load({PemFile("odd.key", signer.KeyPem()), PemFile("odd.pem", signer.Pem())});
  };
  ExpectRefused(load("RSA1024"), "has 1024 bit; want 2048");
  ExpectRefused(load("ED25519"), "of the kind ED25519; PDF readers verify RSA");
  ExpectRefused(load("P-521"), "on secp521r1");
}

}  // namespace
}  // namespace telestrain
