#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "base/files.h"
#include "report/audit/audit_trail.h"
#include "report/audit/verify_audit.h"
#include "report/edited_pdf.h"
#include "report/json_lookup.h"
#include "report/pdf_document.h"
#include "unit/base/scratch_folder.h"

namespace telestrain {

inline Json FileOf(const char* where, const std::string& path, const std::string& bytes) {
  return {{"of", where}, {"path", path}, {"bytes", bytes.size()}, {"sha256", Sha256Hex(bytes)}};
}

// A results folder with a trail of three steps and a report that carries the first two. The files
// are short texts: nothing here depends on what they hold.
class AuditCheckTest : public ::testing::Test {
 protected:
  AuditCheckTest() {
    std::filesystem::create_directories(Results());
    std::filesystem::create_directories(Session());
    Write(Session() / "a.png", "picture");
    Write(Results() / "session.toml", "toml");
    Write(Results() / "session.path", Session().string() + "\n");
    Write(Results() / "results.json", "{\"verdict\": \"pass\"}");
    Append("open", {FileOf("session", "a.png", "picture")},
           {FileOf("results", "session.toml", "toml")});
    Append("results", {FileOf("results", "session.toml", "toml")},
           {FileOf("results", "results.json", "{\"verdict\": \"pass\"}")});
    report_ = MakeReport();
    Write(Results() / "report.pdf", report_);
    Append("report", {FileOf("results", "results.json", "{\"verdict\": \"pass\"}")},
           {FileOf("results", "report.pdf", report_)});
  }

  std::filesystem::path Results() const { return scratch_.path() / "results"; }
  std::filesystem::path Session() const { return scratch_.path() / "session"; }
  static void Write(const std::filesystem::path& path, const std::string& bytes) {
    ASSERT_TRUE(WriteFileAtomically(path, bytes).ok());
  }
  void Append(const std::string& type, const std::vector<Json>& inputs,
              const std::vector<Json>& outputs, const Json& options = Json::object()) const {
    auto trail = AuditTrail::Open(Results() / "audit.jsonl");
    ASSERT_TRUE(trail.ok()) << trail.error().message;
    ASSERT_TRUE(
        trail->Append(type, {{"options", options}, {"inputs", inputs}, {"outputs", outputs}}, "")
            .ok());
    ASSERT_TRUE(trail->Sync().ok());
  }
  std::string Trail() const { return *ReadFile(Results() / "audit.jsonl", kMostResultBytes); }

  // Prints the hashes of what it carries (level 1b: nothing), and the head.
  std::string MakeReport(bool carries = true) const {
    auto pdf = PdfDocument::Create();
    (*pdf)->AddPage();
    double y_pt = 700;
    const auto print = [&](const std::string& name, const std::string& hash) {
      (*pdf)->DrawText({}, {50, y_pt}, name);
      (*pdf)->DrawText({Face::kMono, 8, {}}, {150, y_pt}, hash);
      y_pt -= 30;
    };
    const std::string trail = TrailOfResults(Trail());
    for (const char* name : {"session.toml", "results.json"})
      print(name, Sha256Hex(*ReadFile(Results() / name, kMostResultBytes)));
    print("audit.jsonl", Sha256Hex(trail));
    print("audit head", ReadAuditTrail("", trail)->back().hash);
    const auto attach = [&](const std::string& name, const std::string& bytes) {
      (*pdf)->Attach(
          {.name = name, .media_type = "text/plain", .description = name, .bytes = bytes});
    };
    for (const char* name : {"session.toml", "results.json"})
      if (carries) attach(name, *ReadFile(Results() / name, kMostResultBytes));
    if (carries) attach("audit.jsonl", trail);
    PdfInfo info;
    info.title = "Report";
    info.creator = "telestrain 0.1.0";
    info.created = "D:20260131000000Z";
    return *(*pdf)->Save(info, "seed");
  }

  std::string Verified(const std::filesystem::path& subject) const {
    const auto answer = VerifyAudit({subject, {}, {}, {}, {}});
    if (!answer.ok()) return "error: " + answer.error().message;
    EXPECT_TRUE(answer->line.starts_with(answer->passed ? "PASS: " : "FAIL: ")) << answer->line;
    return answer->line;
  }
  std::string VerifiedFolder() const { return Verified(Results()); }
  // What is said of the report alone after a change of the PDF.
  std::string VerifiedReport(const std::function<void(QPDF&)>& change) const {
    Write(scratch_.path() / "copy.pdf", EditedPdf(report_, change));
    return Verified(scratch_.path() / "copy.pdf");
  }
  void EditTrail(const std::function<void(std::string&)>& edit) const {
    std::string text = Trail();
    edit(text);
    Write(Results() / "audit.jsonl", text);
  }

  ScratchFolder scratch_{"telestrain_audit_check_"};
  std::string report_;
};

}  // namespace telestrain
