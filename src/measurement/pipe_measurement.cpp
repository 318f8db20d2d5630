#include "measurement/pipe_measurement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "target/image_file.h"

namespace telestrain {
namespace {

Result<GrayImage> ReadPipeImage(const Session& session, std::size_t row) {
  return ReadGrayImage(session.folder / session.pipe_states[row].image, session.sensor.width_px,
                       session.sensor.height_px);
}

std::optional<double> MeanOfGauges(const PipeState& state) {
  double sum = 0;
  int count = 0;
  for (const auto& gauge : state.gauges_microstrain) {
    if (!gauge) continue;
    sum += *gauge;
    ++count;
  }
  if (count == 0) return {};
  return sum / count;
}

// Mean change since the reference of the gauges that read in both states.
std::optional<double> ChangeOfGauges(const PipeState& reference, const PipeState& state) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < state.gauges_microstrain.size(); ++i) {
    if (!state.gauges_microstrain[i] || !reference.gauges_microstrain[i]) continue;
    sum += *state.gauges_microstrain[i] - *reference.gauges_microstrain[i];
    ++count;
  }
  if (count == 0) return {};
  return sum / count;
}

std::optional<double> TemperatureChange_k(const PipeState& reference, const PipeState& state) {
  if (!reference.temperature_c || !state.temperature_c) return {};
  return *state.temperature_c - *reference.temperature_c;
}

std::optional<GaugeComparison> Compare(const std::vector<MeasuredState>& states) {
  std::vector<std::pair<double, double>> pairs;  // gauge, camera
  double variances = 0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (!states[i].gauge_change_microstrain) continue;
    pairs.emplace_back(*states[i].gauge_change_microstrain, 1e6 * states[i].strain.axial_strain);
    variances += std::pow(1e6 * states[i].strain.standard_uncertainty, 2);
  }
  if (pairs.empty()) return {};
  GaugeComparison comparison;
  comparison.standard_uncertainty_microstrain =
      std::sqrt(variances / static_cast<double>(pairs.size()));
  comparison.count = static_cast<int>(pairs.size());
  const double count = static_cast<double>(pairs.size());
  double gauge_mean = 0, camera_mean = 0, squares = 0;
  for (const auto& [gauge, camera] : pairs) {
    const double error = camera - gauge;
    squares += error * error;
    comparison.mean_error_microstrain += error / count;
    comparison.max_abs_error_microstrain =
        std::max(comparison.max_abs_error_microstrain, std::abs(error));
    gauge_mean += gauge / count;
    camera_mean += camera / count;
  }
  comparison.rms_error_microstrain = std::sqrt(squares / count);
  double xx = 0, xy = 0;
  for (const auto& [gauge, camera] : pairs) {
    xx += (gauge - gauge_mean) * (gauge - gauge_mean);
    xy += (gauge - gauge_mean) * (camera - camera_mean);
  }
  comparison.slope = xx > 0 ? xy / xx : std::numeric_limits<double>::quiet_NaN();
  comparison.intercept_microstrain = camera_mean - comparison.slope * gauge_mean;
  return comparison;
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
  measurement.comparison = Compare(measurement.states);
  return measurement;
}

}  // namespace telestrain
