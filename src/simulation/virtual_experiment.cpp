#include "simulation/virtual_experiment.h"

#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/json_file.h"
#include "base/parallel.h"
#include "simulation/experiment_truth.h"
#include "simulation/gray_png.h"
#include "simulation/image_conditions.h"
#include "simulation/nominal_session.h"
#include "simulation/pipe_image.h"
#include "simulation/random_keys.h"
#include "simulation/sensor_readout.h"

namespace telestrain {
namespace {

// An image that is still to be made, with the instrument as it is then. Images, not rows, are
// shared among the threads: noise and compression of one then overlap with rendering another.
struct ImageOrder {
  std::string path;  // inside the session folder
  std::function<GrayImage(const VirtualInstrument&)> render;
};

// In the order in which they are taken.
std::vector<ImageOrder> OrderImages(const ExperimentTruth& truth, const PaintedPipe& paint,
                                    PlateTone tone) {
  std::vector<ImageOrder> orders;
  for (const PlateTruth& plate : truth.calibration)
    orders.push_back({plate.image, [&, tone](const VirtualInstrument& instrument) {
                        return RenderPlate(instrument, truth.target, plate.plate, 1, tone);
                      }});
  for (const PlateTruth& plate : truth.rulers)
    orders.push_back({plate.image, [&, tone](const VirtualInstrument& instrument) {
                        return RenderPlate(instrument, truth.ruler, plate.plate, 1, tone);
                      }});
  for (const PipeTruth& state : truth.pipe)
    orders.push_back({state.state.image, [&](const VirtualInstrument& instrument) {
                        return RenderPipe(instrument, paint, state.pipe, 1);
                      }});
  return orders;
}

Status WriteImage(const VirtualExperimentOptions& options, const VirtualInstrument& warm,
                  const ImageOrder& order, const std::filesystem::path& folder, int number) {
  const auto purpose = RandomKey(options.seed, RandomPurpose::kPixelNoise);
  const auto key = CombineKeys(purpose, static_cast<std::uint64_t>(number));
  const SensorModel sensor{options.bit_depth, options.noise_gray, options.full_well_electrons};
  const GrayImage ideal = order.render(InstrumentAtImage(options, warm, number));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string png, EncodePng(ReadOut(ideal, sensor, key)));
  return WriteFileAtomically(folder / order.path, png);
}

Status WriteImages(const VirtualExperimentOptions& options, const ExperimentTruth& truth,
                   const std::filesystem::path& folder, Console& console) {
  for (const char* name : {"calibration", "ruler", "pipe"})
    TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder / name));
  PaintedPipe paint;
  if (!truth.pipe.empty())
    paint = PaintPipe(truth.instrument, truth.pipe.front().pipe.radius_mm,
                      RandomKey(options.seed, RandomPurpose::kSpeckle));
  const std::vector<ImageOrder> orders = OrderImages(
      truth, paint, options.inverted ? PlateTone::kBrightSquares : PlateTone::kDarkSquares);
  const int count = static_cast<int>(orders.size());
  std::vector<Status> written(orders.size());
  std::atomic<int> done{0};
  ParallelFor(count, options.threads, [&](int i) {
    written[i] = WriteImage(options, truth.instrument, orders[i], folder, i);
    console.Progress("simulate", ++done, count);
  });
  for (const Status& status : written) TELESTRAIN_RETURN_IF_ERROR(status);
  return {};
}

// The drawing's session with the tables of this experiment.
Session SessionOf(Session session, const VirtualExperimentOptions& options,
                  const ExperimentTruth& truth) {
  for (const PlateTruth& plate : truth.calibration)
    session.calibration_images.push_back({plate.image, plate.pose, plate.stage_mm});
  for (const PlateTruth& plate : truth.rulers) session.ruler_images.push_back(plate.image);
  for (const PipeTruth& state : truth.pipe) session.pipe_states.push_back(state.state);
  if (!options.gauges || truth.pipe.empty()) return session;
  for (std::size_t i = 0; i < truth.pipe.front().state.gauges_microstrain.size(); ++i)
    session.gauge_columns.push_back("gauge_" + std::to_string(i + 1) + "_microstrain");
  return session;
}

// The truth must not be handed over with the session.
Status CheckTruthFile(const std::filesystem::path& folder,
                      const std::filesystem::path& truth_file) {
  std::error_code code;
  const auto inside = std::filesystem::weakly_canonical(truth_file, code)
                          .lexically_relative(std::filesystem::weakly_canonical(folder, code));
  if (inside.empty() || *inside.begin() == "..") return {};
  return Error{ErrorKind::kUsage, truth_file.string() +
                                      ": the truth would lie inside the session " +
                                      folder.string() + "; name a file beside it"};
}

Status CheckFolder(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "session.toml")) return {};
  return BadInput(folder.string() +
                  ": already holds a session; choose another folder or remove this one");
}

}  // namespace

Status WriteVirtualExperiment(const VirtualExperimentOptions& options,
                              const std::filesystem::path& folder,
                              const std::filesystem::path& truth_file, Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(CheckVirtualExperimentOptions(options));
  TELESTRAIN_RETURN_IF_ERROR(CheckFolder(folder));
  TELESTRAIN_RETURN_IF_ERROR(CheckTruthFile(folder, truth_file));
  const Session nominal = NominalSession(options);
  TELESTRAIN_ASSIGN_OR_RETURN(const ExperimentTruth truth, InventTruth(options, nominal));
  TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder));
  if (truth_file.has_parent_path())
    TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(truth_file.parent_path()));
  TELESTRAIN_RETURN_IF_ERROR(WriteImages(options, truth, folder, console));
  TELESTRAIN_RETURN_IF_ERROR(WriteJson(truth_file, TruthJson(options, truth)));
  return WriteSession(SessionOf(nominal, options, truth), folder);
}

}  // namespace telestrain
