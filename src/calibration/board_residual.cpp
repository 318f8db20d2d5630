#include "calibration/board_residual.h"

#include <array>
#include <cmath>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

BoardShape ShapeOfBlock(const double* block) {
  return {block[0], block[1], block[2], block[3], block[4], block[5]};
}

}  // namespace

LensNumbers NumbersOfLens(const double* block, double unit_px_per_mm,
                          const Eigen::Vector2d& center_px) {
  LensNumbers lens;
  lens.unit_px_per_mm = unit_px_per_mm;
  lens.magnification_px_per_mm = unit_px_per_mm * block[0];
  lens.aspect = block[1];
  lens.center_px = center_px;
  double* coefficients[5] = {&lens.k1, &lens.k2, &lens.p1, &lens.p2, &lens.k3};
  for (std::size_t i = 0; i < 5; ++i)
    *coefficients[i] = block[i + 2] / std::pow(kScaleRadius_mm, kRadiusPower[i]);
  lens.telecentricity_per_mm = block[7];
  return lens;
}

// The board's image as a product: view * (pose * shape + origin) + offset, and its factors.
struct BoardResidual::Chain {
  Chain(const BoardResidual& self, double const* const* parameters)
      : lens(NumbersOfLens(parameters[kLens], self.model_.unit_px_per_mm, self.model_.center_px)),
        shape(ShapeMatrix(self.geometry_, *parameters[kPitch], ShapeOfBlock(parameters[kShape]))),
        view_vector(Eigen::Map<const Eigen::Vector3d>(parameters[kView])),
        sense(1, 1, self.model_.depth_sense) {
    const double* pose = parameters[kPose] + kPoseSize * self.model_.pose;
    pose_vector = Eigen::Map<const Eigen::Vector3d>(pose);
    array_from_target = ExpRotation(pose_vector);
    image_from_array = sense.asDiagonal() * ExpRotation(view_vector);
    turned = array_from_target * shape;
    in_array = turned;
    in_array.col(0) += Eigen::Map<const Eigen::Vector3d>(pose + 3);
    image = image_from_array * in_array;
    image(0, 0) += parameters[kView][3];
    image(1, 0) += parameters[kView][4];
    image(2, 0) += self.model_.depth_offset_mm;
  }
  LensNumbers lens;
  TargetFromBasis shape, turned, in_array;
  Eigen::Vector3d view_vector, pose_vector, sense;
  Eigen::Matrix3d array_from_target, image_from_array;
  ImageFromBasis image;

  // d(image) by every parameter of a block, in turn.
  template <typename Use>
  void ForEachDerivative(Block block, const BoardGeometry& geometry, const Use& use) const;
};

template <typename Use>
void BoardResidual::Chain::ForEachDerivative(Block block, const BoardGeometry& geometry,
                                             const Use& use) const {
  ImageFromBasis moved = ImageFromBasis::Zero();
  if (block == kView) {
    const Eigen::Matrix3d jacobian = LeftJacobian(view_vector);
    const TargetFromBasis in_camera = sense.asDiagonal() * (image_from_array * in_array);
    for (int i = 0; i < 3; ++i)
      use(i, ImageFromBasis(sense.asDiagonal() * (Skew(jacobian.col(i)) * in_camera)));
    for (int i = 0; i < 2; ++i) {
      moved.col(0) = Eigen::Vector3d::Unit(i);
      use(3 + i, moved);
    }
  } else if (block == kPose) {
    const Eigen::Matrix3d jacobian = LeftJacobian(pose_vector);
    for (int i = 0; i < 3; ++i)
      use(i, ImageFromBasis(image_from_array * Skew(jacobian.col(i)) * turned));
    for (int i = 0; i < 3; ++i) {
      moved.col(0) = image_from_array.col(i);
      use(3 + i, moved);
    }
  } else {
    const Eigen::Matrix3d image_from_target = image_from_array * array_from_target;
    const auto derivatives = ShapeDerivatives(geometry);
    if (block == kPitch) use(0, ImageFromBasis(image_from_target * derivatives[0]));
    for (int i = 0; block == kShape && i < kBoardShapeSize; ++i)
      use(i, ImageFromBasis(image_from_target * derivatives[static_cast<std::size_t>(i + 1)]));
  }
}

BoardResidual::BoardResidual(const BoardData& board, const BoardModel& model)
    : geometry_(board.geometry), corners_(board), model_(model) {
  set_num_residuals(model.plan.ColumnCount());
  *mutable_parameter_block_sizes() = {kLensSize, kViewSize, kPoseSize * model.poses, 1,
                                      kBoardShapeSize};
}

bool BoardResidual::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const Chain chain(*this, parameters);
  const int n = model_.plan.ColumnCount();
  Eigen::Map<Eigen::VectorXd> values(residuals, n);
  if (jacobians == nullptr) {
    values.setZero();
    values(n - 1) = std::sqrt(LossOfBoard(corners_, model_.plan, chain.lens, chain.image));
  } else {
    const GramFactor factor = FactorOfBoard(corners_, model_.plan, chain.lens, chain.image);
    values = factor.col(n - 1);
    for (const Block block : {kLens, kView, kPose, kPitch, kShape})
      if (jacobians[block] != nullptr) WriteJacobian(chain, factor, block, jacobians[block]);
  }
  return values.allFinite();
}

void BoardResidual::WriteJacobian(const Chain& chain, const GramFactor& factor, Block block,
                                  double* jacobian) const {
  const Eigen::Index n = factor.rows();
  const int size = parameter_block_sizes()[static_cast<std::size_t>(block)];
  Eigen::Map<RowMatrix> rows(jacobian, n, size);
  rows.setZero();
  const int images = model_.plan.ImageCount(), basis = model_.plan.BasisCount();
  if (block == kLens) {
    for (int i = 0, column = images; i < kLensSize; ++i)
      if (model_.plan.lens_free[static_cast<std::size_t>(i)]) rows.col(i) = factor.col(column++);
    return;
  }
  const int first = block == kPose ? kPoseSize * model_.pose : 0;
  chain.ForEachDerivative(block, geometry_, [&](int index, const ImageFromBasis& derivative) {
    std::array<double, kMaxColumns> by_column{};
    for (int column = 0; column < images; ++column)
      by_column[static_cast<std::size_t>(column)] = derivative(column / basis, column % basis);
    for (int row = 0; row + 1 < n; ++row) {
      double sum = 0;
      for (int column = 0; column < images; ++column)
        sum += factor(row, column) * by_column[static_cast<std::size_t>(column)];
      rows(row, first + index) = sum;
    }
  });
}

double BoardResidual::Loss(double const* const* parameters) const {
  const Chain chain(*this, parameters);
  return LossOfBoard(corners_, model_.plan, chain.lens, chain.image);
}

Eigen::MatrixXd BoardResidual::Columns(double const* const* parameters) const {
  const Chain chain(*this, parameters);
  return ColumnsOfBoard(corners_, model_.plan, chain.lens, chain.image);
}

Eigen::VectorXd BoardResidual::ImageDerivative(double const* const* parameters, Block block,
                                               int index) const {
  const Chain chain(*this, parameters);
  const int basis = model_.plan.BasisCount();
  Eigen::VectorXd flat(model_.plan.ImageCount());
  chain.ForEachDerivative(block, geometry_, [&](int at, const ImageFromBasis& derivative) {
    for (int i = 0; at == index && i < flat.size(); ++i) flat(i) = derivative(i / basis, i % basis);
  });
  return flat;
}

}  // namespace telestrain
