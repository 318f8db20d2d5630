#pragma once

#include "report/result_cells.h"

namespace telestrain {

// The sections of results.json, one function per input file. Each adds its tables and quantities
// and says in `draft.measured` whether its section was measured; a null `json` means that the file
// does not exist. Pure functions of their arguments.

// Customer lines, counts, software, files of inputs.json.
void AddInputs(const Json& inputs, const Json& strain, ResultsDraft& draft);
// Lens, views, reprojection, poses, boards found and rejected, stage, models, gauge.
void AddCalibration(const Json& calibration, const Json& detection, ResultsDraft& draft);
// The first part of it: what the lens and the views are.
void AddLensAndViews(const Json& calibration, ResultsDraft& draft);
// What mrcal.json says. The check against mrcal with its quantities: a disagreement of any kind is
// a fail; a check that was not made is a row without a limit. Then the parts below.
void AddDiagnosis(const Json& diagnosis, const Json& ruler, ResultsDraft& draft);
// Its part `residuals`: verdict, findings, tests, views, worst boards, outlier rule.
void AddResidualDiagnosis(const Json& residuals, ResultsDraft& draft);
// Its part `pinhole`: the arms beside the telecentric model, on the ruler images of `ruler`.
void AddPinhole(const Json& pinhole, const Json& ruler, ResultsDraft& draft);
// Length errors with their verdicts, summary and budget.
void AddRuler(const Json& ruler, ResultsDraft& draft);
// The part `acceptance` of ruler.json: trends, bias, spread, repeatability.
void AddRulerAcceptance(const Json& acceptance, ResultsDraft& draft);
// States, comparison with the gauges, pipe, budget, correlation settings.
void AddStrain(const Json& strain, const Json& calibration, ResultsDraft& draft);

// What strain.json says of the sequence: regression, cycles, drift, noise floors, classes, gauges.
void AddSequence(const Json& strain, ResultsDraft& draft);

// The limits and the rule of inputs.json.
Acceptance ReadAcceptance(const Json& inputs);

}  // namespace telestrain
