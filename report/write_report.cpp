#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "report/acceptance_report.h"
#include "report/layout_notes.h"
#include "report/report_attachments.h"
#include "report/report_blocks.h"
#include "report/table_block.h"

namespace telestrain {
namespace {

constexpr long long kSecondsPerDay = 86400;

std::string TwoDigits(long long value) {
  return std::string(value < 10 ? "0" : "") + std::to_string(value);
}

// Days since 1970-01-01 as a PDF date (Hinnant's civil_from_days).
std::string DateOfSeconds(long long seconds) {
  const long long days = seconds / kSecondsPerDay + 719468;
  const long long era = days / 146097, day_of_era = days % 146097;
  const long long year_of_era =
      (day_of_era - day_of_era / 1460 + day_of_era / 36524 - day_of_era / 146096) / 365;
  const long long day_of_year =
      day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const long long month_index = (5 * day_of_year + 2) / 153;
  const long long month = month_index < 10 ? month_index + 3 : month_index - 9;
  const long long year = year_of_era + era * 400 + (month <= 2 ? 1 : 0);
  const long long time = seconds % kSecondsPerDay;
  return "D:" + std::to_string(year) + TwoDigits(month) +
         TwoDigits(day_of_year - (153 * month_index + 2) / 5 + 1) + TwoDigits(time / 3600) +
         TwoDigits(time / 60 % 60) + TwoDigits(time % 60) + "Z";
}

// "2026-01-31" or "2026-01-31T10:14[:05][Z]" as a PDF date; empty when it is neither.
std::string DateOfIso8601(const std::string& text) {
  std::string digits;
  constexpr const char* kPattern = "dddd-dd-ddTdd:dd:dd";
  std::size_t i = 0;
  for (; i < text.size() && kPattern[i] != '\0'; ++i) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    if (kPattern[i] == 'd' ? !is_digit : text[i] != kPattern[i]) break;
    if (is_digit) digits += text[i];
  }
  if (digits.size() < 8) return "";
  const int month = std::stoi(digits.substr(4, 2)), day = std::stoi(digits.substr(6, 2));
  if (month < 1 || month > 12 || day < 1 || day > 31) return "";
  return "D:" + digits.substr(0, digits.size() / 2 * 2) +
         std::string(14 - digits.size() / 2 * 2, '0') + "Z";
}

// Never the clock: the same results give the same bytes.
std::string CreationDate(const Json& results) {
  const std::string date = DateOfIso8601(TextAt(results, "/document/date"));
  if (!date.empty()) return date;
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const auto seconds = epoch ? ParseDouble(epoch) : std::nullopt;
  return seconds && *seconds >= 0 && *seconds < 2.5e11
             ? DateOfSeconds(static_cast<long long>(*seconds))
             : "";
}

PdfInfo InfoOf(const ReportTemplate& layout, const Json& results, const Json& values) {
  PdfInfo info;
  info.title = TextAt(values, "/report/title") + " " + TextAt(values, "/report/number");
  info.author = layout.Fill(TextAt(layout.json(), "/author"), values);
  info.language = layout.texts().language();
  info.subject = TextAt(results, "/title");
  info.creator = TextAt(results, "/inputs/program/name", "telestrain") + " " +
                 TextAt(results, "/inputs/program/version");
  info.created = CreationDate(results);
  return info;
}

// The height that the block needs at least to begin on a page.
double Beginning_pt(const ReportContext& context, const Json& block) {
  constexpr double kSignatures_pt = 150, kCaption_pt = 30, kOther_pt = 70;
  const std::string type = TextAt(block, "/type");
  if (type == "signatures") return kSignatures_pt;
  if (type == "chart") return *NumberAt(block, "/height_mm") * kPointsPerMm + kCaption_pt;
  if (type != "table" && type != "key-values") return kOther_pt;
  // A small table is drawn whole; rows of two lines are taken for all.
  constexpr double kTitles_pt = 50, kRow_pt = 26;
  const Json& rows = ListAt(context.Table(TextAt(block, "/table")), "/rows");
  return std::min(kTitles_pt + kRow_pt * static_cast<double>(rows.size()),
                  kWholeShare * context.flow.PageBody_pt());
}

// A heading goes to the next page with the block that follows it.
void KeepHeadingWithNext(const ReportContext& context, const Json& blocks, std::size_t i) {
  constexpr double kHeading_pt = 34;
  if (TextAt(blocks[i], "/type") != "heading" || !IsWanted(context.results, blocks[i])) return;
  for (++i; i < blocks.size(); ++i)
    if (IsWanted(context.results, blocks[i]))
      return context.flow.Require(kHeading_pt + Beginning_pt(context, blocks[i]));
}

}  // namespace

Status WriteReport(const std::filesystem::path& results, const ReportOptions& options) {
  std::error_code code;  // an older report must not stand beside newer results
  std::filesystem::remove(results / "report.pdf", code);
  TELESTRAIN_ASSIGN_OR_RETURN(
      ReportTemplate layout,
      ReportTemplate::Load({options.templates, options.name, options.language}));
  layout.OnUntranslated(options.on_untranslated);
  const auto path = results / "results.json";
  TELESTRAIN_ASSIGN_OR_RETURN(const Json read,
                              ReadJson(path, "telestrain.results/1", "telestrain report"));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  if (options.on_note)
    for (const std::string& note : LayoutNotes(layout, read)) options.on_note(note);
  Json values = layout.FillValues(read);
  values["file"] = {{"results_sha256", Sha256Hex(bytes)}};
  TELESTRAIN_ASSIGN_OR_RETURN(std::vector<PdfAttachment> attachments, ReportAttachments(results));
  Json extended = read;
  extended["tables"].push_back(AttachmentsTable(attachments));
  const Json said = layout.SayTables(std::move(extended));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto pdf, PdfDocument::Create(options.level));
  PageFlow flow(*pdf, layout.look());
  flow.StartPage();
  const ReportContext context{results, layout, said, values, flow};
  const Json blocks = WithAttachmentsTable(layout.blocks(), said);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    KeepHeadingWithNext(context, blocks, i);
    TELESTRAIN_RETURN_IF_ERROR(DrawBlock(context, "/blocks/" + std::to_string(i), blocks[i]));
  }
  DrawPageFrames(context);
  for (PdfAttachment& attachment : attachments) pdf->Attach(std::move(attachment));
  TELESTRAIN_ASSIGN_OR_RETURN(
      const std::string file,
      pdf->Save(InfoOf(layout, read, values), bytes + layout.json().dump() + options.language));
  return WriteFileAtomically(results / "report.pdf", file);
}

}  // namespace telestrain
