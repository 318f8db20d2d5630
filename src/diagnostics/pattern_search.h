#pragma once

#include <memory>
#include <vector>

#include "diagnostics/pattern_catalogue.h"

// Private to the diagnostics module: one pattern after the other.
namespace telestrain {

// A pattern with what it explains.
struct PatternCandidate {
  PatternKind kind = PatternKind::kUnknown;
  int view = -1, board = -1, image = -1;
  const KnownPattern* pattern = nullptr;  // of the whole array
  std::vector<std::size_t> boards;        // of a misfit
  PatternFit fit;
  double squares = 0;  // before it
  double adjusted_p = 1;
};

// Asks for patterns, takes the strongest out, asks again.
class PatternSearch {
 public:
  PatternSearch(const CalibrationData& data, const ArrayState& state,
                const PatternOptions& options);
  // False when nothing significant is left.
  bool FindOne();
  int Degrees() const { return system_->Degrees(); }  // of freedom of the residuals

  std::vector<PatternFinding> findings;
  int asked = 0;

 private:
  void Prepare();
  std::vector<PatternCandidate> Candidates() const;
  PatternFinding FindingOf(const PatternCandidate& best,
                           const std::vector<PatternCandidate>& all) const;
  double TouchedRms_px(const PatternCandidate& candidate) const;
  bool LeaveOut(const PatternCandidate& misfit, PatternFinding& finding);
  bool Adjust();
  void DropImage(int image);

  const CalibrationData& original_;
  CalibrationData data_;
  ArrayState state_;
  PatternOptions options_;
  std::vector<int> image_;  // original index of every image that is left
  std::unique_ptr<PatternSystem> system_;
  std::vector<KnownPattern> patterns_, offsets_;
  std::vector<PatternFit> offset_fits_;
  double squares_with_offsets_ = 0;
  double least_explained_ = 0;
};

}  // namespace telestrain
