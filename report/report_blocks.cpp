#include "report/report_blocks.h"

#include <algorithm>
#include <map>

#include "report/picture_block.h"
#include "report/report_charts.h"
#include "report/result_cells.h"
#include "report/signature_block.h"
#include "report/table_block.h"
#include "report/text_wrap.h"

namespace telestrain {
namespace {

constexpr Color kWhite{1, 1, 1};
constexpr double kPixel_pt = 72.0 / 300;  // pictures are printed at 300 dpi
constexpr double kLogoShare = 0.35;       // of the band's width, at most
constexpr double kLogoEdge_pt = 5, kLogoGap_pt = 12;

Color PaleAccent() { return ColorOf(0xC9D6E3); }

// The size of the user's logo with the white edge around it; nothing without one.
PageBox LogoBox(const ReportContext& context) {
  if (!context.layout.logo()) return {};
  const RgbImage& logo = *context.layout.logo();
  const double widest_pt = kLogoShare * context.flow.width_pt();
  const double height_pt = std::min(context.layout.LogoHeight_mm() * kPointsPerMm,
                                    widest_pt * logo.height_px / logo.width_px);
  return {context.flow.left_pt(), kPageHeight_pt - 16 - height_pt - 2 * kLogoEdge_pt,
          height_pt * logo.width_px / logo.height_px + 2 * kLogoEdge_pt,
          height_pt + 2 * kLogoEdge_pt};
}

void DrawLogo(const ReportContext& context, const PageBox& box) {
  if (!context.layout.logo()) return;
  context.flow.pdf().FillBox(box, kWhite);
  const ScopedTag figure(context.flow.pdf(), PdfTag{"Figure", context.layout.Say("Logo"), "", box});
  context.flow.pdf().DrawImage(*context.layout.logo(),
                               {box.left_pt + kLogoEdge_pt, box.bottom_pt + kLogoEdge_pt,
                                box.width_pt - 2 * kLogoEdge_pt, box.height_pt - 2 * kLogoEdge_pt});
}

// Lines of a text as a piece of their own.
double TaggedText(PageFlow& flow, const PdfTag& tag, const TextStyle& style, PagePoint top_left,
                  double width_pt, const std::string& text, Align align = Align::kLeft) {
  const ScopedTag piece(flow.pdf(), tag);
  return flow.TextBlock(style, top_left, width_pt, text, align);
}

// The coloured band over the whole width of the first page.
Status DrawTitle(const ReportContext& context, const Json& block) {
  PageFlow& flow = context.flow;
  TextStyle title{Face::kBold, 20, kWhite};
  const TextStyle subtitle{Face::kRegular, 10.5, PaleAccent()};
  const Json& right = ListAt(block, "/right");
  const double right_pt = right.empty() ? 0 : 52 * kPointsPerMm;
  const PageBox logo = LogoBox(context);
  const double x_pt = flow.left_pt() + (logo.width_pt > 0 ? logo.width_pt + kLogoGap_pt : 0);
  const double left_pt = flow.right_pt() - x_pt - right_pt - (right.empty() ? 0 : 12);
  const std::string text = context.Fill(block, "text"), below = context.Fill(block, "subtitle");
  while (WidestWord_pt(flow.pdf(), title, text) > left_pt && title.size_pt > subtitle.size_pt)
    title.size_pt -= 0.5;
  double right_height_pt = 0;
  const auto right_style = [&](std::size_t i) {
    return i == 0 ? TextStyle{Face::kBold, 11, kWhite} : TextStyle{Face::kRegular, 9, PaleAccent()};
  };
  for (std::size_t i = 0; i < right.size(); ++i)
    right_height_pt += flow.TextHeight_pt(
        right_style(i), right_pt, context.layout.Fill(right[i].get<std::string>(), context.values));
  const double left_height_pt =
      flow.TextHeight_pt(title, left_pt, text) + 3 + flow.TextHeight_pt(subtitle, left_pt, below);
  const double band_pt =
      std::max(std::max(left_height_pt, right_height_pt) + 40, logo.height_pt + 32);
  flow.pdf().FillBox({0, kPageHeight_pt - band_pt, kPageWidth_pt, band_pt}, flow.look().accent);
  DrawLogo(context, logo);
  double y_pt = kPageHeight_pt - 22;
  y_pt -= TaggedText(flow, {"H1"}, title, {x_pt, y_pt}, left_pt, text) + 3;
  TaggedText(flow, {"P"}, subtitle, {x_pt, y_pt}, left_pt, below);
  y_pt = kPageHeight_pt - 26;
  for (std::size_t i = 0; i < right.size(); ++i)
    y_pt -=
        TaggedText(flow, {"P"}, right_style(i), {flow.right_pt() - right_pt, y_pt}, right_pt,
                   context.layout.Fill(right[i].get<std::string>(), context.values), Align::kRight);
  flow.MoveTo(kPageHeight_pt - band_pt - 16);
  return {};
}

// The badge; the lines of the document stand to its left.
Status DrawVerdict(const ReportContext& context, const Json& block) {
  PageFlow& flow = context.flow;
  static const std::map<std::string, std::pair<const char*, const char*>> kBadges = {
      {"pass", {"✓", "PASS"}},
      {"doubt", {"?", "IN DOUBT"}},
      {"fail", {"✗", "FAIL"}},
      {"undecided", {"–", "NOT DECIDED"}}};
  const std::string verdict = TextAt(context.results, "/verdict", "undecided");
  const auto& [symbol, word] =
      kBadges.count(verdict) ? kBadges.at(verdict) : kBadges.at("undecided");
  const std::string text = std::string(symbol) + "  " + context.layout.Say(word);
  TextStyle style{Face::kBold, 16, kWhite};
  const double width_pt = 46 * kPointsPerMm, height_pt = 34;
  while (flow.pdf().TextWidth_pt(style, text) > width_pt - 16 && style.size_pt > 6)
    style.size_pt -= 0.5;
  const double top_pt = flow.y_pt();
  const int page = flow.pdf().PageCount();
  flow.pdf().FillBox({flow.right_pt() - width_pt, top_pt - height_pt, width_pt, height_pt},
                     flow.look().OfVerdict(verdict));
  {
    const ScopedTag badge(flow.pdf(), PdfTag{"P"});
    flow.pdf().DrawText(
        style, {flow.right_pt() - width_pt / 2, top_pt - height_pt / 2 - 0.36 * style.size_pt},
        text, Align::kCenter);
  }
  DrawFacts(flow, context.Table(TextAt(block, "/table")), 1, flow.width_pt() - width_pt - 14);
  if (flow.pdf().PageCount() == page) flow.MoveTo(std::min(flow.y_pt(), top_pt - height_pt - 10));
  return {};
}

Status DrawHeading(const ReportContext& context, const Json& block) {
  PageFlow& flow = context.flow;
  const int level = static_cast<int>(NumberAt(block, "/level").value_or(1));
  const TextStyle style{Face::kBold, flow.look().Scaled_pt(level == 1 ? 13.0 : 10.5),
                        flow.look().accent};
  const std::string number =
      level == 1 ? TextAt(context.values, "/section/" + TextAt(block, "/id")) : "";
  const std::string text = number + (number.empty() ? "" : "  ") + context.Fill(block, "text");
  flow.Require(style.LineHeight_pt() + 70);  // not alone at the foot of a page
  flow.Advance(level == 1 ? 8 : 4);
  flow.pdf().AddBookmark(text, level, flow.y_pt() + 8);
  const std::string id = TextAt(block, "/id");
  if (!id.empty()) flow.pdf().AddDestination(id, flow.y_pt() + 8);
  flow.Paragraph(style, text, {level == 1 ? "H2" : "H3"});  // H1 is the title band
  flow.Advance(level == 1 ? 5 : 3);
  return {};
}

Status DrawText(const ReportContext& context, const Json& block) {
  PageFlow& flow = context.flow;
  const std::string text = context.Fill(block, "text");
  if (text.empty()) return {};
  const std::string style = TextAt(block, "/style", "body");
  const Look& look = flow.look();
  flow.Paragraph(style == "note"     ? look.Note()
                 : style == "strong" ? look.Strong()
                                     : look.Body(),
                 text);
  flow.Advance(6);
  return {};
}

// What stands in place of a block whose data do not exist.
Status DrawOtherwise(const ReportContext& context, const Json& block) {
  const std::string text = context.Fill(block, "otherwise");
  if (text.empty()) return {};
  context.flow.Paragraph(context.flow.look().Note(), text);
  context.flow.Advance(6);
  return {};
}

Status DrawKeyValues(const ReportContext& context, const Json& block) {
  PageFlow& flow = context.flow;
  const Json& table = context.Table(TextAt(block, "/table"));
  if (ListAt(table, "/rows").empty()) return {};
  const int columns = static_cast<int>(NumberAt(block, "/columns").value_or(1));
  const double title_pt = 16, height_pt = FactsHeight_pt(flow, table, columns, flow.width_pt());
  const bool whole = height_pt <= kWholeShare * flow.PageBody_pt();
  flow.Require(title_pt + (whole ? height_pt : 40));
  if (EntryAt(block, "/show_title") != false) {
    flow.Paragraph(flow.look().Strong(), TextAt(table, "/title"));
    flow.Advance(2);
  }
  DrawFacts(flow, table, columns, flow.width_pt());
  return {};
}

Status DrawTableBlock(const ReportContext& context, const Json& block) {
  const Json& table = context.Table(TextAt(block, "/table"));
  if (ListAt(table, "/rows").empty()) return DrawOtherwise(context, block);
  TableStyle style;
  style.width_mm = NumberAt(block, "/width_mm").value_or(0);
  style.show_title = EntryAt(block, "/show_title") != false;
  style.continued = context.layout.Say("continued");
  for (const Json& name : ListAt(block, "/mono")) style.mono.push_back(context.layout.Say(name));
  DrawTable(context.flow, table, style);
  return {};
}

// What a chart shows, for who cannot see it: what the caption says of it and its neighbours.
std::string ChartWords(const ReportContext& context, const Json& names, std::size_t i,
                       const std::string& caption) {
  const Json which =
      Phrase("Chart {{number}} of {{count}}",
             {{"number", std::to_string(i + 1)}, {"count", std::to_string(names.size())}});
  return context.layout.Say(which) + ": " +
         (caption.empty() ? names[i].get<std::string>() : caption);
}

Status DrawChartBlock(const ReportContext& context, const Json& block) {
  PageFlow& flow = context.flow;
  const Json& names = ListAt(block, "/charts");
  const std::string caption = context.Fill(block, "caption");
  const double height_pt = *NumberAt(block, "/height_mm") * kPointsPerMm;
  flow.Require(height_pt + CaptionHeight_pt(flow, caption));
  const double gap_pt = 10, count = static_cast<double>(names.size());
  const double width_pt = (flow.width_pt() - gap_pt * (count - 1)) / count;
  double left_pt = flow.left_pt();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const PageBox box{left_pt, flow.y_pt() - height_pt, width_pt, height_pt};
    const ScopedTag figure(flow.pdf(),
                           PdfTag{"Figure", ChartWords(context, names, i, caption), "", box});
    TELESTRAIN_RETURN_IF_ERROR(DrawChart(context, names[i].get<std::string>(), box));
    left_pt += width_pt + gap_pt;
  }
  flow.Advance(height_pt);
  DrawCaption(flow, caption);
  return {};
}

Status DrawPicture(const ReportContext& context, const Json& block) {
  const auto path = context.folder / "pictures" / TextAt(block, "/file");
  if (!std::filesystem::exists(path)) return DrawOtherwise(context, block);
  TELESTRAIN_ASSIGN_OR_RETURN(RgbImage image, ReadPng(path));
  const std::string caption = context.Fill(block, "caption");
  DrawPictureBlock(context.flow, std::move(image), kPixel_pt, caption,
                   caption.empty() ? path.filename().string() : caption);
  return {};
}

Status StartNewPage(const ReportContext& context, const Json&) {
  context.flow.StartPageUnlessEmpty();
  return {};
}

Status DrawEndMark(const ReportContext& context, const Json& block) {
  PageFlow& flow = context.flow;
  const TextStyle style = flow.look().Note();
  flow.Require(style.LineHeight_pt() + 8);
  flow.Advance(6);
  flow.Advance(TaggedText(flow, {"P"}, style, {flow.left_pt(), flow.y_pt()}, flow.width_pt(),
                          context.Fill(block, "text"), Align::kCenter));
  return {};
}

}  // namespace

Status DrawBlock(const ReportContext& context, const std::string& pointer, const Json& block) {
  using Draw = Status (*)(const ReportContext&, const Json&);
  static const std::map<std::string, Draw> kDraw = {
      {"title", DrawTitle},         {"verdict", DrawVerdict},      {"heading", DrawHeading},
      {"text", DrawText},           {"key-values", DrawKeyValues}, {"table", DrawTableBlock},
      {"chart", DrawChartBlock},    {"picture", DrawPicture},      {"signatures", DrawSignatures},
      {"page-break", StartNewPage}, {"end-mark", DrawEndMark}};
  const auto draw = kDraw.find(TextAt(block, "/type"));
  TELESTRAIN_CHECK(draw != kDraw.end(), "a checked layout has known blocks only: " + pointer);
  if (!IsWanted(context.results, block)) return {};
  return draw->second(context, block);
}

}  // namespace telestrain
