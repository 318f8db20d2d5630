#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "app/changed_results.h"
#include "app/command.h"
#include "app/export_certificate.h"
#include "app/export_files.h"
#include "app/results_folder.h"
#include "app/results_lock.h"
#include "app/step_record.h"
#include "base/value_names.h"
#include "diagnostics/interchange.h"
#include "viz/export/scene_files.h"
#include "viz/scene_from_results.h"

// clang-format off
// telestrain export RESULTS --out FOLDER
//   export     A1.cameramodel A2.cameramodel B1.cameramodel B2.cameramodel corners.vnl opencv.yaml in FOLDER
// telestrain export RESULTS --out FOLDER --format glb,paraview,stl,ply
//   export     scene.glb pipe.stl pipe.ply scene.vtm (198 pieces below scene) in FOLDER
// telestrain export RESULTS --dcc certificate.xml --dcc-schema dcc-3.3.0
//   export     certificate.xml, valid against dcc.xsd in dcc-3.3.0
// clang-format on

namespace telestrain {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, viz::SceneFormat> kSceneFormats = {
    {"glb", viz::SceneFormat::kGlb},
    {"paraview", viz::SceneFormat::kParaView},
    {"stl", viz::SceneFormat::kStl},
    {"ply", viz::SceneFormat::kPly}};

class ExportCommand : public Command {
 public:
  std::string Name() const override { return "export"; }
  std::string Summary() const override {
    return "write the calibration for mrcal and OpenCV, the scene for 3-D programs, or the DCC";
  }
  std::string Example() const override {
    return "telestrain export results --out scene --format glb,paraview --state 3";
  }
  void AddOptions(CLI::App& app) override {
    app.add_option("RESULTS", results_, "results folder of a calibration")
        ->type_name(kFolder)
        ->required();
    app.add_option("--out", out_,
                   "folder for the files; made when it does not exist. Needed without --dcc")
        ->type_name(kFolder);
    app.add_option("--dcc", certificate_,
                   "file for the digital calibration certificate (DCC 3.3.0) of results.json")
        ->type_name(kFile);
    app.add_option("--dcc-schema", schema_,
                   "folder with dcc.xsd and its catalog.xml, to check the certificate against")
        ->type_name(kFolder);
    app.add_option("--format", formats_,
                   "one or more, separated by commas. calibration: .cameramodel and corners.vnl "
                   "for mrcal, opencv.yaml. glb: scene.glb (glTF 2.0). paraview: scene.vtm with "
                   "every state and quantity. stl: pipe.stl, the measured surface in mm. ply: "
                   "pipe.ply, its points with every quantity")
        ->delimiter(',')
        ->check(CLI::IsMember({"calibration", "glb", "paraview", "stl", "ply"}))
        ->capture_default_str();
    app.add_option("--state", state_,
                   "which state of the pipe goes into glb, stl and ply: its number from 0, its "
                   "image or 'largest'")
        ->type_name("STATE")
        ->capture_default_str();
    app.add_option("--quantity", quantity_,
                   "what colours the surface in glb: a point array of pipe_NNN.vtp "
                   "(default: axial strain)")
        ->type_name("QUANTITY");
  }
  Result<int> Run(Console& console) override {
    TELESTRAIN_RETURN_IF_ERROR(CheckOptions());
    TELESTRAIN_ASSIGN_OR_RETURN(const ResultsLock lock, ResultsLock::Take(results_));
    if (!certificate_.empty()) TELESTRAIN_RETURN_IF_ERROR(WriteCertificate(console));
    if (out_.empty()) return 0;
    NamedFiles files;
    if (Wants("calibration")) TELESTRAIN_RETURN_IF_ERROR(AddCalibration(&files));
    TELESTRAIN_RETURN_IF_ERROR(AddScene(&files));
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string names,
                                WriteExportedFiles(out_, files, Wants("paraview")));
    console.Say("export     " + names + "in " + out_);
    TELESTRAIN_RETURN_IF_ERROR(Record(files));
    return 0;
  }

 private:
  bool Wants(const std::string& format) const {
    return std::find(formats_.begin(), formats_.end(), format) != formats_.end();
  }

  Status WriteCertificate(Console& console) const {
    std::error_code unreadable;
    if (fs::exists(results_, unreadable) &&
        !fs::exists(fs::path(results_) / "audit.jsonl", unreadable))
      return BadInput(
          results_ +
          ": has no audit.jsonl, so that nothing tells whether its files are as they "
          "were measured; put it back, or make the results again with 'telestrain run'");
    TELESTRAIN_RETURN_IF_ERROR(RequireAsRecorded(results_));
    TELESTRAIN_RETURN_IF_ERROR(ExportCertificate(results_, certificate_, schema_));
    const std::string checked = schema_.empty() ? "" : ", valid against dcc.xsd in " + schema_;
    console.Say("export     " + certificate_ + checked);
    return {};
  }

  Status CheckOptions() const {
    if (out_.empty() && certificate_.empty())
      return Error{ErrorKind::kUsage, "nothing to write: give --out FOLDER or --dcc FILE"};
    if (!schema_.empty() && certificate_.empty())
      return Error{ErrorKind::kUsage, "--dcc-schema checks the certificate of --dcc FILE only"};
    std::error_code unreadable;
    if (fs::equivalent(results_, out_, unreadable))
      return BadInput("--out " + out_ +
                      " is the results folder, whose corners.vnl must stay as it is; choose "
                      "another folder");
    if (!quantity_.empty() && !Wants("glb"))
      return Error{ErrorKind::kUsage, "--quantity colours the scene of --format glb only"};
    if (state_ != "largest" && !Wants("glb") && !Wants("stl") && !Wants("ply"))
      return Error{ErrorKind::kUsage, "--state is for --format glb, stl and ply only"};
    return {};
  }

  Status AddCalibration(NamedFiles* files) const {
    TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results_, Step::kDiagnose));
    TELESTRAIN_ASSIGN_OR_RETURN(const Session session, RecordedSession(results_));
    TELESTRAIN_ASSIGN_OR_RETURN(const CalibrationRecord record,
                                ReadCalibrationRecord(session, results_));
    TELESTRAIN_ASSIGN_OR_RETURN(const auto interchange, InterchangeFiles(session, record));
    files->insert(files->end(), interchange.begin(), interchange.end());
    return {};
  }

  Status AddScene(NamedFiles* files) const {
    viz::SceneExport choice;
    for (const auto& [name, format] : kSceneFormats)
      if (Wants(name)) choice.formats.insert(format);
    if (choice.formats.empty()) return {};
    choice.state = state_;
    choice.quantity = quantity_;
    TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results_, Step::kRender));
    TELESTRAIN_ASSIGN_OR_RETURN(const viz::Scene scene, viz::SceneFromResults(results_));
    TELESTRAIN_ASSIGN_OR_RETURN(const auto scene_files, viz::SceneFiles(scene, choice));
    files->insert(files->end(), scene_files.begin(), scene_files.end());
    return {};
  }

  Status Record(const NamedFiles& files) const {
    StepRecord record = SceneRecord("export", results_);
    for (const char* name : {"corners.vnl", "corner_covariances.csv", "detection.json"})
      record.inputs.push_back(name);
    record.options = {{"format", formats_}, {"state", state_}, {"quantity", quantity_}};
    record.options["out"] = RecordedPlace(results_, out_);
    for (const auto& [name, bytes] : files) record.outputs.push_back(name);
    record.outputs_folder = out_;
    return RecordStep(results_, record);
  }

  std::string results_, out_, certificate_, schema_, quantity_, state_ = "largest";
  std::vector<std::string> formats_ = {"calibration"};
};

}  // namespace

std::unique_ptr<Command> MakeExportCommand() { return std::make_unique<ExportCommand>(); }

}  // namespace telestrain
