#pragma once

#include <string>
#include <vector>

#include "app/correlate_setup.h"
#include "correlation/field_summary.h"
#include "viz/field_picture.h"

namespace telestrain {

// "600 of 625 points ok, mean u 0.1000 px, v -0.2000 px, exx 12.3 microstrain, noise …".
std::string SummaryLine(const FieldSummary& summary);

// The picture of one image's field. `show` is one of --show. The scene refers to `options`, which
// must outlive it.
viz::FieldScene SceneOfField(const CorrelationField& field, const FieldSummary& summary,
                             const FieldOptions& options, const std::string& show);

// The picture of the assessment: the noise that every subset lets one expect.
viz::FieldScene SceneOfPattern(const CorrelateSetup& setup, const GrayImage& reference);

}  // namespace telestrain
