#pragma once

#include <optional>
#include <vector>

#include "correlation/reference_bands.h"
#include "correlation/seed_search.h"

namespace telestrain::correlation {

// A grid of points on one reference, and how they are found in an image.
struct FieldMatching {
  const ReferenceBands& bands;
  SeedReference seeds;
  const std::vector<Eigen::Vector2i>& centers_px;
  const std::vector<char>& masked;  // one per point: it keeps the status kMasked
  int columns;
  const FieldOptions& options;

  // From one start per point, or from nothing when `starts` is empty. Where less than half of the
  // points that could converge did, the image is searched for the others as if nothing were known.
  std::vector<SubsetMatch> Match(const GrayImage& image,
                                 const std::vector<std::optional<ShapeFunction>>& starts) const;
};

// Of the step and the subset, with the default of the step.
int GridStep_px(const FieldOptions& options);

// The points of a grid whose centre is masked.
std::vector<char> MaskedPoints(const std::vector<Eigen::Vector2i>& centers_px,
                               const FieldOptions& options);

// The grid's columns: how many points the first row has.
int GridColumns(const std::vector<Eigen::Vector2i>& centers_px);

// Points without strain from the matches of a grid.
CorrelationField MakeField(const std::vector<Eigen::Vector2i>& centers_px,
                           std::vector<SubsetMatch> matches, const FieldOptions& options);

// Points that could converge: neither masked, saturated, without contrast nor beyond the image.
bool IsMeasurable(MatchStatus status);

}  // namespace telestrain::correlation
