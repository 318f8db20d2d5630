#pragma once

#include <filesystem>

#include "base/result.h"

namespace telestrain {

// Lays a study.json out as a PDF (A4, fonts embedded, bookmarks): title, question, answer and the
// comparison with the paper on the first page, then plots, images, tables, notes and settings. Same
// input, same bytes. study.json (schema "telestrain.study/1"), where only schema, study and title
// must be there and an empty or missing section is left out:
//
//   {"schema", "study": "paper-simulation", "title", "question": one sentence, "answer": text,
//    "comparison": [{"quantity", "unit", "paper": text, "ours": text, "limit": text,
//                    "met": true | false | null, "differs": text}],
//    "plots":  [{"id", "title", "caption",
//                "x": {"label", "log": bool, "low", "high"}, "y": {the same},
//                "series": [{"name", "kind": "line" | "markers" | "bars" | "step",
//                            "x": [..], "y": [..], "half_height": [..]}],
//                "limits": [{"y": number, "text"}]}],
//    "images": [{"file": path relative to study.json, "caption"}],
//    "tables": [{"id", "title", "columns": [{"name", "unit"}], "rows": [[cell, ..], ..]}],
//    "notes":  [text], "settings": [{"name", "value": text | number | bool, "unit"}]}
//
// A cell is a number (printed with 4 significant digits), a text, null (blank), or a number with
// the text to print, {"value": number, "printed": text}. Bars and steps stand at x, as wide as the
// distance of the values; they start at 0. `half_height` makes error bars. `low` and `high` of an
// axis widen its range. On a logarithmic axis every value must be positive; null in x or y leaves
// a gap.
//
// Fails with kBadInput (missing or malformed, with the JSON pointer and what was wanted) or
// kOutputFailed (fonts missing, disk), and then leaves no file.
Status WriteStudyReport(const std::filesystem::path& study_json, const std::filesystem::path& pdf);

}  // namespace telestrain
