#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/correlate_run.h"

// clang-format off
// telestrain correlate "Sample14 Reference.tif" "Sample14 L1 Amp0.1b.tif" --out dic
//   pattern    speckles … px wide, contrast … grey levels rms, noise …, saturated … %
//   pattern    recommended subset … px, step … px: expected noise … px in u and v, … microstrain
//   correlate  Sample14 L1 Amp0.1b.tif: … of … points ok, mean u … px, v … px, exx … microstrain, noise (1 sigma) … px, … microstrain
// clang-format on

namespace telestrain {
namespace {

class CorrelateCommand : public Command {
 public:
  std::string Name() const override { return "correlate"; }
  std::string Summary() const override {
    return "2-D image correlation of anybody's speckle images: displacement and strain fields";
  }
  std::string Example() const override {
    return "telestrain correlate ref.tif load_1.tif load_2.tif --out dic\n\n"
           "Writes for every image its name with .csv (x_px,y_px,u_px,v_px,exx,eyy,exy,zncc,\n"
           "sigma_u_px,sigma_v_px,status), .vtp (ParaView) and .png, before them the assessment "
           "of\n"
           "the pattern (pattern.txt, .json, .png), last correlate.json. A second image of the "
           "same\n"
           "name gets _2 added. u and v: image minus reference in px, x to the right, y down. "
           "exx,\n"
           "eyy, exy: Green-Lagrange strain of a plane through the displacements of the strain\n"
           "window, as a ratio; exy is the tensor's, half of gamma. Images: PNG, TIFF, BMP, PGM "
           "or\n"
           "JPEG of 8 or 16 bit.\n\n"
           "Exit codes: 0 done, 2 wrong usage, 3 bad image or mask, 4 an image without one point\n"
           "(all results are written), 5 a result could not be written";
  }
  void AddOptions(CLI::App& app) override { arguments_.AddTo(app); }
  Result<int> Run(Console& console) override {
    TELESTRAIN_RETURN_IF_ERROR(RunCorrelation(arguments_, console));
    return 0;
  }

 private:
  CorrelateArguments arguments_;
};

}  // namespace

std::unique_ptr<Command> MakeCorrelateCommand() { return std::make_unique<CorrelateCommand>(); }

}  // namespace telestrain
