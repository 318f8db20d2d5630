#include <CLI/CLI.hpp>

#include "app/audit_replay.h"
#include "app/command.h"
#include "base/value_names.h"
#include "report/audit/tell_audit.h"
#include "report/audit/verify_audit.h"
#include "report/signature/certificate.h"

// clang-format off
// telestrain audit verify results
//   PASS: 9 steps chained, 25 files unchanged, 21 inputs unchanged; report.pdf: 5 attachments as printed, not signed
// telestrain audit replay results
//   PASS: 7 steps repeated, 25 files equal to the byte
// telestrain audit show results
//     1  The session was opened, "Acceptance of the array", from 21 files; made inputs.json, session.toml (telestrain 0.1.0).
//   …
// clang-format on

namespace telestrain {
namespace {

class AuditCommand : public Command {
 public:
  std::string Name() const override { return "audit"; }
  std::string Summary() const override {
    return "check what was recorded of results and report, repeat it, or tell it";
  }
  std::string Example() const override {
    return "telestrain audit verify results/report.pdf --trust laboratory.pem";
  }
  void AddOptions(CLI::App& app) override {
    app.require_subcommand(1);
    AddVerify(*app.add_subcommand("verify",
                                  "PASS or FAIL in one line: chain, files, inputs, "
                                  "attachments, signatures (exit 0 or 1)"));
    AddReplay(*app.add_subcommand("replay", "run the recorded steps again and compare every byte"));
    show_ = app.add_subcommand("show", "tell in plain words what was done");
    show_->add_option("WHAT", subject_, "results folder, report.pdf or the instrument's log")
        ->type_name(kPath)
        ->required();
  }
  Result<int> Run(Console& console) override {
    if (verify_->parsed()) return Verify(console);
    if (replay_->parsed()) return ReplayAudit(replay_choices_, console);
    TELESTRAIN_ASSIGN_OR_RETURN(const auto lines, TellAuditOf(subject_));
    for (const std::string& line : lines) console.Say(line);
    return 0;
  }

 private:
  void AddVerify(CLI::App& app) {
    verify_ = &app;
    app.add_option("WHAT", question_.subject,
                   "report.pdf, results folder or the instrument's log (.jsonl)")
        ->type_name(kPath)
        ->required();
    app.add_option("--trust", trusted_,
                   "certificates in PEM, roots or the signers' own, whose signatures count")
        ->type_name(kFile)
        ->envname("TELESTRAIN_TRUST");
    app.add_option("--require", question_.trust.required_roles,
                   "role that must have signed; may be repeated")
        ->check(CLI::IsMember({"instrument", "operator", "reviewer", "approver"}));
    app.add_option("--session", question_.session,
                   "the session folder (default: where session.path says)")
        ->type_name(kFolder);
    app.add_option("--log", question_.log, "the instrument's log, which must tell of the results")
        ->type_name(kFile);
    app.add_option("--public-key", question_.public_key,
                   "key in PEM by which every line of the log must be signed")
        ->type_name(kFile);
  }
  void AddReplay(CLI::App& app) {
    replay_ = &app;
    app.add_option("RESULTS", replay_choices_.results, "results folder")
        ->type_name(kFolder)
        ->required();
    app.add_option("--session", replay_choices_.session,
                   "the session folder (default: where session.path says)")
        ->type_name(kFolder);
    app.add_option("--keep", replay_choices_.keep, "new folder to keep what is made again")
        ->type_name(kFolder);
  }
  Result<int> Verify(Console& console) {
    question_.trust.certificates.assign(trusted_.begin(), trusted_.end());
    if (const auto read = ReadCertificates(question_.trust.certificates); !read)
      return read.error();
    TELESTRAIN_ASSIGN_OR_RETURN(const AuditAnswer answer, VerifyAudit(question_));
    console.Say(answer.line);
    return answer.passed ? 0 : 1;
  }

  CLI::App *verify_ = nullptr, *replay_ = nullptr, *show_ = nullptr;
  AuditQuestion question_;
  std::vector<std::string> trusted_;
  ReplayChoices replay_choices_;
  std::string subject_;
};

}  // namespace

std::unique_ptr<Command> MakeAuditCommand() { return std::make_unique<AuditCommand>(); }

}  // namespace telestrain
