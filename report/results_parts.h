#pragma once

#include "report/calibration_changes.h"
#include "report/earlier_results.h"
#include "report/result_cells.h"

namespace telestrain {

// The sections of results.json, one function per input file. Each adds its tables and quantities
// and says in `draft.measured` whether its section was measured; a null `json` means that the file
// does not exist. Pure functions of their arguments.

// Of the changes with an uncertainty, how many are larger than U.
struct ChangeCount {
  int judged = 0;
  int changed = 0;
};
// After all quantities: facts of the earlier report (table "earlier"), every quantity that both
// have with its change, U of it (root sum of squares of both) and En number (table "changes"), and
// the sentences "changes" and "changes_note".
ChangeCount AddChanges(const EarlierResults& earlier, ResultsDraft& draft);
// What moved in the instrument: table "changes-calibration", sentence "changes_calibration".
ChangeCount AddCalibrationChanges(const std::vector<CalibrationChange>& changes,
                                  ResultsDraft& draft);
// The sentence "compared_with" for the first page.
void AddComparedWith(const EarlierResults& earlier, const ChangeCount& quantities,
                     const ChangeCount& calibration, ResultsDraft& draft);
// What ISO/IEC 17025 (7.8.2 to 7.8.6) wants of a report and the session's [document] says: the
// table "item", the table "statements" (uncertainty, what the results relate to, decision rule,
// authoriser), and the sentence "not_stated" of what a complete certificate would have too.
void AddItem(const Json& inputs, ResultsDraft& draft);
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
// States, comparison with the gauges, pipe, sequence.
void AddStrain(const Json& strain, ResultsDraft& draft);
// How the strain was correlated: settings, the iDICs reporting table, the noise floors.
void AddCorrelation(const Json& inputs, const Json& calibration, const Json& strain,
                    ResultsDraft& draft);
// The uncertainty budgets of the magnification, a length, a strain and the pipe's diameter: a table
// each and one of all, with shares, type, the combined and the expanded uncertainty.
void AddBudgets(const Json& calibration, const Json& ruler, const Json& strain,
                ResultsDraft& draft);

// What strain.json says of the sequence: regression, cycles, drift, noise floors, classes, gauges.
void AddSequence(const Json& strain, ResultsDraft& draft);

// The decision rule of this acceptance as a sentence.
Json RuleSentence(const Acceptance& acceptance);
// A key of the session as a label: "report_number" -> "Report number".
std::string KeyAsLabel(std::string key);
// The limits and the rule of inputs.json.
Acceptance ReadAcceptance(const Json& inputs);

}  // namespace telestrain
