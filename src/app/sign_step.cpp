#include "app/sign_step.h"

#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include "app/changed_results.h"
#include "app/results_lock.h"
#include "base/files.h"
#include "base/signals.h"
#include "base/utf8.h"
#include "report/audit/audit_trail.h"
#include "report/signature/sign_report.h"
#include "report/signature/utc_time.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPassword_bytes = 4096;

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
  const AtSignal show([&](int) {
    ::tcsetattr(STDIN_FILENO, TCSANOW, &shown);
    std::cerr << '\n';
    return AfterSignal::kEnd;
  });
  std::cerr << "Password of " << source << ": " << std::flush;
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &hidden);
  std::string password;
  std::getline(std::cin, password);
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &shown);
  std::cerr << '\n';
  return password;
}

// Unbuffered, so that no copy of it stays behind. Beside files, what the shell gives for <(…) is
// read; any other pipe or device could be waited for without end.
Result<std::string> PasswordIn(const std::string& file) {
  std::error_code code;
  if (!fs::is_regular_file(file, code) && !file.starts_with("/dev/fd/"))
    return BadInput(file +
                    ": the password cannot be read: there is no regular file; correct "
                    "--password-file or set TELESTRAIN_KEY_PASSWORD");
  std::ifstream stream;
  stream.rdbuf()->pubsetbuf(nullptr, 0);
  stream.open(file, std::ios::binary);
  std::string text(kMostPassword_bytes + 1, '\0');
  if (!stream)
    return BadInput(file + ": the password cannot be read: " + std::strerror(errno) +
                    "; allow reading it");
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  const bool too_long = text.size() > kMostPassword_bytes;
  const std::string line = FirstLine(text);
  WipePassword(&text);
  if (!too_long) return line;
  return BadInput(file + ": is larger than " + std::to_string(kMostPassword_bytes) +
                  " bytes; want a file whose first line is the password");
}

Result<std::string> PasswordOf(const SignArguments& arguments, const std::string& source) {
  if (!arguments.password_file.empty()) return PasswordIn(arguments.password_file);
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

// The trail of the results folder that the signed file goes to, if it has one. It must be whole and
// can be continued, so that nothing is signed that it would not tell of.
Result<std::optional<AuditTrail>> TrailBeside(const fs::path& report) {
  const fs::path file = report.parent_path() / "audit.jsonl";
  std::error_code code;
  if (!fs::exists(file, code)) return std::optional<AuditTrail>();
  if (::access(file.c_str(), W_OK) != 0)
    return OutputFailed(file.string() + ": cannot be continued: " + std::strerror(errno) +
                        "; nothing is signed that the audit trail would not tell of");
  TELESTRAIN_ASSIGN_OR_RETURN(AuditTrail trail, AuditTrail::Open(file));
  return std::optional<AuditTrail>(std::move(trail));
}

// `target`: lies in the folder of the trail.
Json EntryOf(const SignArguments& arguments, const fs::path& target, const std::string& before,
             const SignedReport& signed_report) {
  return {{"role", arguments.role},
          {"signer", signed_report.signer},
          {"certificate_sha256", signed_report.fingerprint},
          {"file", target.filename().string()},
          {"sha256_before", Sha256Hex(before)},
          {"sha256_after", Sha256Hex(signed_report.bytes)}};
}

Status Record(AuditTrail& trail, const Json& body, const SignOptions& options) {
  TELESTRAIN_RETURN_IF_ERROR(trail.Append("sign", body, IsoTime(options.time_s)));
  return trail.Replace();
}

// The file itself when the name is a link to it; the link stays.
fs::path FileBehind(const fs::path& path) {
  std::error_code code;
  const fs::path file = fs::is_symlink(path, code) ? fs::canonical(path, code) : path;
  return code ? path : file;
}

}  // namespace

Result<int> SignStep(const SignArguments& arguments, Console& console) {
  const std::string target = arguments.out.empty() ? arguments.report : arguments.out;
  TELESTRAIN_ASSIGN_OR_RETURN(const SignOptions options, OptionsOf(arguments));
  if (const auto readable = ReadFile(arguments.report, kMostReportBytes); !readable)
    return readable.error();
  const fs::path folder = fs::absolute(target).parent_path();
  // Known before a password is asked for, which may take its time and keeps nobody out.
  if (const auto is_free = ResultsLock::Take(folder); !is_free) return is_free.error();
  const fs::path results = fs::absolute(arguments.report).parent_path();
  TELESTRAIN_RETURN_IF_ERROR(RequireAsRecorded(results));
  TELESTRAIN_ASSIGN_OR_RETURN(const SigningKey key, KeyOf(arguments));
  // Held until the trail tells of the signature: nobody signs what another is about to replace.
  TELESTRAIN_ASSIGN_OR_RETURN(const ResultsLock lock, ResultsLock::Take(folder));
  TELESTRAIN_RETURN_IF_ERROR(RequireAsRecorded(results));
  TELESTRAIN_ASSIGN_OR_RETURN(auto trail, TrailBeside(fs::absolute(target)));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string before,
                              ReadFile(arguments.report, kMostReportBytes));
  TELESTRAIN_ASSIGN_OR_RETURN(const SignedReport signed_report,
                              SignReport(arguments.report, before, key, options));
  const NoSignalNow file_and_trail;
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(FileBehind(target), signed_report.bytes));
  if (trail) {
    const Json body = EntryOf(arguments, target, before, signed_report);
    if (const Status told = Record(*trail, body, options); !told)
      return OutputFailed(
          target + " is signed, but its audit trail does not tell of it: " + told.error().message);
  }
  console.Say("signed     " + target + " as " + options.role + ": " +
              PrintableText(signed_report.signer) + ", certificate " +
              signed_report.fingerprint.substr(0, 16) + "…");
  return 0;
}

}  // namespace telestrain
