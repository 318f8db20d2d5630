#include "diagnostics/diagnosis.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calibration/array_seed.h"

namespace telestrain {
namespace {

// As the calibration expects it: without the floor that only the weights know.
double ExpectedRmsOf(const CalibrationData& data, int degrees) {
  double variance_px2 = 0;
  for (const BoardData& board : data.boards)
    for (const Eigen::Matrix2d& w : board.whitening)
      variance_px2 += (w.transpose() * w).inverse().trace() / 2 - data.floor_px * data.floor_px;
  const auto corners = static_cast<double>(data.CornerCount());
  return std::sqrt(std::max(0.0, variance_px2) / corners * degrees / (2 * corners));
}

Result<IndependentOptimum> OptimumOf(const Session& session, const CalibrationRecord& record) {
  TELESTRAIN_ASSIGN_OR_RETURN(const ArraySeed seed, SeedArray(session, record.data));
  return CheckAgainstMrcal(record.data, record.state, StateFromSeed(session, seed));
}

// Boards that were left out by wish have nothing to explain.
void RemoveCulled(const Session& session, const CalibrationRecord& record, CalibrationData& all) {
  std::erase_if(all.boards, [&](const BoardData& board) {
    const auto& image = all.images[static_cast<std::size_t>(board.image)].image;
    const auto& view = session.views[static_cast<std::size_t>(board.view)].name;
    return std::any_of(record.data.rejected.begin(), record.data.rejected.end(),
                       [&](const RejectedObservation& r) {
                         return r.image == image && r.view == view && r.whole_board &&
                                r.reason == kCulledReason;
                       });
  });
}

}  // namespace

Result<Diagnosis> Diagnose(const Session& session, const CalibrationRecord& record,
                           const std::vector<BoardObservation>& observations,
                           const std::vector<CrossObservation>& crosses) {
  Diagnosis diagnosis;
  diagnosis.verdict = JudgeResiduals(record.data, record.state);
  diagnosis.residuals = ResidualsOf(record.data, record.state);
  diagnosis.expected_rms_px = ExpectedRmsOf(record.data, diagnosis.verdict.degrees);
  ResidualList replayed = diagnosis.residuals;
  diagnosis.outlier_replay = ReplayOutlierRule(replayed);
  diagnosis.noise_is_from_residuals = record.noise_is_assumed;
  TELESTRAIN_ASSIGN_OR_RETURN(CalibrationData all, CollectCalibrationData(session, observations));
  RemoveCulled(session, record, all);
  diagnosis.left_out = ExplainLeftOutBoards(all, record.data, record.state);
  auto optimum = OptimumOf(session, record);
  if (optimum)
    diagnosis.optimum = *optimum;
  else
    diagnosis.optimum_missing_because = optimum.error().message;
  TELESTRAIN_ASSIGN_OR_RETURN(
      const MeanMotionCovariance covariance,
      CovarianceWithMeanMotion(record.data, record.state, record.options, record.sigma0));
  diagnosis.maps = UncertaintyMaps(session, record.state.array, covariance);
  auto length = LengthUncertaintyOf(session, record.state.array, covariance);
  if (length)
    diagnosis.length = *length;
  else
    diagnosis.length_missing_because = length.error().message;
  auto pinhole = ComparePinhole(session, record.data, record.state, crosses);
  if (pinhole)
    diagnosis.pinhole = std::move(pinhole).value();
  else
    diagnosis.pinhole_missing_because = pinhole.error().message;
  return diagnosis;
}

}  // namespace telestrain
