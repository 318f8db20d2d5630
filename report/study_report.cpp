#include "report/study_report.h"

#include <algorithm>
#include <vector>

#include "base/files.h"
#include "report/cell_lines.h"
#include "report/picture_block.h"
#include "report/report_blocks.h"
#include "report/study_file.h"
#include "report/study_plot.h"
#include "report/table_block.h"

namespace telestrain {
namespace {

constexpr double kLargestPixel_pt = 72.0 / 150;  // pictures are printed at 150 dpi or finer
constexpr double kHeadingRoom_pt = 34;

// Title and frames of the pages; what stands between is drawn below.
constexpr const char* kLayout = R"({
  "schema": "telestrain.template/1",
  "title": "{{title}}",
  "header": {"left": "{{title}}", "right": "Study {{study}}"},
  "footer": {"left": "telestrain study {{study}}", "right": "Page {{page}} of {{pages}}"},
  "blocks": [{"type": "title", "text": "{{title}}", "subtitle": "Study {{study}}"}]})";

// A text as a cell; what is missing is a dash.
Json TextCell(const Json& row, const char* key) {
  const std::string text = TextAt(row, std::string("/") + key);
  return text.empty() ? "–" : text;
}

Json MetCell(const Json& met) {
  if (!met.is_boolean()) return "–";
  return met == true ? Json{{"verdict", "pass"}, {"printed", "✓ yes"}}
                     : Json{{"verdict", "fail"}, {"printed", "✗ no"}};
}

Json ComparisonTable(const Json& study) {
  Json table = {{"title", "Paper, ours and the limit"}, {"columns", Json::array()}};
  for (const char* name : {"Quantity", "Unit", "Paper", "Ours", "Limit", "Met", "What differs"})
    table["columns"].push_back({{"name", name}});
  table["rows"] = Json::array();
  for (const Json& row : ListAt(study, "/comparison"))
    table["rows"].push_back({TextCell(row, "quantity"), TextAt(row, "/unit"),
                             TextCell(row, "paper"), TextCell(row, "ours"), TextCell(row, "limit"),
                             MetCell(EntryAt(row, "/met")), TextAt(row, "/differs")});
  return table;
}

Json SettingsTable(const Json& study) {
  Json table = {{"title", "Settings"}, {"columns", Json::array()}, {"rows", Json::array()}};
  for (const char* name : {"name", "value", "unit"}) table["columns"].push_back({{"name", name}});
  for (const Json& row : ListAt(study, "/settings"))
    table["rows"].push_back({TextAt(row, "/name"), TextAt(row, "/value"), TextAt(row, "/unit")});
  return table;
}

// Draws a study, section by section; one that is empty is left out.
class StudyDrawing {
 public:
  StudyDrawing(const ReportContext& context, const Study& study)
      : context_(context), flow_(context.flow), study_(study) {}
  Status Draw(const std::vector<RgbImage>& images);

 private:
  Status Heading(const std::string& text) {
    return DrawBlock(context_, "", {{"type", "heading"}, {"text", text}});
  }
  Status DrawOpening();
  Status DrawPlots();
  Status DrawImages(const std::vector<RgbImage>& images);
  double PixelOf(const RgbImage& image, double beside_pt) const;
  Status DrawTables();
  Status DrawNotes();
  Status DrawSettings();

  const ReportContext& context_;
  PageFlow& flow_;
  const Study& study_;
};

Status StudyDrawing::DrawOpening() {
  TELESTRAIN_RETURN_IF_ERROR(DrawBlock(context_, "/blocks/0", context_.layout.blocks()[0]));
  for (const auto& [heading, key] : {std::pair("Question", "/question"), {"Answer", "/answer"}}) {
    const std::string text = TextAt(study_.json, key);
    if (text.empty()) continue;
    TELESTRAIN_RETURN_IF_ERROR(Heading(heading));
    flow_.Paragraph({Face::kRegular, 10, flow_.look().ink}, text);
    flow_.Advance(4);
  }
  if (ListAt(study_.json, "/comparison").empty()) return {};
  TELESTRAIN_RETURN_IF_ERROR(Heading("Comparison with the paper"));
  TableStyle style;
  style.show_title = false;
  DrawTable(flow_, ComparisonTable(study_.json), style);
  return {};
}

// Two a page, below the section's heading too.
Status StudyDrawing::DrawPlots() {
  if (study_.plots.empty()) return {};
  const double height_pt = (flow_.PageBody_pt() - kHeadingRoom_pt) / 2;
  flow_.Require(height_pt + kHeadingRoom_pt);
  TELESTRAIN_RETURN_IF_ERROR(Heading("Plots"));
  for (const StudyPlot& plot : study_.plots) DrawStudyPlot(flow_, plot, height_pt);
  return {};
}

// As large as the width and half a page allow, or somewhat smaller where that saves a page.
double StudyDrawing::PixelOf(const RgbImage& image, double beside_pt) const {
  constexpr double kSmallestShare = 0.6;
  const double half_pt = (flow_.PageBody_pt() - kHeadingRoom_pt) / 2 - beside_pt;
  const double pixel_pt =
      std::min({kLargestPixel_pt, flow_.width_pt() / image.width_px, half_pt / image.height_px});
  const double rest_pt = (flow_.Free_pt() - beside_pt) / image.height_px;
  return rest_pt > kSmallestShare * pixel_pt ? std::min(pixel_pt, rest_pt) : pixel_pt;
}

Status StudyDrawing::DrawImages(const std::vector<RgbImage>& images) {
  const Json& list = ListAt(study_.json, "/images");
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::string caption = TextAt(list[i], "/caption");
    const double heading_pt = i == 0 ? kHeadingRoom_pt : 0;
    const double beside_pt = heading_pt + CaptionHeight_pt(flow_, caption);
    const double pixel_pt = PixelOf(images[i], beside_pt);
    flow_.Require(beside_pt + pixel_pt * images[i].height_px);
    if (i == 0) TELESTRAIN_RETURN_IF_ERROR(Heading("Images"));
    const std::string words = "Picture " + std::to_string(i + 1) + ": ";
    DrawPictureBlock(flow_, images[i], pixel_pt, caption,
                     words + (caption.empty() ? TextAt(list[i], "/file") : caption));
  }
  return {};
}

Status StudyDrawing::DrawTables() {
  const Json& tables = ListAt(study_.json, "/tables");
  if (tables.empty()) return {};
  TELESTRAIN_RETURN_IF_ERROR(Heading("Tables"));
  for (const Json& table : tables) DrawTable(flow_, table, {});
  return {};
}

Status StudyDrawing::DrawNotes() {
  const Json& notes = ListAt(study_.json, "/notes");
  if (notes.empty()) return {};
  TELESTRAIN_RETURN_IF_ERROR(Heading("Notes"));
  RowFrame frame;
  frame.line_height_pt = flow_.look().Body().LineHeight_pt();
  frame.start_new_page = [this] { flow_.StartPage(); };
  constexpr double kBullet_pt = 12;
  PdfDocument& pdf = flow_.pdf();
  const ScopedTag list(pdf, PdfTag{"L"});
  for (const Json& note : notes) {
    const ScopedTag item(pdf, PdfTag{"LI"});
    std::vector<CellLines> cells = {
        MakeCellLines(pdf, flow_.look().Body(), flow_.left_pt(), kBullet_pt, "•"),
        MakeCellLines(pdf, flow_.look().Body(), flow_.left_pt() + kBullet_pt,
                      flow_.width_pt() - kBullet_pt, note.get<std::string>())};
    cells[0].tag = ScopedTag(pdf, PdfTag{"Lbl"}).number();
    cells[1].tag = ScopedTag(pdf, PdfTag{"LBody"}).number();
    DrawRow(flow_, cells, frame);
  }
  flow_.Advance(6);
  return {};
}

Status StudyDrawing::DrawSettings() {
  if (ListAt(study_.json, "/settings").empty()) return {};
  TELESTRAIN_RETURN_IF_ERROR(Heading("Settings"));
  DrawFacts(flow_, SettingsTable(study_.json), 2, flow_.width_pt());
  return {};
}

Status StudyDrawing::Draw(const std::vector<RgbImage>& images) {
  TELESTRAIN_RETURN_IF_ERROR(DrawOpening());
  TELESTRAIN_RETURN_IF_ERROR(DrawPlots());
  TELESTRAIN_RETURN_IF_ERROR(DrawImages(images));
  TELESTRAIN_RETURN_IF_ERROR(DrawTables());
  TELESTRAIN_RETURN_IF_ERROR(DrawNotes());
  TELESTRAIN_RETURN_IF_ERROR(DrawSettings());
  DrawPageFrames(context_);
  return {};
}

Result<std::vector<RgbImage>> ReadImages(const std::filesystem::path& study_json,
                                         const Json& study) {
  std::vector<RgbImage> images;
  const Json& list = ListAt(study, "/images");
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto image = ReadPng(study_json.parent_path() / TextAt(list[i], "/file"));
    if (!image)
      return BadInput(study_json.string() + ": /images/" + std::to_string(i) +
                      "/file: " + image.error().message);
    images.push_back(std::move(image).value());
  }
  return images;
}

}  // namespace

Status WriteStudyReport(const std::filesystem::path& study_json, const std::filesystem::path& pdf) {
  std::error_code code;  // an older report must not stand beside a newer study
  std::filesystem::remove(pdf, code);
  TELESTRAIN_ASSIGN_OR_RETURN(const Study study, ReadStudy(study_json));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<RgbImage> images,
                              ReadImages(study_json, study.json));
  TELESTRAIN_ASSIGN_OR_RETURN(const ReportTemplate layout,
                              ReportTemplate::Parse("layout of a study", kLayout));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto document, PdfDocument::Create());
  PageFlow flow(*document, Look{});
  flow.StartPage();
  const Json values = {{"title", TextAt(study.json, "/title")},
                       {"study", TextAt(study.json, "/study")}};
  const ReportContext context{study_json.parent_path(), layout, study.json, values, flow};
  TELESTRAIN_RETURN_IF_ERROR(StudyDrawing(context, study).Draw(images));
  PdfInfo info;
  info.title = TextAt(study.json, "/title");
  info.subject = TextAt(study.json, "/study");
  info.creator = "telestrain";
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, document->Save(info, study.json.dump()));
  return WriteFileAtomically(pdf, bytes);
}

}  // namespace telestrain
