// The chain of an audit trail: what it holds, and that no change of it goes unseen.
#include "report/audit/audit_trail.h"

#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <openssl/pem.h>

#include <fstream>
#include <functional>

#include "base/files.h"
#include "unit/base/scratch_folder.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTime = "2026-01-01";

std::string TextOf(BIO* bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio, &data);
  return {data, static_cast<std::size_t>(size)};
}

// A new key of this kind in PEM: private, public.
std::pair<std::string, std::string> NewKey(const char* kind) {
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(
      EVP_PKEY_Q_keygen(nullptr, nullptr, kind), &EVP_PKEY_free);
  const std::unique_ptr<BIO, decltype(&BIO_free)> secret(BIO_new(BIO_s_mem()), &BIO_free);
  const std::unique_ptr<BIO, decltype(&BIO_free)> open(BIO_new(BIO_s_mem()), &BIO_free);
  PEM_write_bio_PrivateKey(secret.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  PEM_write_bio_PUBKEY(open.get(), key.get());
  return {TextOf(secret.get()), TextOf(open.get())};
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1)
    lines.push_back(text.substr(begin, text.find('\n', begin) - begin));
  return lines;
}

std::string Joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

class AuditTrailTest : public ::testing::Test {
 protected:
  fs::path File() const { return scratch_.path() / "audit.jsonl"; }
  fs::path KeyFile(const std::string& pem) const {
    std::ofstream(scratch_.path() / "key.pem") << pem;
    return scratch_.path() / "key.pem";
  }
  // Appends entries of these types, whose bodies have the index.
  void Write(const std::vector<std::string>& types, const fs::path& key = {}) const {
    auto trail = AuditTrail::Open(File(), key);
    ASSERT_TRUE(trail.ok()) << trail.error().message;
    for (std::size_t i = 0; i < types.size(); ++i)
      ASSERT_TRUE(trail->Append(types[i], {{"value", 1200.5 + static_cast<double>(i)}}, kTime));
    ASSERT_TRUE(trail->Sync().ok());
  }
  std::string Text() const { return *ReadFile(File(), kMostResultBytes); }
  // What is said of the trail after `change` of its lines.
  std::string ReasonAfter(const std::function<void(std::vector<std::string>&)>& change) const {
    auto lines = LinesOf(Text());
    change(lines);
    const auto read = ReadAuditTrail("t", Joined(lines));
    return read.ok() ? "none" : read.error().message;
  }

  ScratchFolder scratch_{"telestrain_audit_trail_"};
};

TEST_F(AuditTrailTest, ALineIsItsEntryWithSortedKeysAndNoBlanks) {
  auto trail = AuditTrail::Open(File());
  ASSERT_TRUE(trail->Append("detect", {{"b", 1}, {"a", {{"z", nullptr}, {"y", 0.1}}}}, "").ok());
  ASSERT_TRUE(trail->Sync().ok());
  const std::string entry = R"({"body":{"a":{"y":0.1,"z":null},"b":1},"prev":")" +
                            std::string(64, '0') +
                            R"(","seq":0,"time":null,"type":"detect","v":1})";
  EXPECT_EQ(Text(),
            R"({"entry":)" + entry + R"(,"hash":")" + Sha256Hex(entry) + R"(","sig":null})" + "\n");
  EXPECT_EQ(trail->head(), Sha256Hex(entry));
}

TEST_F(AuditTrailTest, EntriesReadBackAndFollowEachOther) {
  Write({"open", "detect"});
  Write({"calibrate"});
  const auto trail = AuditTrail::Open(File());
  ASSERT_TRUE(trail.ok());
  ASSERT_EQ(trail->entries().size(), 3u);
  EXPECT_EQ(trail->entries()[0].type, "open");
  EXPECT_EQ(trail->entries()[2].prev, trail->entries()[1].hash);
  EXPECT_EQ(trail->entries()[2].body.at("value"), 1200.5);
  EXPECT_EQ(trail->entries()[2].time, kTime);
  EXPECT_EQ(trail->head(), trail->entries()[2].hash);
}

TEST_F(AuditTrailTest, ATrailThatDoesNotExistIsEmpty) {
  const auto trail = AuditTrail::Open(File());
  ASSERT_TRUE(trail.ok());
  EXPECT_TRUE(trail->entries().empty());
  EXPECT_EQ(trail->head(), std::string(64, '0'));
  EXPECT_FALSE(fs::exists(File()));
}

TEST_F(AuditTrailTest, OnlyTheLatestEntryOfATypeIsRepeated) {
  auto trail = AuditTrail::Open(File());
  ASSERT_TRUE(trail->Append("render", {{"a", 1}, {"b", 2}}, "").ok());
  ASSERT_TRUE(trail->Append("report", {{"a", 3}}, "").ok());
  EXPECT_TRUE(trail->Repeats("render", {{"b", 2}, {"a", 1}}));
  EXPECT_FALSE(trail->Repeats("render", {{"a", 1}}));
  EXPECT_FALSE(trail->Repeats("measure", {{"a", 1}}));
  ASSERT_TRUE(trail->Append("render", {{"a", 9}}, "").ok());
  EXPECT_FALSE(trail->Repeats("render", {{"a", 1}, {"b", 2}}));
}

TEST_F(AuditTrailTest, EveryChangeOfALineIsSeenAndTheLineNamed) {
  Write({"open", "detect", "calibrate", "verify"});
  EXPECT_EQ(ReasonAfter([](auto&) {}), "none");
  EXPECT_EQ(
      ReasonAfter([](auto& lines) { lines[1].replace(lines[1].find("1201.5"), 6, "1300.5"); }),
      "t: line 2 was changed: its entry has another hash than the line says");
  EXPECT_EQ(ReasonAfter([](auto& lines) { lines.erase(lines.begin() + 2); }),
            "t: line 3 has number 3 where 2 follows: a line was taken out, put in or moved");
  EXPECT_EQ(ReasonAfter([](auto& lines) { std::swap(lines[1], lines[2]); }),
            "t: line 2 has number 2 where 1 follows: a line was taken out, put in or moved");
  EXPECT_EQ(ReasonAfter([](auto& lines) { lines.insert(lines.begin() + 1, lines[0]); }),
            "t: line 2 has number 0 where 1 follows: a line was taken out, put in or moved");
  EXPECT_EQ(ReasonAfter([](auto& lines) { lines[3].replace(1, 1, " \""); }),
            "t: line 4 is not written as this program writes an entry");
  EXPECT_EQ(ReasonAfter([](auto& lines) { lines[0] = "nonsense"; }), "t: line 1 is not JSON");
  EXPECT_EQ(ReasonAfter([](auto& lines) { lines[0] = "{}"; }),
            "t: line 1 is no entry of an audit trail, version 1");
}

// Whoever makes the changed line's hash anew breaks the next one's `prev`.
TEST_F(AuditTrailTest, ARewrittenLineDoesNotFitTheNext) {
  Write({"open", "detect", "calibrate"});
  EXPECT_EQ(ReasonAfter([](auto& lines) {
              const std::size_t end = lines[1].find(",\"hash\"");
              std::string entry = lines[1].substr(9, end - 9);
              entry.replace(entry.find("1201.5"), 6, "1300.5");
              lines[1] =
                  R"({"entry":)" + entry + R"(,"hash":")" + Sha256Hex(entry) + R"(","sig":null})";
            }),
            "t: line 3 does not follow the line before it: one of the two was exchanged");
}

TEST_F(AuditTrailTest, EveryFlippedByteIsSeen) {
  Write({"open", "detect"});
  const std::string text = Text();
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_FALSE(ReadAuditTrail("t", changed).ok()) << "byte " << i;
  }
}

// A shortened trail is a trail: only its head tells, which the report prints.
TEST_F(AuditTrailTest, TruncationChangesTheHead) {
  Write({"open", "detect", "calibrate"});
  const std::string head = AuditTrail::Open(File())->head();
  auto lines = LinesOf(Text());
  lines.pop_back();
  const auto shorter = ReadAuditTrail("t", Joined(lines));
  ASSERT_TRUE(shorter.ok());
  EXPECT_NE(shorter->back().hash, head);
}

TEST_F(AuditTrailTest, ATornLastLineIsDroppedAndWrittenOver) {
  Write({"open", "detect"});
  const std::string whole = Text();
  std::ofstream(File(), std::ios::app) << R"({"entry":{"body":)";
  const auto read = ReadAuditTrail("t", Text());
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(read.error().message,
            "t: line 3 is cut short: the program was ended while it wrote it");
  EXPECT_EQ(AuditTrail::Open(File())->entries().size(), 2u);
  Write({"calibrate"});
  EXPECT_TRUE(Text().starts_with(whole));
  EXPECT_EQ(ReadAuditTrail("t", Text())->size(), 3u);
}

TEST_F(AuditTrailTest, LinesAreSignedWithTheKeyAndCheckedByItsPublicHalf) {
  const auto [secret, open] = NewKey("ED25519");
  Write({"open", "detect"}, KeyFile(secret));
  ASSERT_TRUE(ReadAuditTrail("t", Text(), open).ok());
  const std::string other = NewKey("ED25519").second;
  EXPECT_EQ(ReadAuditTrail("t", Text(), other).error().message,
            "t: line 1 is not signed by this key");
  auto lines = LinesOf(Text());
  const std::size_t signature = lines[1].find("\"sig\":\"") + 7;
  lines[1].replace(signature, 4, lines[1].substr(signature, 4) == "AAAA" ? "BBBB" : "AAAA");
  EXPECT_EQ(ReadAuditTrail("t", Joined(lines), open).error().message,
            "t: line 2 is not signed by this key");
  lines[1].replace(lines[1].find("\"sig\":") + 6, std::string::npos, "null}");
  EXPECT_EQ(ReadAuditTrail("t", Joined(lines), open).error().message, "t: line 2 is not signed");
}

TEST_F(AuditTrailTest, ALogOfAnotherKeyIsNotContinued) {
  Write({"open"}, KeyFile(NewKey("ED25519").first));
  const auto trail = AuditTrail::Open(File(), KeyFile(NewKey("ED25519").first));
  ASSERT_FALSE(trail.ok());
  EXPECT_EQ(trail.error().message, File().string() + ": line 1 is not signed by this key");
}

TEST_F(AuditTrailTest, AKeyOfAnotherKindIsRefused) {
  for (const std::string& pem : {NewKey("X25519").first, std::string("no key")}) {
    const auto trail = AuditTrail::Open(File(), KeyFile(pem));
    ASSERT_FALSE(trail.ok());
    EXPECT_NE(trail.error().message.find("is no Ed25519 key in PEM"), std::string::npos);
  }
}

TEST_F(AuditTrailTest, WhatAReportCarriesEndsWithItsResults) {
  Write({"open", "results", "report", "results", "report", "sign"});
  auto lines = LinesOf(Text());
  lines.resize(4);
  EXPECT_EQ(TrailOfResults(Text()), Joined(lines));
  lines.resize(1);
  EXPECT_EQ(TrailOfResults(Joined(lines)), Joined(lines));
}

TEST_F(AuditTrailTest, TextThatJsonCannotHoldIsMarked) {
  auto trail = AuditTrail::Open(File());
  ASSERT_TRUE(trail->Append("detect", {{"path", "a\xff.png"}}, "").ok());
  ASSERT_TRUE(trail->Sync().ok());
  EXPECT_EQ(ReadAuditTrail("t", Text())->front().body.at("path"), "a\xef\xbf\xbd.png");
}

TEST_F(AuditTrailTest, DeepNestingIsRefusedBeforeItCostsTheStack) {
  const std::string deep(2000000, '[');
  EXPECT_EQ(ReadAuditTrail("t", deep + "\n").error().message,
            "t: line 1 is nested deeper than 64 brackets");
}

}  // namespace
}  // namespace telestrain
