#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/steps.h"
#include "base/value_names.h"
#include "report/template_list.h"

// telestrain report RESULTS
//   report     /data/results/report.pdf
//   verdict    pass
// telestrain report --list
//   layouts
//     acceptance      Acceptance report
//     calibration     Calibration report
//     reverification  Re-verification report
//     strain          Strain measurement report
//   languages
//     de              Deutsch
//     en              English
//     zh              中文

namespace telestrain {
namespace {

class ReportCommand : public Command {
 public:
  std::string Name() const override { return "report"; }
  std::string Summary() const override {
    return "decide the limits and write results.json and the PDF report";
  }
  std::string Example() const override {
    return "telestrain report results\n"
           "  telestrain report results --template calibration --language de\n"
           "  telestrain report results --template reverification --against last_year/report.pdf";
  }
  void AddOptions(CLI::App& app) override {
    app.add_option("RESULTS", results_, "results folder of the earlier steps")->type_name(kFolder);
    app.add_option("--template", choices_.layout,
                   "layout: acceptance, calibration, reverification, strain, or one of your own")
        ->type_name(Among({"acceptance", "calibration", "reverification", "strain"}))
        ->capture_default_str();
    app.add_option("--language", choices_.language, "language of the texts: en, de, zh")
        ->type_name(Among({"en", "de", "zh"}))
        ->capture_default_str();
    app.add_option("--templates", templates_,
                   "folder with your own layouts and texts; what it lacks is built in")
        ->type_name(kFolder);
    app.add_option("--against", against_,
                   "earlier results folder or report.pdf that a re-verification compares with")
        ->type_name(kPath);
    app.add_option("--archive-level", level_,
                   "PDF/A level: 3a (tagged, with attachments and signature fields) or 1b")
        ->capture_default_str()
        ->check(CLI::IsMember({"3a", "1b"}));
    app.add_flag("--list", list_, "name the layouts and languages and do nothing else");
  }
  Result<int> Run(Console& console) override {
    if (list_) return List(console);
    if (results_.empty())
      return Error{ErrorKind::kUsage,
                   "report: RESULTS is missing; name the results folder, or ask with --list"};
    TELESTRAIN_ASSIGN_OR_RETURN(const ResultsLock lock, ResultsLock::Take(results_));
    choices_.templates = templates_;
    choices_.against = against_;
    choices_.level = level_ == "1b" ? ArchiveLevel::k1b : ArchiveLevel::k3a;
    return ReportStep(results_, choices_, console);
  }

 private:
  Result<int> List(Console& console) const {
    TELESTRAIN_ASSIGN_OR_RETURN(const TemplateList list, ListTemplates(templates_));
    const auto say = [&](const char* heading, const std::vector<NamedTemplate>& names) {
      console.Say(heading);
      for (const NamedTemplate& name : names) {
        const std::size_t gap = name.name.size() < 16 ? 16 - name.name.size() : 1;
        console.Say("  " + name.name + std::string(gap, ' ') +
                    (name.fault.empty() ? name.title : "cannot be used: " + name.fault));
      }
    };
    say("layouts", list.layouts);
    say("languages", list.languages);
    return 0;
  }

  ReportChoices choices_;
  std::string results_, templates_, against_, level_ = "3a";
  bool list_ = false;
};

}  // namespace

std::unique_ptr<Command> MakeReportCommand() { return std::make_unique<ReportCommand>(); }

}  // namespace telestrain
