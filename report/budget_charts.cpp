#include <algorithm>

#include "report/report_charts.h"
#include "report/text_wrap.h"

namespace telestrain {
namespace {

// Columns of the table "budget" as MakeResults writes them.
constexpr const char *kMeasurand = "/0", *kComponent = "/1", *kUncertainty = "/2", *kUnit = "/3",
                     *kShare = "/4";

struct Bar {
  std::string component, printed;
  double share = 0;  // of the variance, 0 to 1
};

struct BarGroup {
  std::string measurand;
  std::vector<Bar> bars;
};

// Components and the combined uncertainty of every measurand; its expanded one has no share and
// is left to the table.
std::vector<BarGroup> BarGroups(const ReportContext& context) {
  std::vector<BarGroup> groups;
  for (const Json& row : ListAt(context.Table("budget"), "/rows")) {
    const auto share = NumberAt(row, std::string(kShare) + "/value");
    if (!share) continue;
    const std::string measurand = TextAt(row, kMeasurand);
    if (groups.empty() || groups.back().measurand != measurand) groups.push_back({measurand, {}});
    BarGroup& group = groups.back();
    group.bars.push_back(
        {TextAt(row, kComponent),
         TextAt(row, kUncertainty) + " " + TextAt(row, kUnit) + ", " + TextAt(row, kShare) + " %",
         *share / 100});
  }
  return groups;
}

// Where names, bars and values of all groups stand.
struct BarFrame {
  double left_pt, bars_pt, values_pt, right_pt;
  double line_pt;  // height of one bar with its gap

  double BarWidth_pt(double share) const { return share * (values_pt - 6 - bars_pt); }
};

void DrawGroup(const ReportContext& context, const BarGroup& group, const BarFrame& frame,
               double* top_pt) {
  PdfDocument& pdf = context.flow.pdf();
  const Look& look = context.flow.look();
  const double size_pt = std::min(8.0, 0.8 * frame.line_pt);
  const TextStyle name{Face::kRegular, size_pt, look.ink}, title{Face::kBold, size_pt, look.ink};
  const auto baseline_pt = [&] { return *top_pt - 0.5 * frame.line_pt - 0.35 * size_pt; };
  pdf.DrawText(title, {frame.left_pt, baseline_pt()}, group.measurand);
  *top_pt -= frame.line_pt;
  for (std::size_t i = 0; i < group.bars.size(); ++i) {
    const Bar& bar = group.bars[i];
    const bool is_combined = i + 1 == group.bars.size();
    pdf.DrawText(name, {frame.left_pt, baseline_pt()},
                 ShortenedText(pdf, name, bar.component, frame.bars_pt - frame.left_pt - 6));
    pdf.FillBox({frame.bars_pt, *top_pt - 0.85 * frame.line_pt,
                 std::max(0.5, frame.BarWidth_pt(bar.share)), 0.7 * frame.line_pt},
                is_combined ? look.accent : look.measured);
    pdf.DrawText(name, {frame.values_pt, baseline_pt()}, bar.printed);
    *top_pt -= frame.line_pt;
  }
}

}  // namespace

Status DrawBudgetBars(const ReportContext& context, const PageBox& box) {
  const std::vector<BarGroup> groups = BarGroups(context);
  if (groups.empty()) {
    DrawNoData(context, box);
    return {};
  }
  double lines = -0.5;  // half a line between groups
  for (const BarGroup& group : groups) lines += static_cast<double>(group.bars.size()) + 1.5;
  BarFrame frame{box.left_pt, box.left_pt + 0.27 * box.width_pt, box.left_pt + 0.8 * box.width_pt,
                 box.right_pt(), std::min(14.0, box.height_pt / lines)};
  double top_pt = box.top_pt();
  for (const BarGroup& group : groups) {
    DrawGroup(context, group, frame, &top_pt);
    top_pt -= 0.5 * frame.line_pt;
  }
  return {};
}

}  // namespace telestrain
