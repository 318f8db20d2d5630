#include "app/sign_step.h"

#include <termios.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>

#include "base/files.h"
#include "base/utf8.h"
#include "report/audit/audit_trail.h"
#include "report/signature/sign_report.h"
#include "report/signature/utc_time.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

std::string FirstLine(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

// Typed without being shown.
Result<std::string> AskTerminal(const std::string& source) {
  termios shown{};
  if (::isatty(STDIN_FILENO) == 0 || ::tcgetattr(STDIN_FILENO, &shown) != 0)
    return BadInput(source +
                    ": is locked and there is no terminal to ask for its password; give "
                    "--password-file or TELESTRAIN_KEY_PASSWORD");
  termios hidden = shown;
  hidden.c_lflag &= ~static_cast<tcflag_t>(ECHO);
  std::cerr << "Password of " << source << ": " << std::flush;
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &hidden);
  std::string password;
  std::getline(std::cin, password);
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &shown);
  std::cerr << '\n';
  return password;
}

Result<std::string> PasswordOf(const SignArguments& arguments, const std::string& source) {
  if (!arguments.password_file.empty()) {
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(arguments.password_file));
    return FirstLine(text);
  }
  if (const char* set = std::getenv("TELESTRAIN_KEY_PASSWORD")) return std::string(set);
  return AskTerminal(source);
}

Result<SigningKey> KeyOf(const SignArguments& arguments) {
  KeySources sources;
  for (const std::string& source :
       {arguments.p12, arguments.key, arguments.certificate, arguments.chain})
    if (!source.empty()) sources.sources.push_back(source);
  if (arguments.p12.empty() && arguments.key.empty())
    return Error{ErrorKind::kUsage, "give --p12 FILE, or --key FILE with --cert FILE"};
  sources.password = [&](const std::string& source) { return PasswordOf(arguments, source); };
  return LoadSigningKey(sources);
}

Result<SignOptions> OptionsOf(const SignArguments& arguments) {
  SignOptions options{arguments.role,  arguments.name,  arguments.reason,
                      arguments.place, CurrentTime_s(), arguments.time_stamp_url};
  if (arguments.time.empty()) return options;
  const auto time_s = ParseIsoTime(arguments.time);
  if (!time_s)
    return Error{ErrorKind::kUsage,
                 "--time " + arguments.time + ": want ISO 8601, as 2026-01-31T12:30:00Z"};
  options.time_s = *time_s;
  return options;
}

// The trail of the results folder that the report lies in, if it does.
Result<std::optional<AuditTrail>> TrailBeside(const fs::path& report) {
  const fs::path file = report.parent_path() / "audit.jsonl";
  std::error_code code;
  if (!fs::exists(file, code)) return std::optional<AuditTrail>();
  TELESTRAIN_ASSIGN_OR_RETURN(AuditTrail trail, AuditTrail::Open(file));
  return std::optional<AuditTrail>(std::move(trail));
}

// The signed file as seen from the folder of the report: report.pdf itself, or another one.
std::string FileOf(const SignArguments& arguments) {
  if (arguments.out.empty()) return fs::path(arguments.report).filename().string();
  return fs::absolute(arguments.out)
      .lexically_normal()
      .lexically_relative(fs::absolute(arguments.report).lexically_normal().parent_path())
      .string();
}

Json EntryOf(const SignArguments& arguments, const std::string& before,
             const SignedReport& signed_report) {
  return {{"role", arguments.role},
          {"signer", signed_report.signer},
          {"certificate_sha256", signed_report.fingerprint},
          {"file", FileOf(arguments)},
          {"sha256_before", Sha256Hex(before)},
          {"sha256_after", Sha256Hex(signed_report.bytes)}};
}

}  // namespace

Result<int> SignStep(const SignArguments& arguments, Console& console) {
  const std::string target = arguments.out.empty() ? arguments.report : arguments.out;
  TELESTRAIN_ASSIGN_OR_RETURN(const SignOptions options, OptionsOf(arguments));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string before, ReadFile(arguments.report));
  TELESTRAIN_ASSIGN_OR_RETURN(auto trail, TrailBeside(fs::absolute(target)));
  TELESTRAIN_ASSIGN_OR_RETURN(const SigningKey key, KeyOf(arguments));
  TELESTRAIN_ASSIGN_OR_RETURN(const SignedReport signed_report,
                              SignReport(arguments.report, before, key, options));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(target, signed_report.bytes));
  if (trail) {
    TELESTRAIN_RETURN_IF_ERROR(
        trail->Append("sign", EntryOf(arguments, before, signed_report), IsoTime(options.time_s)));
    TELESTRAIN_RETURN_IF_ERROR(trail->Sync());
  }
  console.Say("signed     " + target + " as " + options.role + ": " +
              PrintableText(signed_report.signer) + ", certificate " +
              signed_report.fingerprint.substr(0, 16) + "…");
  return 0;
}

}  // namespace telestrain
