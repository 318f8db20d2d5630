#pragma once

#include "report/page_flow.h"
#include "report/study_file.h"

namespace telestrain {

// Draws a plot over the whole width: title, legend, chart and caption together `height_pt` high (or
// higher where long texts need it), on one page.
void DrawStudyPlot(PageFlow& flow, const StudyPlot& plot, double height_pt);

}  // namespace telestrain
