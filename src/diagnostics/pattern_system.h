#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnostics/pattern_columns.h"

// Private to the diagnostics module: what a pattern explains of the residuals of a fit.
namespace telestrain {

// The least-squares fit of a pattern to what the calibration's own parameters cannot move.
struct PatternFit {
  int rank = 0;          // of the pattern in what the calibration leaves visible; 0: nothing to see
  double explained = 0;  // by how much the squares of the residuals fall
  Eigen::VectorXd values, sigmas;       // one per column of the pattern, in its unit
  double f_statistic = 0, p_value = 1;  // of `explained` against the remaining squares
  double schwarz_gain = 0;              // n log(squares before / after) - rank log(n)
};

// The normal equations of everything in PatternLayout over all boards, with the poses eliminated
// image by image. A pattern is tested with the calibration's free parameters beside it, so that
// the tests are exact for a linear model with normal noise: it does not matter that the residuals
// of a fit are not independent. Global columns: kViewSize for every view, then kBoardSize for every
// sub-board. The stage and the priors of a bow are not part of the equations: the corners know the
// poses a thousand times better than the stage does, and a bow counts as free.
class PatternSystem {
 public:
  PatternSystem(const CalibrationData& data, const ArrayState& state);

  int Size() const { return size_; }
  int ViewColumn(int view, int column) const { return view * PatternLayout::kViewSize + column; }
  int BoardColumn(int board, int column) const {
    return views_ * PatternLayout::kViewSize + board * PatternLayout::kBoardSize + column;
  }

  // Takes these combinations of global columns (Size() rows) out of everything that follows: what
  // the calibration adjusted, or a pattern that was found. Adds to what was taken out before.
  void TakeOut(const Eigen::MatrixXd& combinations);

  PatternFit Fit(const Eigen::MatrixXd& combinations) const;
  // Any affine change of the image of these boards (indices into CalibrationData::boards), all of
  // one image.
  PatternFit FitBoards(const std::vector<std::size_t>& boards) const;

  double Squares() const { return squares_; }  // of the residuals that nothing taken out explains
  int Degrees() const { return scalars_ - 6 * images_ - rank_; }

 private:
  using LocalGram = Eigen::Matrix<double, PatternLayout::kColumns, PatternLayout::kColumns>;
  struct PoseBlock {
    Eigen::Matrix<double, 6, 6> inverse = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::MatrixXd coupling;  // 6 x (Size() + 1)
  };
  // Place in the global columns of a column of a board; the residual is the last one.
  int GlobalColumn(const BoardData& board, int local) const;
  PatternFit Solve(const Eigen::MatrixXd& normal, const Eigen::VectorXd& right,
                   const Eigen::VectorXd& full_diagonal) const;

  const CalibrationData& data_;
  int views_ = 0, size_ = 0, images_ = 0, scalars_ = 0, rank_ = 0;
  double squares_ = 0;
  std::vector<LocalGram> grams_;  // one per board
  std::vector<PoseBlock> poses_;  // one per image
  Eigen::VectorXd diagonal_;      // of the Gram matrix before anything was eliminated
  Eigen::MatrixXd gram_;          // without the poses; the residual is the last row and column
  Eigen::MatrixXd projected_;     // and without what was taken out
  Eigen::MatrixXd taken_out_, taken_out_inverse_;
};

}  // namespace telestrain
