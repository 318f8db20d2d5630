// Speed of the board's detection in one full-size view (1296 x 972 px, 13 x 9 corners, squares of
// 68 px) on one thread, with OpenCV's two detectors beside it, in turn, on the same view: counter
// "classics" is the time over that of findChessboardCorners with cornerSubPix (wanted: at most 2),
// "SBs" over that of findChessboardCornersSB with ACCURACY and EXHAUSTIVE (wanted: at most 0.1).
// Neither depends on how fast the machine is at the moment. Argument: blur in tenths of a pixel.
#include <benchmark/benchmark.h>

#include <chrono>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "target/target_detector.h"
#include "tests/unit/target/random_view.h"

namespace telestrain {
namespace {

testing::RandomView ViewOf(double blur_px) {
  testing::ViewLimits limits;
  limits.region = {0, 0, 1296, 972};
  limits.tilt_rad = 0.2;
  limits.turn_rad = 0.2;
  limits.shift_px = 30;
  for (std::uint32_t seed = 1;; ++seed) {
    testing::RandomView view = testing::MakeRandomView(limits, seed);
    if (view.LeastDistanceToEdge_px(1) < 5) continue;  // OpenCV wants a margin
    view.scene.dark_gray = 30;
    view.scene.bright_gray = view.scene.plate_gray = 210;
    view.scene.gradient *= 0.4;
    view.scene.blur_px = blur_px;
    return view;
  }
}

double Seconds(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool Classic(const cv::Mat1b& image) {
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(image, {13, 9}, corners)) return false;
  cv::cornerSubPix(image, corners, {11, 11}, {-1, -1},
                   {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 40, 1e-3});
  return true;
}

bool Sectors(const cv::Mat1b& image) {
  std::vector<cv::Point2f> corners;
  return cv::findChessboardCornersSB(image, {13, 9}, corners,
                                     cv::CALIB_CB_ACCURACY | cv::CALIB_CB_EXHAUSTIVE);
}

void Board(benchmark::State& state) {
  cv::setNumThreads(1);
  const auto view = ViewOf(0.1 * static_cast<double>(state.range(0)));
  const GrayImage image = testing::Render(view, 1);
  cv::Mat1b levels;
  cv::Mat1f(image.height, image.width, const_cast<float*>(image.pixels.data()))
      .convertTo(levels, CV_8U);
  levels = levels(cv::Rect(0, 0, 1296, 972)).clone();
  double own_s = 0, classic_s = 0, sectors_s = 0;
  bool all_found = true;
  for (auto _ : state) {
    const double once_s = Seconds(
        [&] { all_found = all_found && DetectBoard(image, view.search).rejected_because.empty(); });
    state.SetIterationTime(once_s);
    own_s += once_s;
    classic_s += Seconds([&] { all_found = Classic(levels) && all_found; });
    sectors_s += Seconds([&] { all_found = Sectors(levels) && all_found; });
  }
  if (!all_found) state.SkipWithError("a detector did not find the board");
  state.counters["classics"] = own_s / classic_s;
  state.counters["SBs"] = own_s / sectors_s;
}
BENCHMARK(Board)->Arg(8)->Arg(15)->Arg(30)->Arg(40)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace telestrain
