#include "measurement/pipe_measurement.h"

#include <algorithm>

#include "target/image_file.h"

namespace telestrain {
namespace {

Result<GrayImage> ReadPipeImage(const Session& session, std::size_t row) {
  return ReadGrayImage(session.folder / session.pipe_states[row].image, session.sensor.width_px,
                       session.sensor.height_px);
}

SequenceState StateOf(const MeasuredState& state, const PipeState& reference,
                      const std::vector<std::optional<double>>& gauge_sigmas) {
  constexpr double kMicro = 1e6;
  return {state.table.image,
          state.table.cycle,
          state.table.step,
          state.table.time_s,
          kMicro * state.strain.axial_strain,
          kMicro * state.strain.standard_uncertainty,
          state.gauge_change_microstrain,
          SigmaOfGauges(reference, state.table, gauge_sigmas),
          state.strain.translation_mm,
          state.strain.rotation_rad};
}

std::optional<double> TemperatureChange_k(const PipeState& reference, const PipeState& state) {
  if (!reference.temperature_c || !state.temperature_c) return {};
  return *state.temperature_c - *reference.temperature_c;
}

// What all states together say, once they are measured.
void AddSequence(const Session& session, PipeMeasurement& measurement) {
  constexpr double kStill_px = 0.1;
  const auto gauge_sigmas = GaugeSigmas_microstrain(session);
  for (const MeasuredState& state : measurement.states)
    measurement.sequence_states.push_back(StateOf(state, session.pipe_states[0], gauge_sigmas));
  measurement.comparison = CompareWithGauges(measurement.sequence_states);
  measurement.gauge_outliers = FindGaugeOutliers(session);
  measurement.coverage_factor = session.acceptance.coverage_factor;
  measurement.sequence =
      AnalyseSequence(measurement.sequence_states,
                      {BaseLength_mm(measurement.grid), session.acceptance.coverage_factor,
                       kStill_px / measurement.magnification_px_per_mm});
}

}  // namespace

CorrelationOptions DefaultPipeOptions(const Session& session) {
  CorrelationOptions options;
  int smallest = session.sensor.width_px;
  for (const NominalView& view : session.views)
    smallest = std::min({smallest, view.region.width, view.region.height});
  options.subset_px = std::clamp(smallest / 16, 10, 300) | 1;
  return options;
}

Result<PipeMeasurement> MeasurePipe(const Session& session, const ArrayCalibration& array,
                                    const CorrelationOptions& options, Console& console) {
  const int total = static_cast<int>(session.pipe_states.size());
  TELESTRAIN_ASSIGN_OR_RETURN(const GrayImage reference, ReadPipeImage(session, 0));
  TELESTRAIN_ASSIGN_OR_RETURN(const PipeTracker tracker,
                              PipeTracker::Start(session, array, reference, options));
  PipeMeasurement measurement;
  measurement.grid = tracker.grid();
  TELESTRAIN_ASSIGN_OR_RETURN(
      measurement.geometry,
      MeasurePipeGeometry(array, tracker.grid(), session.pipe.outer_diameter_mm));
  const StrainModel model = MakeStrainModel(session, tracker.grid(), measurement.geometry);
  measurement.options = options;
  measurement.magnification_px_per_mm = array.Magnification_px_per_mm();
  for (std::size_t row = 0; row < session.pipe_states.size(); ++row) {
    TELESTRAIN_ASSIGN_OR_RETURN(const GrayImage image, ReadPipeImage(session, row));
    auto strain =
        AnalyseState(array, tracker.grid(), tracker.Track(image), model,
                     TemperatureChange_k(session.pipe_states[0], session.pipe_states[row]));
    if (!strain)
      return Error{strain.error().kind,
                   session.pipe_states[row].image + ": " + strain.error().message};
    MeasuredState state{session.pipe_states[row], std::move(strain).value(),
                        MeanOfGauges(session.pipe_states[row]),
                        ChangeOfGauges(session.pipe_states[0], session.pipe_states[row])};
    measurement.states.push_back(std::move(state));
    console.Progress("measuring", static_cast<int>(row) + 1, total);
  }
  AddSequence(session, measurement);
  return measurement;
}

}  // namespace telestrain
