#include "app/pages/page_texts.h"

#include <algorithm>

#include "base/check.h"

namespace telestrain {
namespace {

const NamedText kSessionFolder = {
    "SESSION/session.toml",
    "the instrument, its target, ruler and pipe and the limits; the tables beside it name the "
    "images"};
const NamedText kTrail = {"RESULTS/audit.jsonl",
                          "the audit trail: what was made from what, with which options"};

const PageText kMain = {
    "",
    "strain of pipes by a telecentric four-view camera",
    "telestrain measures the strain of aircraft hydraulic pipes without touching them. One "
    "camera "
    "with one telecentric lens looks through mirrors, so that one image holds four telecentric "
    "views, two stereo pairs. From a folder of such images telestrain calibrates the views, "
    "proves them on a ruler, measures the strain of the pipe in every state and writes a PDF "
    "acceptance report that can be signed.\n\n"
    "telestrain run does all of it; every step is a verb of its own as well. The same input and "
    "options give the same bytes, whatever the number of threads, the language or the time. "
    "Results go to standard output, all else to standard error. Files are replaced as a "
    "whole.\n\n"
    "--version says what an audit asks for: source revision, build, compiler, the libraries "
    "compiled against and loaded, file formats and vector instructions, a line each; with --json "
    "the same as JSON.",
    {{"SESSION", "a session folder: session.toml, tables in CSV and images"},
     {"RESULTS/report.pdf", "the report"},
     {"RESULTS/results.json",
      "every number of the report with its unit, uncertainty, limit and verdict"},
     {"RESULTS/dcc.xml", "the same results as a Digital Calibration Certificate"},
     {"RESULTS/calibration.json", "lens, views, poses and covariances"},
     {"RESULTS/residuals.csv", "the residual of every corner"},
     {"RESULTS/mrcal.json", "the diagnosis of the calibration"},
     {"RESULTS/detection.json", "what was detected, what was not used and why"},
     {"RESULTS/corners.vnl", "every corner, in mrcal's format"},
     {"RESULTS/corner_covariances.csv", "their covariances"},
     {"RESULTS/ruler.csv, RESULTS/ruler.json", "a line per image of the ruler"},
     {"RESULTS/strain.csv, RESULTS/strain.json", "a line per state of the pipe"},
     {"RESULTS/strain_components.csv",
      "membrane, bending, torsion and the strain at every gauge, with their uncertainties"},
     {"RESULTS/strain_states.jsonl",
      "every state with the hashes of what it was made from; an interrupted measure goes on from "
      "it"},
     {"RESULTS/pipe_000.vtp …", "the measured surface of every state, for ParaView"},
     {"RESULTS/inputs.json", "every input file with its SHA-256, the program and its libraries"},
     {"RESULTS/session.toml, RESULTS/session.path",
      "the description of the session, and where it lay"},
     kTrail,
     {"RESULTS/pictures/*.png", "the scene at 300 dpi"},
     {"RESULTS/review.html", "all of it for a browser, after telestrain review"},
     {"/usr/share/fonts/truetype/liberation2, /usr/share/fonts/truetype/dejavu",
      "the fonts of report and pictures; /usr/share/fonts/truetype/wqy for Chinese"},
     {"/usr/share/color/icc/sRGB.icc", "the colours of the report"}},
    {},
    {"run", "telestrain-view(1)"}};

const std::vector<PageText> kSteps = {
    {"run",
     "",
     "Does the whole chain on a session: detect, calibrate, diagnose, verify, measure, render "
     "and "
     "report. It says a line per step and ends with the verdict. What a step that is repeated "
     "makes anew replaces its own and all later files of RESULTS, so that these are never of two "
     "runs.",
     {kSessionFolder, {"RESULTS", "every file that telestrain(1) lists"}, kTrail},
     {},
     {"detect", "calibrate", "diagnose", "verify", "measure", "render", "report"}},
    {"detect",
     "",
     "Finds the corners of the boards and the crosses of the ruler in the images of a session, "
     "each with its covariance. What is not used is listed with the reason.",
     {kSessionFolder,
      {"RESULTS/detection.json", "what was detected, what was not used and why"},
      {"RESULTS/corners.vnl", "every corner, in mrcal's format"},
      {"RESULTS/corner_covariances.csv", "their covariances"},
      kTrail},
     {},
     {"run", "calibrate"}},
    {"calibrate",
     "",
     "Estimates lens, views and poses from the corners of all boards in one bundle adjustment, "
     "with their covariances.",
     {kSessionFolder,
      {"RESULTS/calibration.json", "lens, views, poses and covariances"},
      {"RESULTS/residuals.csv", "the residual of every corner"},
      {"RESULTS/comparison.json", "what moved since the calibration of --compare"},
      kTrail},
     {},
     {"detect", "diagnose", "verify", "export"}},
    {"diagnose",
     "",
     "Lets mrcal, an independent program, solve the same corners where it knows the model too, "
     "and compares; asks whether the residuals are noise and, if not, which known fault they "
     "look "
     "like; maps how well every view knows where it projects; calibrates pinhole cameras on the "
     "same corners.",
     {{"RESULTS/mrcal.json", "the diagnosis"}, kTrail},
     {},
     {"calibrate", "export"}},
    {"verify",
     "",
     "Measures the certified lengths of the ruler with the calibration and compares.",
     {kSessionFolder,
      {"RESULTS/ruler.csv, RESULTS/ruler.json", "a line per image of the ruler"},
      kTrail},
     {},
     {"calibrate", "measure"}},
    {"measure",
     "",
     "Measures the surface of the pipe and its strain in every state, against the reference "
     "state. With --watch the images are measured as a camera writes them, a line of strain for "
     "each.",
     {kSessionFolder,
      {"RESULTS/strain.csv, RESULTS/strain.json", "a line per state of the pipe"},
      {"RESULTS/strain_components.csv", "membrane, bending, torsion and the strain at every gauge"},
      {"RESULTS/strain_states.jsonl", "from which an interrupted run goes on"},
      {"RESULTS/pipe_000.vtp …", "the measured surface of every state"},
      kTrail},
     {},
     {"verify", "render", "telestrain-view(1)"}},
    {"render",
     "",
     "Draws the results off screen: the array, the rays, targets, rulers, the pipe and its "
     "strain, residuals. It needs no display.",
     {{"RESULTS/pictures/*.png", "the pictures"}, kTrail},
     {},
     {"review", "telestrain-view(1)"}},
    {"report",
     "",
     "Writes the report of a results folder, as PDF/A with tagged text, its numbers as JSON and "
     "as a Digital Calibration Certificate.",
     {{"RESULTS/report.pdf", "the report"},
      {"RESULTS/results.json", "every number of it"},
      {"RESULTS/dcc.xml", "the same results as a Digital Calibration Certificate"},
      kTrail},
     {},
     {"sign", "audit", "export"}}};

const std::vector<PageText> kTools = {
    {"review",
     "",
     "Writes verdict, pictures, tables and the scene, to turn and click, into one HTML file that "
     "opens offline.",
     {{"RESULTS/review.html", "the page"}, kTrail},
     {},
     {"render", "telestrain-view(1)"}},
    {"sign",
     "",
     "Adds a signature (PAdES) to a report, or the seal of the instrument, which comes first. "
     "Earlier signatures stay valid.",
     {{"REPORT", "report.pdf; replaced as a whole"},
      {"audit.jsonl", "the audit trail beside the report"}},
     {{"TELESTRAIN_KEY_PASSWORD", "unlocks the key; else --password-file or the terminal does"}},
     {"report", "audit"}},
    {"export",
     "",
     "Writes the calibration for mrcal and OpenCV, the scene for three-dimensional programs, or "
     "the Digital Calibration Certificate.",
     {{"FOLDER/*.cameramodel, FOLDER/corners.vnl, FOLDER/opencv.yaml", "--format calibration"},
      {"FOLDER/scene.glb", "--format glb"},
      {"FOLDER/scene.vtm, FOLDER/scene/", "--format paraview"},
      {"FOLDER/pipe.stl", "--format stl"},
      {"FOLDER/pipe.ply", "--format ply"}},
     {},
     {"calibrate", "report"}},
    {"simulate",
     "",
     "Writes a session as a virtual instrument would record it, and the truth beside it. The "
     "images follow from the geometry and the options alone: the same options give the same "
     "bytes.",
     {{"FOLDER/session.toml", "the session, written last"},
      {"FOLDER-truth.json", "what the evaluation has to find"}},
     {},
     {"run", "study", "design"}},
    {"study",
     "",
     "Repeats an experiment of the paper, or probes the method, with the virtual instrument and "
     "compares the outcome with its limits.",
     {{"FOLDER/study.json, FOLDER/study.pdf", "the outcome"}},
     {},
     {"simulate"}},
    {"design",
     "",
     "Traces the rays through the mirrors of an array and says where views lie, what is in "
     "focus, "
     "how large mirrors must be and how a mirror's error moves its view.",
     {{"FOLDER/design.json, FOLDER/rays.png", "the design"}},
     {},
     {"simulate"}},
    {"correlate",
     "",
     "Follows a grid of subsets from a reference image through further images, by digital image "
     "correlation. It needs no session and no instrument.",
     {{"FOLDER/IMG.csv", "displacement, strain, correlation and status of every point"},
      {"FOLDER/IMG.vtp, FOLDER/IMG.png", "the field, for ParaView and as a picture"},
      {"FOLDER/pattern.json", "what was found of the pattern"},
      {"FOLDER/correlate.json", "options and summary, written last"}},
     {},
     {"measure"}},
    {"audit",
     "",
     "Checks what was recorded of results and report (verify), repeats every recorded step and "
     "compares every byte (replay), or tells what was done (show). verify and replay end with 0 "
     "when all is as recorded and with 1 when it is not.",
     {kTrail, {"RESULTS/session.path", "where the session lay"}},
     {},
     {"sign", "report"}}};

const PageText kView = {
    "view",
    "results of telestrain in a window",
    "telestrain-view shows the results of telestrain(1) in a window: the views, the boards, "
    "the rulers and the strained pipe, to turn, to measure and to point at. It needs a "
    "display with OpenGL.",
    {{"RESULTS", "a results folder of telestrain(1)"}},
    {{"DISPLAY", "the display to open the window on"}},
    {"render", "review"},
    {{"0", "done"},
     {"2", "wrong usage"},
     {"3", "bad results"},
     {"5", "no display, or a file that cannot be written"},
     {"70", "a defect of the program"},
     {"128+N", "ended by signal N"}}};

const std::vector<PageText>& AllTexts() {
  static const std::vector<PageText> kTexts = [] {
    std::vector<PageText> texts = {kMain, kView};
    for (const auto& list : {kSteps, kTools}) texts.insert(texts.end(), list.begin(), list.end());
    return texts;
  }();
  return kTexts;
}

}  // namespace

const PageText& PageTextOf(const std::string& page) {
  const auto& texts = AllTexts();
  const auto found = std::find_if(texts.begin(), texts.end(),
                                  [&](const PageText& text) { return text.page == page; });
  TELESTRAIN_CHECK(found != texts.end(), "page_texts.cpp says nothing about '" + page + "'");
  return *found;
}

const std::vector<NamedText>& CommonEnvironment() {
  static const std::vector<NamedText> kEnvironment = {
      {"SOURCE_DATE_EPOCH",
       "when results say that they were made, in seconds since 1970, where the session gives no "
       "date; the clock is never asked"}};
  return kEnvironment;
}

}  // namespace telestrain
