#include "correlation/field_tracker.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "base/check.h"
#include "correlation/field_matching.h"
#include "correlation/lost_points.h"
#include "correlation/point_chain.h"
#include "correlation/strain_field.h"

namespace telestrain {

using namespace correlation;

namespace {

using Starts = std::vector<std::optional<ShapeFunction>>;

Status Validate(const GrayImage& image, const FieldOptions& options) {
  const int subset = options.correlation.subset_px, window = options.strain_window_points;
  if (subset < 5 || subset % 2 == 0)
    return BadInput("the subset must have an odd side of at least 5 px, found " +
                    std::to_string(subset));
  if (options.step_px < 0)
    return BadInput("the step must be 0 (a quarter of the subset) or more, found " +
                    std::to_string(options.step_px) + " px");
  if (window < 3 || window % 2 == 0)
    return BadInput("the strain window must have an odd side of at least 3 points, found " +
                    std::to_string(window));
  const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height);
  if (options.mask && (options.mask->width != image.width || options.mask->height != image.height))
    return BadInput("the mask must have the size of the reference, " + size + " px, found " +
                    std::to_string(options.mask->width) + " x " +
                    std::to_string(options.mask->height));
  if (GridCenters(image.width, image.height, options).empty())
    return BadInput("no subset of " + std::to_string(subset) +
                    " px lies in the region and, with its border, in the image of " + size +
                    " px; choose a smaller subset or another region");
  return {};
}

// Of the points that can be measured, a failed one counting zero.
double MedianCorrelation(const std::vector<SubsetMatch>& matches) {
  std::vector<double> zncc;
  for (const SubsetMatch& match : matches)
    if (IsMeasurable(match.status)) zncc.push_back(match.ok() ? match.zncc : 0);
  if (zncc.empty()) return 1;  // nothing that another reference could better
  const auto middle = zncc.begin() + static_cast<std::ptrdiff_t>(zncc.size() / 2);
  std::nth_element(zncc.begin(), middle, zncc.end());
  return *middle;
}

}  // namespace

class FieldTracker::State {
 public:
  State(GrayImage reference, const FieldOptions& options)
      : options_(options),
        first_centers_(GridCenters(reference.width, reference.height, options)),
        centers_(first_centers_),
        masked_(MaskedPoints(first_centers_, options)),
        columns_(GridColumns(first_centers_)),
        reference_(std::move(reference)),
        bands_(std::in_place, reference_, options_, options_.mask ? &*options_.mask : nullptr) {
    for (const auto& center : first_centers_) points_.push_back(FirstLink(center));
  }

  CorrelationField Track(const GrayImage& image) {
    TELESTRAIN_CHECK(image.width == reference_.width && image.height == reference_.height,
                     "every image of a sequence must have the size of the reference");
    Starts starts;
    for (const SubsetMatch& match : previous_matches_)
      starts.push_back(match.ok() ? std::optional(match.shape) : std::nullopt);
    std::vector<SubsetMatch> matches = Match(image, starts);
    if (can_update_ && MedianCorrelation(matches) < options_.update_below_zncc)
      TryUpdate(image, matches);
    previous_ = image;
    previous_matches_ = matches;
    can_update_ = MedianCorrelation(matches) > 0;
    return ToField(std::move(matches));
  }

  const FieldOptions& options() const { return options_; }
  const std::vector<Eigen::Vector2i>& first_centers() const { return first_centers_; }

 private:
  std::vector<SubsetMatch> Match(const GrayImage& image, const Starts& starts) const {
    std::vector<char> left_out = masked_;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!points_[i].known) left_out[i] = 1;
    return FieldMatching{*bands_, {reference_, {0, 0}}, centers_, left_out, columns_, options_}
        .Match(image, starts);
  }

  // Puts the image before in the reference's place, and back when that is not better.
  void TryUpdate(const GrayImage& image, std::vector<SubsetMatch>& matches) {
    const std::vector<ChainedPoint> points = points_;
    Starts totals;
    for (std::size_t i = 0; i < points_.size(); ++i)
      totals.push_back(matches[i].ok() ? std::optional(Compose(points_[i], matches[i]).shape)
                                       : std::nullopt);
    points_ = NextLinks(points_, previous_matches_, columns_, options_.correlation.subset_px);
    SwapReference(false);
    Starts starts;
    for (std::size_t i = 0; i < points_.size(); ++i)
      starts.push_back(totals[i] && points_[i].known
                           ? std::optional(StartFor(points_[i], *totals[i]))
                           : std::nullopt);
    std::vector<SubsetMatch> again = Match(image, starts);
    // Points that the new reference does not show are lost with it, which counts against it.
    for (std::size_t i = 0; i < again.size(); ++i)
      if (!points_[i].known && !masked_[i]) again[i].status = MatchStatus::kLowCorrelation;
    if (MedianCorrelation(again) > MedianCorrelation(matches)) {
      ++updates_;
      matches = std::move(again);
      return;
    }
    points_ = points;
    SwapReference(updates_ == 0);
  }

  // The mask says which pixels of the first reference count, of later ones it says nothing.
  void SwapReference(bool to_first) {
    std::swap(reference_, previous_);
    for (std::size_t i = 0; i < points_.size(); ++i) centers_[i] = points_[i].center_px;
    bands_.emplace(reference_, options_, to_first && options_.mask ? &*options_.mask : nullptr);
  }

  CorrelationField ToField(std::vector<SubsetMatch> matches) const {
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (updates_ > 0 && points_[i].known) matches[i] = Compose(points_[i], matches[i]);
      if (!points_[i].known && !masked_[i]) matches[i].status = MatchStatus::kLowCorrelation;
    }
    CorrelationField field = MakeField(first_centers_, std::move(matches), options_);
    field.reference_updates = updates_;
    ComputeStrain(options_, field);
    return field;
  }

  FieldOptions options_;
  std::vector<Eigen::Vector2i> first_centers_, centers_;  // on the first and current reference
  std::vector<char> masked_;
  int columns_;
  GrayImage reference_, previous_;
  std::optional<ReferenceBands> bands_;
  std::vector<ChainedPoint> points_;
  std::vector<SubsetMatch> previous_matches_;  // with the current reference
  bool can_update_ = false;                    // there is an image before that was measured
  int updates_ = 0;
};

Result<FieldTracker> FieldTracker::Start(GrayImage reference, const FieldOptions& options) {
  TELESTRAIN_RETURN_IF_ERROR(Validate(reference, options));
  return FieldTracker(std::make_unique<State>(std::move(reference), options));
}

FieldTracker::FieldTracker(std::unique_ptr<State> state) : state_(std::move(state)) {}
FieldTracker::FieldTracker(FieldTracker&&) noexcept = default;
FieldTracker& FieldTracker::operator=(FieldTracker&&) noexcept = default;
FieldTracker::~FieldTracker() = default;

CorrelationField FieldTracker::Track(const GrayImage& image) { return state_->Track(image); }
const FieldOptions& FieldTracker::options() const { return state_->options(); }
const std::vector<Eigen::Vector2i>& FieldTracker::centers_px() const {
  return state_->first_centers();
}

}  // namespace telestrain
