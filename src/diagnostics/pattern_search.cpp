#include "diagnostics/pattern_search.h"

#include <algorithm>
#include <cmath>

#include "diagnostics/noise_distributions.h"
#include "diagnostics/pattern_misfit.h"

namespace telestrain {
namespace {

// A later pattern must explain this share of what the first one did: below it may be what the
// first leaves because its effect is not quite linear.
constexpr double kLinearShare = 0.01;
// Schwarz's criterion differs by more when the corners tell two patterns apart (Kass and Raftery,
// J. Am. Stat. Assoc. 90, 1995: very strong evidence).
constexpr double kDecisiveGain = 10;
constexpr std::size_t kFewestImages = 3;  // below, the array is not determined

std::vector<BoardData> BoardsOfImage(const CalibrationData& data, int image) {
  std::vector<BoardData> boards;
  for (const BoardData& board : data.boards)
    if (board.image == image) boards.push_back(board);
  return boards;
}

void SetMisfit(PatternKind kind, int view, int board, PatternFinding& finding) {
  finding.kind = kind;
  finding.view = view;
  finding.board = board;
}

}  // namespace

PatternSearch::PatternSearch(const CalibrationData& data, const ArrayState& state,
                             const PatternOptions& options)
    : original_(data), data_(data), state_(state), options_(options) {
  for (std::size_t i = 0; i < data.images.size(); ++i) image_.push_back(static_cast<int>(i));
  Prepare();
}

void PatternSearch::Prepare() {
  system_ = std::make_unique<PatternSystem>(data_, state_);
  offsets_ = ViewOffsets(*system_, state_);
  offset_fits_.clear();
  for (const KnownPattern& offset : offsets_) offset_fits_.push_back(system_->Fit(offset.columns));
  squares_with_offsets_ = system_->Squares();
  system_->TakeOut(AdjustedColumns(*system_, data_, state_));
  patterns_ = KnownPatterns(*system_, data_, state_);
  least_explained_ = 0;
}

std::vector<PatternCandidate> PatternSearch::Candidates() const {
  std::vector<PatternCandidate> all;
  for (const KnownPattern& p : patterns_)
    all.push_back(
        {p.kind, p.view, p.board, -1, &p, {}, system_->Fit(p.columns), system_->Squares(), 1});
  for (std::size_t i = 0; i < offset_fits_.size(); ++i)
    all.push_back({offsets_[i].kind,
                   offsets_[i].view,
                   -1,
                   -1,
                   &offsets_[i],
                   {},
                   offset_fits_[i],
                   squares_with_offsets_,
                   1});
  std::vector<std::vector<std::size_t>> of_image(data_.images.size());
  for (std::size_t b = 0; b < data_.boards.size(); ++b) {
    const BoardData& board = data_.boards[b];
    of_image[static_cast<std::size_t>(board.image)].push_back(b);
    all.push_back({PatternKind::kBoardMisfit,
                   board.view,
                   board.geometry.board,
                   board.image,
                   nullptr,
                   {b},
                   system_->FitBoards({b}),
                   system_->Squares(),
                   1});
  }
  for (std::size_t image = 0; image < of_image.size(); ++image)
    if (of_image[image].size() > 1)
      all.push_back({PatternKind::kImageMisfit, -1, -1, static_cast<int>(image), nullptr,
                     of_image[image], system_->FitBoards(of_image[image]), system_->Squares(), 1});
  std::vector<double> p_values;
  for (const PatternCandidate& candidate : all) p_values.push_back(candidate.fit.p_value);
  const std::vector<double> adjusted = HolmAdjusted(p_values);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].adjusted_p = adjusted[i];
  return all;
}

bool PatternSearch::FindOne() {
  const std::vector<PatternCandidate> all = Candidates();
  asked = std::max(asked, static_cast<int>(all.size()));
  const PatternCandidate* best = nullptr;
  for (const PatternCandidate& candidate : all)
    if (candidate.adjusted_p < options_.significance &&
        candidate.fit.explained > least_explained_ &&
        (!best || candidate.fit.schwarz_gain > best->fit.schwarz_gain))
      best = &candidate;
  if (!best) return false;
  PatternFinding finding = FindingOf(*best, all);
  bool go_on = true;
  if (!best->pattern) {
    go_on = LeaveOut(*best, finding);
  } else if (best->kind == PatternKind::kViewOffset) {
    offset_fits_.clear();  // the adjusted columns hold it: the rest never sees it
    offsets_.clear();
  } else {
    system_->TakeOut(best->pattern->columns);
    least_explained_ = std::max(least_explained_, kLinearShare * best->fit.explained);
  }
  Describe(original_, state_, finding);
  findings.push_back(finding);
  return go_on;
}

// Root mean square of what the candidate explains, over the corners that it touches, in px.
double PatternSearch::TouchedRms_px(const PatternCandidate& c) const {
  double whitened = 0, squares_px2 = 0;
  int scalars = 0;
  for (const BoardData& board : data_.boards) {
    const bool touched = (c.view < 0 || board.view == c.view) &&
                         (c.board < 0 || board.geometry.board == c.board) &&
                         (c.image < 0 || board.image == c.image);
    if (!touched) continue;
    for (const Eigen::Matrix2d& w : board.whitening) whitened += w.squaredNorm() / 2;
    scalars += 2 * static_cast<int>(board.Count());
  }
  squares_px2 = c.fit.explained / (2 * whitened / scalars);
  return std::sqrt(squares_px2 / scalars);
}

PatternFinding PatternSearch::FindingOf(const PatternCandidate& best,
                                        const std::vector<PatternCandidate>& all) const {
  PatternFinding finding;
  finding.kind = best.kind;
  finding.view = best.view;
  finding.board = best.board;
  finding.image = best.image < 0 ? -1 : image_[static_cast<std::size_t>(best.image)];
  finding.rms_px = TouchedRms_px(best);
  finding.share_of_squares = best.fit.explained / best.squares;
  finding.parameters = best.fit.rank;
  finding.f_statistic = best.fit.f_statistic;
  finding.p_value = best.fit.p_value;
  finding.adjusted_p_value = best.adjusted_p;
  if (!best.pattern) return finding;
  for (std::size_t i = 0; i < best.pattern->names.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double scale = best.pattern->shown_per_unit[i];
    finding.values.push_back(
        {best.pattern->names[i], scale * best.fit.values[row], scale * best.fit.sigmas[row]});
  }
  for (const PatternCandidate& other : all) {
    if (&other == &best || !other.pattern || other.adjusted_p >= options_.significance ||
        other.fit.schwarz_gain < best.fit.schwarz_gain - kDecisiveGain)
      continue;
    PatternFinding named;
    named.kind = other.kind;
    named.view = other.view;
    named.board = other.board;
    Describe(original_, state_, named);
    finding.alternatives.push_back(named.name);
  }
  return finding;
}

void PatternSearch::DropImage(int image) {
  std::erase_if(data_.boards, [&](const BoardData& board) { return board.image == image; });
  for (BoardData& board : data_.boards) board.image -= board.image > image;
  data_.images.erase(data_.images.begin() + image);
  state_.poses.erase(state_.poses.begin() + image);
  image_.erase(image_.begin() + image);
}

bool PatternSearch::Adjust() {
  if (data_.images.size() < kFewestImages) return false;
  auto adjusted = AdjustBundle(data_, state_, OptionsOf(data_, state_));
  if (adjusted) state_ = std::move(adjusted).value().state;
  return adjusted.ok();
}

// Leaves the image out and adjusts the rest. When one of its boards alone is to blame, the others
// come back. False when the rest cannot be adjusted.
bool PatternSearch::LeaveOut(const PatternCandidate& misfit, PatternFinding& finding) {
  const CalibrationData with_image = data_;
  const int image = misfit.image;
  const TargetPose start = state_.poses[static_cast<std::size_t>(image)];
  const std::vector<BoardData> boards = BoardsOfImage(data_, image);
  DropImage(image);
  if (!Adjust()) return false;
  Prepare();
  const double sigma0 = std::sqrt(system_->Squares() / std::max(1, system_->Degrees()));
  const ImageMisfit found = ExamineImage(boards, data_.target, state_, start, sigma0);
  if (found.culprit < 0) {
    SetMisfit(PatternKind::kImageMisfit, -1, -1, finding);
    return true;
  }
  const BoardData& culprit = boards[static_cast<std::size_t>(found.culprit)];
  SetMisfit(found.labels.IsMislabelled() ? PatternKind::kMislabelled : PatternKind::kBoardMisfit,
            culprit.view, culprit.geometry.board, finding);
  finding.labels = found.labels;
  finding.rms_px = found.labels.rms_as_labelled_px;
  data_ = with_image;
  std::erase_if(data_.boards, [&](const BoardData& board) {
    return board.image == image && board.view == culprit.view;
  });
  state_.poses.insert(state_.poses.begin() + image, found.pose);
  image_.insert(image_.begin() + image, finding.image);
  if (!Adjust()) return false;
  Prepare();
  return true;
}

}  // namespace telestrain
