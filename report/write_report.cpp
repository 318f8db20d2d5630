#include <algorithm>

#include "base/files.h"
#include "base/json_file.h"
#include "report/acceptance_report.h"
#include "report/declared_time.h"
#include "report/layout_notes.h"
#include "report/report_attachments.h"
#include "report/report_blocks.h"
#include "report/signature/utc_time.h"
#include "report/table_block.h"

namespace telestrain {
namespace {

PdfInfo InfoOf(const ReportTemplate& layout, const Json& results, const Json& values) {
  PdfInfo info;
  info.title = TextAt(values, "/report/title") + " " + TextAt(values, "/report/number");
  info.author = layout.Fill(TextAt(layout.json(), "/author"), values);
  info.language = layout.texts().language();
  info.subject = TextAt(results, "/title");
  info.creator = TextAt(results, "/inputs/program/name", "telestrain") + " " +
                 TextAt(results, "/inputs/program/version");
  const auto created_s = ParseIsoTime(DeclaredTime(EntryAt(results, "/document")));
  if (created_s) info.created = PdfTime(*created_s);
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

// A heading goes to the next page with what follows it, up to the first block that is no text.
void KeepHeadingWithNext(const ReportContext& context, const Json& blocks, std::size_t i) {
  constexpr double kHeading_pt = 34, kBetweenTexts_pt = 6;
  if (TextAt(blocks[i], "/type") != "heading" || !IsWanted(context.results, blocks[i])) return;
  double height_pt = kHeading_pt;
  for (++i; i < blocks.size(); ++i) {
    if (!IsWanted(context.results, blocks[i])) continue;
    const bool is_text = TextAt(blocks[i], "/type") == "text";
    height_pt +=
        is_text ? context.flow.TextHeight_pt(context.flow.look().Body(), context.flow.width_pt(),
                                             context.Fill(blocks[i], "text")) +
                      kBetweenTexts_pt
                : Beginning_pt(context, blocks[i]);
    if (!is_text) break;
  }
  context.flow.Require(std::min(height_pt, context.flow.PageBody_pt()));
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
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMostJsonBytes));
  if (options.on_note)
    for (const std::string& note : LayoutNotes(layout, read)) options.on_note(note);
  Json values = layout.FillValues(read);
  values["file"] = {{"results_sha256", Sha256Hex(bytes)}};
  TELESTRAIN_ASSIGN_OR_RETURN(std::vector<PdfAttachment> attachments, ReportAttachments(results));
  Json extended = read, tables = ListAt(read, "/tables");
  tables.push_back(AttachmentsTable(attachments));
  extended["tables"] = std::move(tables);
  TELESTRAIN_ASSIGN_OR_RETURN(const Json said, layout.SayTables(std::move(extended)));
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
