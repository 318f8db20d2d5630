#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "base/json_file.h"
#include "base/value_names.h"
#include "report/study_report.h"
#include "study/study.h"

// telestrain study paper-calibration --out study
//   quantity                                   paper  ours    limit
//   reprojection at 0.395 px noise: RMS / px   -      0.3949  0.3948 +- 1 %  met
//   ...
//   study      study/study.json
//   report     study/study.pdf

namespace telestrain {
namespace {

std::vector<std::string> StudyNames() {
  std::vector<std::string> names;
  for (const StudyInfo& info : AllStudies()) names.push_back(info.name);
  return names;
}

class StudyCommand : public Command {
 public:
  std::string Name() const override { return "study"; }
  std::string Summary() const override {
    return "repeat an experiment of the paper, or probe the method, with the virtual instrument";
  }
  std::string Example() const override {
    std::string text = "telestrain study paper-simulation --out study\n\nStudies:\n";
    for (const StudyInfo& info : AllStudies()) {
      const std::string name = info.name;
      text += "  " + name + std::string(18 - name.size(), ' ') + info.summary + "\n";
    }
    return text + "\nExit codes: 0 every limit is met, 1 one is not";
  }
  void AddOptions(CLI::App& app) override {
    app.add_option("STUDY", name_, "which study; the list stands below")
        ->type_name(Among(StudyNames()))
        ->required();
    app.add_option("--out", out_, "folder for study.json, study.pdf and the sessions")
        ->type_name(kFolder)
        ->required();
    app.add_option("--seed", options_.seed, "number that all randomness follows from")
        ->type_name(kCount)
        ->capture_default_str();
    app.add_option("--share", options_.share,
                   "share of the full number of images, poses and states (0.02 to 1)")
        ->type_name("SHARE")
        ->capture_default_str();
    app.add_option("--binning", options_.binning,
                   "pixels binned along each side where images are rendered (1 to 4)")
        ->type_name(kCount)
        ->capture_default_str();
    app.add_option("--threads", options_.threads, "threads; 0: one per core")
        ->type_name(kCount)
        ->capture_default_str();
  }
  Result<int> Run(Console& console) override {
    const std::filesystem::path folder(out_);
    TELESTRAIN_ASSIGN_OR_RETURN(const StudyResult result,
                                RunStudy(name_, options_, folder, console));
    const auto json = folder / "study.json", pdf = folder / "study.pdf";
    TELESTRAIN_RETURN_IF_ERROR(WriteJson(json, result.ToJson()));
    TELESTRAIN_RETURN_IF_ERROR(WriteStudyReport(json, pdf));
    console.Say(result.ComparisonText() + result.answer + "\n");
    console.Say("study      " + json.string());
    console.Say("report     " + pdf.string());
    return result.AllMet() ? 0 : 1;
  }

 private:
  StudyOptions options_;
  std::string name_, out_;
};

}  // namespace

std::unique_ptr<Command> MakeStudyCommand() { return std::make_unique<StudyCommand>(); }

}  // namespace telestrain
