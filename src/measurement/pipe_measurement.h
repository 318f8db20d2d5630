#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/console.h"
#include "measurement/gauge_comparison.h"
#include "measurement/sequence_statistics.h"
#include "measurement/strain.h"

namespace telestrain {

inline constexpr const char* kStrainSchema = "telestrain.strain/1";

struct MeasuredState {
  PipeState table;           // the row of pipe.csv
  std::string image_sha256;  // of the file that was measured; empty where that is not recorded
  StateStrain strain;
  std::vector<ViewMotion> from, motions;  // where the views were looked for, and found; per view
  std::optional<double> gauge_mean_microstrain;  // of the gauges that have a value
  std::optional<double>
      gauge_change_microstrain;  // mean change since the reference of those that read in both
  ComparedStrain compared;       // the camera's value beside that change
};

// The states hold no points: what they said of each point stands in the state's own file, so that
// a long sequence takes little memory.
struct PipeMeasurement {
  PipeGrid grid;
  PipeGeometry geometry;
  double magnification_px_per_mm = 0;
  PipeOptions options;
  std::vector<MeasuredState> states;       // the reference first
  std::vector<std::string> gauge_columns;  // of pipe.csv, as the states' readings
  std::optional<GaugeComparison> comparison;
  std::vector<GaugeOutlier> gauge_outliers;
  std::vector<SequenceState> sequence_states;  // what `sequence` was made from
  SequenceStatistics sequence;
  double coverage_factor = 2;  // of the session, for its expanded uncertainties
};

// A subset of a sixteenth of the shortest side of a view, odd.
PipeOptions DefaultPipeOptions(const Session& session);

// Measures one state after the other. Every state starts from the motions of the one before it and
// is else a function of its image, the reference, the calibration and the options, so that a
// sequence that goes on from recorded motions gives the same bits as one that was never parted.
class PipeSequence {
 public:
  // Fails as PipeTracker::Start; the message begins with the reference's name.
  static Result<PipeSequence> Start(const Session& session, const ArrayCalibration& array,
                                    const PipeOptions& options, const PipeState& reference_table,
                                    const GrayImage& reference);

  const PipeGrid& grid() const { return tracker_.grid(); }
  const PipeGeometry& geometry() const { return geometry_; }
  // Where the next state starts.
  const std::vector<ViewMotion>& motions() const { return motions_; }

  // Fails (kEstimationFailed) when too few points are found; the next state then starts where this
  // one would have.
  Result<MeasuredState> Measure(const PipeState& table, const GrayImage& image);
  // Goes on from a state that was measured before, and fills in what its table says.
  void Recall(MeasuredState& state);

  // What all states say together; they are the sequence's, the reference first.
  PipeMeasurement Summary(std::vector<MeasuredState> states) const;

 private:
  PipeSequence(const Session& session, const ArrayCalibration& array, const PipeOptions& options,
               PipeTracker&& tracker, PipeGeometry&& geometry)
      : session_(session),
        array_(array),
        options_(options),
        tracker_(std::move(tracker)),
        geometry_(std::move(geometry)),
        model_(MakeStrainModel(session, tracker_.grid(), geometry_)) {}
  void FillGauges(MeasuredState& state) const;

  Session session_;
  ArrayCalibration array_;
  PipeOptions options_;
  PipeState reference_table_;
  PipeTracker tracker_;
  PipeGeometry geometry_;
  StrainModel model_;
  std::vector<ViewMotion> motions_;
};

// One image of a sequence.
struct PipeImage {
  PipeState table;
  std::string sha256;              // of the file; empty where nothing is recorded
  std::optional<GrayImage> image;  // always there for the first one, the reference
  // What an earlier run made of this very image: the state is not measured again.
  std::optional<MeasuredState> known;
};

// Where the images come from and what becomes of the states.
class PipeStream {
 public:
  virtual ~PipeStream() = default;
  // The next image, or nothing at the end. Called from a thread of its own while the image before
  // it is measured; no more than one image waits.
  virtual Result<std::optional<PipeImage>> Next() = 0;
  // Takes a state with its points, before they are dropped. `spent_ms`: for measuring it.
  virtual Status Keep(const PipeSequence& sequence, const PipeImage& image,
                      const MeasuredState& state, double spent_ms) = 0;
  // Whether to go on without an image that cannot be measured. No: its error ends the measurement.
  virtual bool Skip(const Error&) { return false; }
  // Lets a waiting Next return; called before the measurement ends for whatever reason.
  virtual void Stop() {}
};

// Measures every image of the stream. Fails with what a function of the stream fails with, and when
// an image cannot be measured that is not skipped.
Result<PipeMeasurement> MeasureStream(const Session& session, const ArrayCalibration& array,
                                      const PipeOptions& options, PipeStream& stream);

// Reads the pipe images of the session one after the other and measures every state against the
// first.
Result<PipeMeasurement> MeasurePipe(const Session& session, const ArrayCalibration& array,
                                    const PipeOptions& options, Console& console);

}  // namespace telestrain
