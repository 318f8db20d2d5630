#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <set>

#include "app/command.h"
#include "app/results_folder.h"
#include "app/step_record.h"
#include "base/files.h"
#include "base/numbers.h"
#include "diagnostics/interchange.h"
#include "viz/export/paraview.h"
#include "viz/export/scene_files.h"
#include "viz/scene_from_results.h"

// clang-format off
// telestrain export RESULTS --out FOLDER
//   export     A1.cameramodel A2.cameramodel B1.cameramodel B2.cameramodel corners.vnl opencv.yaml in FOLDER
// telestrain export RESULTS --out FOLDER --format glb,paraview,stl,ply
//   export     scene.glb pipe.stl pipe.ply scene.vtm (198 pieces below scene) in FOLDER
// clang-format on

namespace telestrain {
namespace {

namespace fs = std::filesystem;
using NamedFiles = std::vector<std::pair<std::string, std::string>>;

const std::map<std::string, viz::SceneFormat> kSceneFormats = {
    {"glb", viz::SceneFormat::kGlb},
    {"paraview", viz::SceneFormat::kParaView},
    {"stl", viz::SceneFormat::kStl},
    {"ply", viz::SceneFormat::kPly}};

class ExportCommand : public Command {
 public:
  std::string Name() const override { return "export"; }
  std::string Summary() const override {
    return "write the calibration for mrcal and OpenCV, or the scene for 3-D programs";
  }
  std::string Example() const override {
    return "telestrain export results --out scene --format glb,paraview --state 3";
  }
  void AddOptions(CLI::App& app) override {
    app.add_option("RESULTS", results_, "results folder of a calibration")->required();
    app.add_option("--out", out_, "folder for the files; made when it does not exist")->required();
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
        ->capture_default_str();
    app.add_option("--quantity", quantity_,
                   "what colours the surface in glb: a point array of pipe_NNN.vtp "
                   "(default: axial strain)");
  }
  Result<int> Run(Console& console) override {
    TELESTRAIN_RETURN_IF_ERROR(CheckOptions());
    NamedFiles files;
    if (Wants("calibration")) TELESTRAIN_RETURN_IF_ERROR(AddCalibration(&files));
    TELESTRAIN_RETURN_IF_ERROR(AddScene(&files));
    return Write(files, console);
  }

 private:
  bool Wants(const std::string& format) const {
    return std::find(formats_.begin(), formats_.end(), format) != formats_.end();
  }

  Status CheckOptions() const {
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

  // An earlier export of more boards or states left pieces that the new index does not name.
  Status RemoveOldPieces(const NamedFiles& files) const {
    std::set<std::string> old;
    std::error_code code;
    for (fs::directory_iterator entry(fs::path(out_) / "scene", code), end; !code && entry != end;
         entry.increment(code))
      if (const std::string name = entry->path().filename().string(); viz::IsParaViewPiece(name))
        old.insert("scene/" + name);
    for (const auto& [name, bytes] : files) old.erase(name);
    for (const std::string& name : old)
      if (const fs::path path = fs::path(out_) / name; !fs::remove(path, code) && code)
        return OutputFailed(path.string() + ": an old piece cannot be removed: " + code.message() +
                            "; remove it by hand or choose another --out folder");
    return {};
  }

  // All bytes are there before the first is written.
  Result<int> Write(const NamedFiles& files, Console& console) const {
    std::string names;
    std::size_t pieces = 0;
    TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(out_));
    for (const auto& [name, bytes] : files) {
      const fs::path path = fs::path(out_) / name;
      const bool piece = name.starts_with("scene/");
      if (piece && pieces++ == 0) TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(path.parent_path()));
      TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(path, bytes));
      if (!piece) names += name + " ";
    }
    if (Wants("paraview")) TELESTRAIN_RETURN_IF_ERROR(RemoveOldPieces(files));
    if (pieces > 0) names += "(" + CountText(pieces, "piece") + " below scene) ";
    console.Say("export     " + names + "in " + out_);
    TELESTRAIN_RETURN_IF_ERROR(Record(files));
    return 0;
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

  std::string results_, out_, quantity_, state_ = "largest";
  std::vector<std::string> formats_ = {"calibration"};
};

}  // namespace

std::unique_ptr<Command> MakeExportCommand() { return std::make_unique<ExportCommand>(); }

}  // namespace telestrain
