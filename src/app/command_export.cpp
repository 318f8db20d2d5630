#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/results_folder.h"
#include "base/files.h"
#include "diagnostics/interchange.h"

// clang-format off
// telestrain export RESULTS --out FOLDER
//   export     A1.cameramodel A2.cameramodel B1.cameramodel B2.cameramodel corners.vnl opencv.yaml in FOLDER
// clang-format on

namespace telestrain {
namespace {

namespace fs = std::filesystem;

class ExportCommand : public Command {
 public:
  std::string Name() const override { return "export"; }
  std::string Summary() const override {
    return "write the calibration for mrcal (.cameramodel, corners.vnl) and OpenCV (opencv.yaml)";
  }
  std::string Example() const override { return "telestrain export results --out interchange"; }
  void AddOptions(CLI::App& app) override {
    app.add_option("RESULTS", results_, "results folder of a calibration")->required();
    app.add_option("--out", out_, "folder for the files; made when it does not exist")->required();
  }
  Result<int> Run(Console& console) override {
    std::error_code unreadable;
    if (fs::equivalent(results_, out_, unreadable))
      return BadInput("--out " + out_ +
                      " is the results folder, whose corners.vnl must stay as it is; choose "
                      "another folder");
    TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results_, Step::kDiagnose));
    TELESTRAIN_ASSIGN_OR_RETURN(const Session session, RecordedSession(results_));
    TELESTRAIN_ASSIGN_OR_RETURN(const CalibrationRecord record,
                                ReadCalibrationRecord(session, results_));
    TELESTRAIN_ASSIGN_OR_RETURN(const auto files, InterchangeFiles(session, record));
    TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(out_));
    std::string names;
    for (const auto& [name, text] : files) {
      TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(fs::path(out_) / name, text));
      names += name + " ";
    }
    console.Say("export     " + names + "in " + out_);
    return 0;
  }

 private:
  std::string results_, out_;
};

}  // namespace

std::unique_ptr<Command> MakeExportCommand() { return std::make_unique<ExportCommand>(); }

}  // namespace telestrain
