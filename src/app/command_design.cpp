#include <CLI/CLI.hpp>

#include "app/command.h"
#include "base/files.h"
#include "base/value_names.h"
#include "optics/rig_design_output.h"
#include "session/session_rig.h"
#include "simulation/nominal_session.h"
#include "viz/rays_picture.h"

// clang-format off
// telestrain design
//   …
//   check                                         value       limit  unit  verdict
//   overlap of A1 and A2                        100.000  >=  90.000     %    holds
//   depth spread of A1 and A2                     2.469  <=   3.100    mm    holds
//   total field along the pipe                   33.402  >=  31.300    mm    holds
//   light lost at mirror edges, mean              9.220  <=  15.000     %    holds
// clang-format on

namespace telestrain {
namespace {

constexpr int kOutsideLimits = 1;

class DesignCommand : public Command {
 public:
  std::string Name() const override { return "design"; }
  std::string Summary() const override {
    return "trace rays through a rig's mirrors and check fields, focus, mirror sizes and "
           "tolerances";
  }
  std::string Example() const override {
    return "telestrain design session/session.toml --out design --numerical-aperture 0.02";
  }
  void AddOptions(CLI::App& app) override {
    app.add_option("SESSION", session_,
                   "session folder or session.toml whose views are given by mirrors [the paper's "
                   "array]")
        ->type_name(kPath);
    app.add_option("--out", out_, "folder for design.json and rays.png; made when it is not there")
        ->type_name(kFolder);
    app.add_option("--numerical-aperture", options_.numerical_aperture,
                   "on the object side [the largest with the lens' depth of field]")
        ->type_name("NA")
        ->check(CLI::Range(1e-4, 0.5));
    app.add_option("--mirror-margin-mm", options_.mirror_margin_mm,
                   "added to every side of a mirror; negative for smaller ones")
        ->type_name(kMillimetres)
        ->check(CLI::Range(-1000.0, 1000.0))
        ->capture_default_str();
    app.add_option("--mirror-size-mm", sizes_mm_,
                   "width and height of every path's first mirror, then of its second, … [as the "
                   "light needs]")
        ->type_name(kMillimetres)
        ->type_size(2)
        ->expected(0, 16)
        ->check(CLI::Range(1e-3, 1e4));
  }
  Result<int> Run(Console& console) override {
    for (const auto& [width_mm, height_mm] : sizes_mm_)
      options_.mirror_sizes_mm.emplace_back(width_mm, height_mm);
    TELESTRAIN_ASSIGN_OR_RETURN(const OpticalRig rig, Rig());
    TELESTRAIN_ASSIGN_OR_RETURN(const RigDesign design, AnalyseRig(rig, options_));
    for (const std::string& line : DesignTables(rig, design)) console.Say(line);
    if (!out_.empty()) TELESTRAIN_RETURN_IF_ERROR(Save(rig, design, console));
    return design.AllHold() ? 0 : kOutsideLimits;
  }

 private:
  Result<OpticalRig> Rig() const {
    if (!session_.empty()) return ReadRig(session_);
    VirtualExperimentOptions paper;
    paper.mirrors = true;
    Session session = NominalSession(paper);
    session.title = "The paper's array";
    return RigOfSession(session);
  }

  Status Save(const OpticalRig& rig, const RigDesign& design, Console& console) const {
    const std::filesystem::path folder(out_);
    TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder));
    TELESTRAIN_RETURN_IF_ERROR(
        WriteFileAtomically(folder / "design.json", DesignJson(rig, design)));
    TELESTRAIN_RETURN_IF_ERROR(viz::RenderRays(rig, design, folder / "rays.png"));
    console.Say("design     design.json and rays.png in " + folder.string());
    return {};
  }

  std::string session_, out_;
  std::vector<std::pair<double, double>> sizes_mm_;
  DesignOptions options_;
};

}  // namespace

std::unique_ptr<Command> MakeDesignCommand() { return std::make_unique<DesignCommand>(); }

}  // namespace telestrain
