#include "diagnostics/pattern_catalogue.h"

#include <array>

namespace telestrain {
namespace {

using Layout = PatternLayout;

// One lens parameter or two.
struct LensPattern {
  PatternKind kind;
  std::vector<int> columns;
  std::vector<std::string> names;
  std::vector<double> shown_per_unit;
  bool shared;  // asked of the common lens too
};

const std::vector<LensPattern>& LensPatterns() {
  static const std::vector<LensPattern> patterns = {
      {PatternKind::kRadialK1, {2}, {"k1_per_mm2"}, {1}, true},
      {PatternKind::kRadialK2, {3}, {"k2_per_mm4"}, {1}, true},
      {PatternKind::kTangential, {4, 5}, {"p1_per_mm", "p2_per_mm"}, {1, 1}, true},
      {PatternKind::kAspect, {1}, {"aspect_ppm"}, {1e6}, true},
      {PatternKind::kTelecentricity, {7}, {"telecentricity_per_mm"}, {1}, true},
      {PatternKind::kMagnification, {0}, {"magnification_ppm"}, {1e6}, false},
  };
  return patterns;
}

struct BoardPattern {
  PatternKind kind;
  std::vector<int> columns;
  std::vector<std::string> names;
  std::vector<double> shown_per_unit;
};

const std::vector<BoardPattern>& BoardPatterns() {
  static const std::vector<BoardPattern> patterns = {
      {PatternKind::kBoardFlatness,
       {Layout::kBowX, Layout::kBowY, Layout::kTwist},
       {"bow_x_um", "bow_y_um", "twist_um"},
       {1e3, 1e3, 1e3}},
      {PatternKind::kBoardGrid,
       {Layout::kPitch, Layout::kStretch, Layout::kShear},
       {"pitch_ppm", "stretch_ppm", "shear_ppm"},
       {1e6, 1e6, 1e6}},
      {PatternKind::kBoardPlace,
       {Layout::kShift, Layout::kHeight, Layout::kTiltX, Layout::kTiltY},
       {"shift_um", "height_um", "tilt_x_mrad", "tilt_y_mrad"},
       {1e3, 1e3, 1e3, 1e3}},
  };
  return patterns;
}

// Columns of all views together, or of one.
Eigen::MatrixXd LensColumns(const PatternSystem& system, int views, int view,
                            const std::vector<int>& columns) {
  Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Zero(system.Size(), static_cast<Eigen::Index>(columns.size()));
  for (int v = 0; v < views; ++v)
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (view < 0 || v == view)
        matrix(system.ViewColumn(v, columns[i]), static_cast<Eigen::Index>(i)) = 1;
  return matrix;
}

// Whether the calibration adjusted this column of the lens.
std::vector<int> AdjustedLensColumns(const LensModel& model) {
  std::vector<int> columns = {0};
  if (model.aspect) columns.push_back(1);
  for (int i = 0; i < 5; ++i)
    if (model.distortion[static_cast<std::size_t>(i)]) columns.push_back(2 + i);
  if (model.telecentricity) columns.push_back(7);
  return columns;
}

bool BowsAreAdjusted(const CalibrationData& data, const ArrayState& state) {
  if (data.target.flatness_um > 0) return true;
  for (const BoardShape& board : state.target.boards)
    if (board.bow_x_mm != 0 || board.bow_y_mm != 0) return true;
  return false;
}

void Append(const Eigen::MatrixXd& columns, Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd joined(columns.rows(), matrix.cols() + columns.cols());
  joined << matrix, columns;
  matrix = joined;
}

int ViewCount(const ArrayState& state) { return static_cast<int>(state.array.views.size()); }

}  // namespace

Eigen::MatrixXd AdjustedColumns(const PatternSystem& system, const CalibrationData& data,
                                const ArrayState& state) {
  Eigen::MatrixXd adjusted(system.Size(), 0);
  const std::vector<int> lens = AdjustedLensColumns(state.array.model);
  const int views = ViewCount(state);
  if (state.array.lenses.size() == 1) Append(LensColumns(system, views, -1, lens), adjusted);
  for (int view = 0; view < views; ++view) {
    if (state.array.lenses.size() > 1) Append(LensColumns(system, views, view, lens), adjusted);
    Append(LensColumns(system, views, view, {8, 9, 10, 11, 12}), adjusted);
  }
  if (!BowsAreAdjusted(data, state)) return adjusted;
  for (std::size_t board = 0; board < data.target.boards.size(); ++board)
    for (const int column : {Layout::kBowX, Layout::kBowY})
      Append(
          Eigen::VectorXd::Unit(system.Size(), system.BoardColumn(static_cast<int>(board), column)),
          adjusted);
  return adjusted;
}

std::vector<KnownPattern> KnownPatterns(const PatternSystem& system, const CalibrationData& data,
                                        const ArrayState& state) {
  std::vector<KnownPattern> patterns;
  const int views = ViewCount(state);
  for (const LensPattern& lens : LensPatterns())
    for (int view = lens.shared ? -1 : 0; view < views; ++view)
      patterns.push_back({lens.kind, view, -1, LensColumns(system, views, view, lens.columns),
                          lens.names, lens.shown_per_unit});
  for (int view = 0; view < views; ++view)
    patterns.push_back({PatternKind::kViewDrift,
                        view,
                        -1,
                        LensColumns(system, views, view, {Layout::kDrift, Layout::kDrift + 1}),
                        {"drift_u_px", "drift_v_px"},
                        {1, 1}});
  for (const BoardPattern& known : BoardPatterns())
    for (std::size_t board = 0; board < data.target.boards.size(); ++board) {
      Eigen::MatrixXd columns(system.Size(), 0);
      for (const int column : known.columns)
        Append(Eigen::VectorXd::Unit(system.Size(),
                                     system.BoardColumn(static_cast<int>(board), column)),
               columns);
      patterns.push_back(
          {known.kind, -1, static_cast<int>(board), columns, known.names, known.shown_per_unit});
    }
  return patterns;
}

std::vector<KnownPattern> ViewOffsets(const PatternSystem& system, const ArrayState& state) {
  std::vector<KnownPattern> patterns;
  const double scale = state.array.Magnification_px_per_mm();
  for (int view = 0; view < ViewCount(state); ++view)
    patterns.push_back(
        {PatternKind::kViewOffset,
         view,
         -1,
         LensColumns(system, ViewCount(state), view, {Layout::kOffset, Layout::kOffset + 1}),
         {"offset_u_px", "offset_v_px"},
         {scale, scale}});
  return patterns;
}

BundleOptions OptionsOf(const CalibrationData& data, const ArrayState& state) {
  BundleOptions options;
  options.model = state.array.model;
  options.model.per_view = state.array.lenses.size() > 1;
  options.estimate_bow = BowsAreAdjusted(data, state);
  return options;
}

}  // namespace telestrain
