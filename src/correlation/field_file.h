#pragma once

#include <string>
#include <vector>

#include "correlation/correlation_field.h"

namespace telestrain {

// Side of the virtual strain gauge on the reference, subset included.
int StrainGauge_px(const FieldOptions& options);

// What the numbers of both files mean, one sentence each: sign and frame of the displacement,
// strain definition and its gauge, uncertainty. options.step_px must be set.
std::vector<std::string> FieldDefinitions(const FieldOptions& options);

// The field without the points whose centre lies outside the mask: nobody asked for them.
CorrelationField PointsInside(CorrelationField field, const PixelMask& mask);

// One line per point of the field, row by row, with the columns
//   x_px,y_px,u_px,v_px,exx,eyy,exy,zncc,sigma_u_px,sigma_v_px,status
// Strains are plain ratios. `status` is "ok" or the reason (ToText); a point that failed keeps its
// place and status, its numbers are empty. A point that converged with too few neighbours for a
// strain has status ok and no strain.
std::string FieldCsv(const CorrelationField& field);

// The same as VTK XML PolyData, for ParaView: points at (x, y, 0) of the reference image in px, y
// down; point data displacement_px (3 components), exx_microstrain, eyy_microstrain,
// exy_microstrain, zncc, sigma_u_px, sigma_v_px and status (MatchStatus, 0 is ok); a quad where
// four neighbours of the grid converged, a vertex for every point in no quad. Numbers that do not
// exist are nan. `definitions` becomes a comment.
std::string FieldVtp(const CorrelationField& field, const std::vector<std::string>& definitions);

}  // namespace telestrain
