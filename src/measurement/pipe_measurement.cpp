#include "measurement/pipe_measurement.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <utility>

#include "base/parallel.h"
#include "target/image_file.h"

namespace telestrain {
namespace {

// The rows of the session's table; keeps nothing.
class SessionImages : public PipeStream {
 public:
  SessionImages(const Session& session, Console& console) : session_(session), console_(console) {}

  Result<std::optional<PipeImage>> Next() override {
    if (row_ == session_.pipe_states.size()) return std::optional<PipeImage>{};
    PipeImage next;
    next.table = session_.pipe_states[row_++];
    TELESTRAIN_ASSIGN_OR_RETURN(
        next.image, ReadGrayImage(session_.folder / next.table.image, session_.sensor.width_px,
                                  session_.sensor.height_px));
    return std::optional<PipeImage>(std::move(next));
  }

  Status Keep(const PipeSequence&, const PipeImage&, const MeasuredState&, double) override {
    console_.Progress("measuring", ++kept_, static_cast<int>(session_.pipe_states.size()));
    return {};
  }

 private:
  const Session& session_;
  Console& console_;
  std::size_t row_ = 0;
  int kept_ = 0;
};

SequenceState StateOf(const MeasuredState& state, const PipeState& reference,
                      const std::vector<std::optional<double>>& gauge_sigmas) {
  constexpr double kMicro = 1e6;
  return {state.table.image,
          state.table.cycle,
          state.table.step,
          state.table.time_s,
          kMicro * state.compared.strain,
          kMicro * state.compared.standard_uncertainty,
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
void AddSequence(Session session, PipeMeasurement& measurement) {
  constexpr double kStill_px = 0.1;
  // Images that came while watching stand in no table of the session.
  session.pipe_states.clear();
  for (const MeasuredState& state : measurement.states) session.pipe_states.push_back(state.table);
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

// Measures the images as they come.
class StreamMeasurement {
 public:
  StreamMeasurement(const Session& session, const ArrayCalibration& array,
                    const PipeOptions& options, PipeStream& stream)
      : session_(session), array_(array), options_(options), stream_(stream) {}

  Result<PipeMeasurement> Run() {
    const Status ended = TakeAll();
    if (!ended) return ended.error();
    if (!sequence_)
      return EstimationFailed(came_ ? "no pipe image could serve as the reference; the first sound "
                                      "one does"
                                    : "no pipe image came before the end: nothing was measured");
    return sequence_->Summary(std::move(states_));
  }

 private:
  using Waiting = std::future<Result<std::optional<PipeImage>>>;

  // The next image is read while this one is measured.
  Status TakeAll() {
    // The future waits for the thread that Next may hold up, so it must be stopped first.
    Waiting waiting = Fetch();
    const std::unique_ptr<PipeStream, void (*)(PipeStream*)> stopper(
        &stream_, [](PipeStream* stream) { stream->Stop(); });
    for (;;) {
      TELESTRAIN_ASSIGN_OR_RETURN(std::optional<PipeImage> image, waiting.get());
      if (!image) return {};
      came_ = true;
      waiting = Fetch();
      const Status taken = Take(*image);
      if (!taken && !stream_.Skip(taken.error())) return taken;
    }
  }

  Waiting Fetch() {
    return std::async(BesideOwnWork(), [this] { return stream_.Next(); });
  }

  Status Take(PipeImage& image) {
    const auto start = std::chrono::steady_clock::now();
    if (!sequence_) {
      TELESTRAIN_CHECK(image.image.has_value(), "the reference image is needed in any case");
      auto started = PipeSequence::Start(session_, array_, options_, image.table, *image.image);
      if (!started) return started.error();
      sequence_ = std::move(started).value();
    }
    MeasuredState state;
    if (image.known) {
      state = std::move(*image.known);
      state.table = image.table;
      sequence_->Recall(state);
    } else {
      TELESTRAIN_CHECK(image.image.has_value(), "an image without pixels cannot be measured");
      TELESTRAIN_ASSIGN_OR_RETURN(state, sequence_->Measure(image.table, *image.image));
    }
    state.image_sha256 = image.sha256;
    const std::chrono::duration<double, std::milli> spent =
        std::chrono::steady_clock::now() - start;
    TELESTRAIN_RETURN_IF_ERROR(stream_.Keep(*sequence_, image, state, spent.count()));
    state.strain.points = {};
    states_.push_back(std::move(state));
    return {};
  }

  const Session& session_;
  const ArrayCalibration& array_;
  const PipeOptions& options_;
  PipeStream& stream_;
  bool came_ = false;  // an image
  std::optional<PipeSequence> sequence_;
  std::vector<MeasuredState> states_;
};

}  // namespace

PipeOptions DefaultPipeOptions(const Session& session) {
  PipeOptions options;
  int smallest = session.sensor.width_px;
  for (const NominalView& view : session.views)
    smallest = std::min({smallest, view.region.width, view.region.height});
  options.subset_px = std::clamp(smallest / 16, 10, 300) | 1;
  return options;
}

Result<PipeSequence> PipeSequence::Start(const Session& session, const ArrayCalibration& array,
                                         const PipeOptions& options,
                                         const PipeState& reference_table,
                                         const GrayImage& reference) {
  auto tracker = PipeTracker::Start(session, array, reference, options);
  if (!tracker)
    return Error{tracker.error().kind, reference_table.image + ": " + tracker.error().message};
  TELESTRAIN_ASSIGN_OR_RETURN(
      PipeGeometry geometry,
      MeasurePipeGeometry(array, tracker->grid(), session.pipe.outer_diameter_mm));
  PipeSequence sequence(session, array, options, std::move(tracker).value(), std::move(geometry));
  sequence.reference_table_ = reference_table;
  return sequence;
}

void PipeSequence::FillGauges(MeasuredState& state) const {
  state.gauge_mean_microstrain = MeanOfGauges(state.table);
  state.gauge_change_microstrain = ChangeOfGauges(reference_table_, state.table);
  state.compared =
      ComparedWithGauges(state.strain, session_.gauge_columns, reference_table_, state.table);
}

Result<MeasuredState> PipeSequence::Measure(const PipeState& table, const GrayImage& image) {
  TrackedState tracked = tracker_.Track(image, motions_);
  auto strain = AnalyseState(array_, grid(), tracked.points, model_,
                             TemperatureChange_k(reference_table_, table));
  if (!strain) return Error{strain.error().kind, table.image + ": " + strain.error().message};
  MeasuredState state;
  state.table = table;
  state.strain = std::move(strain).value();
  state.from = std::move(motions_);
  state.motions = motions_ = std::move(tracked.motions);
  FillGauges(state);
  return state;
}

void PipeSequence::Recall(MeasuredState& state) {
  motions_ = state.motions;
  FillGauges(state);
}

PipeMeasurement PipeSequence::Summary(std::vector<MeasuredState> states) const {
  PipeMeasurement measurement;
  measurement.grid = grid();
  measurement.geometry = geometry_;
  measurement.magnification_px_per_mm = array_.Magnification_px_per_mm();
  measurement.options = options_;
  measurement.states = std::move(states);
  measurement.gauge_columns = session_.gauge_columns;
  if (!measurement.states.empty()) AddSequence(session_, measurement);
  return measurement;
}

Result<PipeMeasurement> MeasureStream(const Session& session, const ArrayCalibration& array,
                                      const PipeOptions& options, PipeStream& stream) {
  return StreamMeasurement(session, array, options, stream).Run();
}

Result<PipeMeasurement> MeasurePipe(const Session& session, const ArrayCalibration& array,
                                    const PipeOptions& options, Console& console) {
  SessionImages images(session, console);
  return MeasureStream(session, array, options, images);
}

}  // namespace telestrain
