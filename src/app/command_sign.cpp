#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/sign_step.h"
#include "base/value_names.h"
#include "report/signature/roles.h"

// telestrain sign results/report.pdf --role operator --p12 operator.p12 --reason "Results checked"
//   signed     results/report.pdf as operator: Zhang Wei, certificate 9f2c61d0a4b7e833…

namespace telestrain {
namespace {

class SignCommand : public Command {
 public:
  std::string Name() const override { return "sign"; }
  std::string Summary() const override {
    return "sign a report (PAdES): the instrument's seal first, then operator, reviewer, approver";
  }
  std::string Example() const override {
    return "telestrain sign results/report.pdf --role operator --p12 operator.p12";
  }
  void AddOptions(CLI::App& app) override {
    app.add_option("REPORT", arguments_.report, "report.pdf; replaced by the signed file")
        ->type_name(kFile)
        ->required();
    app.add_option("--role", arguments_.role, "who signs; each role once")
        ->required()
        ->check(
            CLI::IsMember(std::vector<std::string>(kSigningRoles.begin(), kSigningRoles.end())));
    AddKeyOptions(app);
    app.add_option("--name", arguments_.name, "shown beside the certificate's name");
    app.add_option("--reason", arguments_.reason, "why, as 'Results checked'");
    app.add_option("--place", arguments_.place, "where");
    app.add_option("--time", arguments_.time,
                   "time of signing, ISO 8601, UTC without an offset (default: now)")
        ->type_name("TIME");
    app.add_option("--timestamp", arguments_.time_stamp_url,
                   "http URL of an RFC 3161 responder whose token proves the time")
        ->type_name("URL");
    app.add_option("--out", arguments_.out, "write the signed file here instead")->type_name(kFile);
  }
  Result<int> Run(Console& console) override { return SignStep(arguments_, console); }

 private:
  void AddKeyOptions(CLI::App& app) {
    auto* p12 = app.add_option("--p12", arguments_.p12, "PKCS#12 file with key and certificates")
                    ->type_name(kFile);
    auto* key = app.add_option("--key", arguments_.key,
                               "private key: PEM file, or a pkcs11: URI if OpenSSL has a provider")
                    ->type_name(kFile);
    auto* cert =
        app.add_option("--cert", arguments_.certificate, "its certificate, PEM")->type_name(kFile);
    key->needs(cert)->excludes(p12);
    cert->needs(key);
    app.add_option("--chain", arguments_.chain, "PEM file of the authorities between it and a root")
        ->type_name(kFile);
    app.add_option("--password-file", arguments_.password_file,
                   "file of up to 4096 bytes whose first line unlocks the key (or set "
                   "TELESTRAIN_KEY_PASSWORD; else a "
                   "terminal is asked)")
        ->type_name(kFile);
  }

  SignArguments arguments_;
};

}  // namespace

std::unique_ptr<Command> MakeSignCommand() { return std::make_unique<SignCommand>(); }

}  // namespace telestrain
