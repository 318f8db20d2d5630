#pragma once

#include "diagnostics/pinhole_calibration.h"

namespace telestrain {

// The pinhole arm solved by libmrcal instead of by our own adjustment, from the same start.
//
// mrcal's target is one regular grid, so it cannot be told where the sub-boards of one plate lie
// (the trick of mrcal_telecentric.h needs parallel rays). Each group of views with its own
// sub-board is therefore a calibration of its own, as a user of mrcal's tools would do it, and the
// groups are put together by the rigid motion that brings the poses of the plate nearest to each
// other (least squares, all images alike). A corner has one weight, IsotropicWeight. The core must
// be locked. CalibratePinhole, which knows the plate, stays for free cores and for all views in one
// adjustment; on one group with the same weights both find the same (tested).
//
// With coefficients it takes about 1 s for 36 images, ten times as long as without: in units of
// mrcal they are of the order D^6, up to which its steps have to double some thirty times.
//
// errors_px are of each group by itself; `poses` those of the first group that sees the image;
// `iterations` counts runs of mrcal, which does not tell its steps. Fails (kEstimationFailed) when
// mrcal refuses or a corner comes to lie behind its camera.
Result<PinholeCalibration> CalibratePinholeWithMrcal(const Session& session,
                                                     const CalibrationData& data,
                                                     const ArrayState& telecentric,
                                                     const PinholeOptions& options);

}  // namespace telestrain
