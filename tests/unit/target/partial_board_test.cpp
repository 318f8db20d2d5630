// Boards cut off by the view's edge or covered. TELESTRAIN_VIEWS=10000 runs more of them,
// TELESTRAIN_FIRST_SEED=500000 others.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <map>
#include <mutex>

#include "base/parallel.h"
#include "partial_view.h"

namespace telestrain {
namespace {

using testing::PartialView;

// What one view gave.
struct Outcome {
  bool decidable = false, found = false, partial = false;
  int wrong = 0, outliers = 0, corners = 0, seen = 0;
  std::string reason;
};

double Turn_rad(const testing::RandomView& view) {
  const Eigen::Matrix2d m = view.search.nominal_px_per_mm.inverse() * view.scene.side_px;
  return std::abs(std::atan2(m(1, 0) - m(0, 1), m(0, 0) + m(1, 1)));
}

// A board whose ends are to be seen, with the plate as bright as its squares, 20 corners, and a
// turn that leaves 20 deg to the next quarter.
bool IsDecidable(const PartialView& view) {
  const auto& scene = view.view.scene;
  const bool plate = scene.plate_gray == scene.dark_gray || scene.plate_gray == scene.bright_gray;
  return plate && view.CornersSeen() >= 20 && Turn_rad(view.view) < 0.55 &&
         (view.SeesBorder(true, false) || view.SeesBorder(true, true)) &&
         (view.SeesBorder(false, false) || view.SeesBorder(false, true));
}

Outcome RunView(std::uint32_t seed) {
  const PartialView view = testing::MakePartialView({}, seed);
  const auto& scene = view.view.scene;
  const BoardObservation observation = DetectBoard(view.image, view.view.search);
  Outcome outcome;
  outcome.decidable = IsDecidable(view);
  outcome.found = observation.rejected_because.empty();
  outcome.reason = observation.rejected_because.substr(0, 30);
  outcome.seen = view.CornersSeen();
  for (int i = 0; i < static_cast<int>(observation.corners.size()); ++i) {
    const auto& corner = observation.corners[static_cast<std::size_t>(i)];
    outcome.partial |= !corner;
    if (!corner) continue;
    const Eigen::Vector2d error =
        corner->pixel - scene.Corner(i % scene.columns, i / scene.columns);
    ++outcome.corners;
    outcome.wrong += error.norm() > 3;
    outcome.outliers += error.dot(corner->covariance_px2.inverse() * error) > 25;  // 5 sigma
  }
  return outcome;
}

TEST(PartialBoard, NeverGetsAWrongLabelAndSeldomNone) {
  const char* wanted = std::getenv("TELESTRAIN_VIEWS");
  const int count = wanted != nullptr ? std::atoi(wanted) : 1000;
  const char* first = std::getenv("TELESTRAIN_FIRST_SEED");
  const int first_seed = first != nullptr ? std::atoi(first) : 10000;
  std::vector<Outcome> outcomes(static_cast<std::size_t>(count));
  ParallelFor(count, 0, [&](int i) {
    outcomes[static_cast<std::size_t>(i)] = RunView(static_cast<std::uint32_t>(first_seed + i));
  });
  int decidable = 0, decided = 0, found = 0, partial = 0, corners = 0, outliers = 0, wrong = 0;
  int shown = 0, taken = 0;
  std::map<std::string, int> reasons;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    EXPECT_EQ(outcome.wrong, 0) << "seed " << static_cast<std::size_t>(first_seed) + i;
    decidable += outcome.decidable;
    decided += outcome.decidable && outcome.found;
    found += outcome.found;
    partial += outcome.found && outcome.partial;
    wrong += outcome.wrong > 0;
    corners += outcome.corners;
    outliers += outcome.outliers;
    if (outcome.found) shown += outcome.seen, taken += outcome.corners;
    if (outcome.decidable && !outcome.found) ++reasons[outcome.reason];
    if (wanted != nullptr && outcome.outliers > 0)
      std::cout << "seed " << static_cast<std::size_t>(first_seed) + i << ": " << outcome.outliers
                << " outliers\n";
  }
  std::cout << count << " views: found " << found << ", of them partial " << partial << "; wrong "
            << wrong << "; decidable " << decidable << ", found " << decided << "; corners "
            << corners << " (wholly visible in them " << shown << "), beyond 5 sigma " << outliers
            << "\n";
  for (const auto& [reason, times] : reasons) std::cout << "  " << times << " x " << reason << "\n";
  EXPECT_GT(decidable, count / 8);
  EXPECT_GE(decided, 0.95 * decidable);
  EXPECT_GT(partial, count / 10);
  EXPECT_LE(outliers, 1e-4 * corners);  // of chance, exp(-12.5): 4e-6
}

}  // namespace
}  // namespace telestrain
