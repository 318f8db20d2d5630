#include <Eigen/Geometry>

#include "target/target_detector.h"

namespace telestrain {
namespace {

// The target's axes are nominally those of the array; a sub-board may be turned on its plate.
TargetSearch SearchInView(const Session& session, const NominalView& view) {
  TargetSearch search;
  search.view = view.name;
  search.region = view.region;
  const TelecentricView nominal = session.NominalTelecentricView(view);
  search.nominal_px_per_mm =
      session.NominalMagnification_px_per_mm() * nominal.axes_in_array.leftCols<2>();
  return search;
}

}  // namespace

TargetSearch SearchForBoard(const Session& session, const NominalView& view) {
  TargetSearch search = SearchInView(session, view);
  search.columns = session.target.columns;
  search.rows = session.target.rows;
  search.square_mm = session.target.square_mm;
  if (const SubBoard* board = session.target.FindBoard(view.group))
    search.nominal_px_per_mm *= Eigen::Rotation2Dd(board->rotation_rad).toRotationMatrix();
  return search;
}

TargetSearch SearchForCross(const Session& session, const NominalView& view) {
  TargetSearch search = SearchInView(session, view);
  search.columns = search.rows = 1;
  return search;
}

}  // namespace telestrain
