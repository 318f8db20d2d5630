#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/files.h"
#include "base/json_file.h"
#include "report/acceptance_report.h"
#include "report/json_lookup.h"
#include "report/rgb_image.h"
#include "results_fixture.h"

// report_bench [FOLDER]
// The acceptance report with ten pictures of 2000 x 1300 px (300 dpi): seconds of its layout from
// results.json on, size, peak memory, and the processor time over that of zlib at level 6 on the
// same pixels in the same run. The report stays in FOLDER when it is named. Exits with 1 when a bar
// is missed: 3 s, 8 MB, 300 MB.

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr int kPictures = 10, kWidth_px = 2000, kHeight_px = 1300, kRuns = 5;
constexpr double kMost_s = 3, kMostSize_MB = 8, kMostMemory_MB = 300;

std::string PictureName(int index) { return "bench_" + std::to_string(index) + ".png"; }

// The acceptance layout without its own pictures, and ten of ours at its end.
void WriteLayout(const fs::path& folder) {
  auto layout = ReadJson(fs::path(TELESTRAIN_SOURCE_DIR) / "templates" / "acceptance.json",
                         "telestrain.template/1", "bench");
  Json blocks = Json::array();
  for (const Json& block : (*layout)["blocks"])
    if (TextAt(block, "/include") != "scene") blocks.push_back(block);
  for (int i = 0; i < kPictures; ++i)
    blocks.push_back({{"type", "picture"}, {"file", PictureName(i)}, {"caption", "Picture."}});
  (*layout)["blocks"] = blocks;
  if (!WriteJson(folder / "bench.json", *layout)) std::abort();
}

void WriteInputs(const fs::path& folder) {
  ResultsFixture fixture = PlausibleResults();
  fixture.pictures = false;
  WriteResults(fixture, folder);
  fs::create_directories(folder / "templates");
  WriteLayout(folder / "templates");
  for (int i = 0; i < kPictures; ++i)  // a row more each: no two are the same picture
    WritePicture(folder / "pictures" / PictureName(i), kWidth_px, kHeight_px + i);
  if (!MakeResults(folder)) std::abort();
}

// Of this process, whatever else the machine does.
double ProcessorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double Seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + kRuns / 2, values.end());
  return values[kRuns / 2];
}

struct Cost {
  double seconds = 0, processor_s = 0, peak_MB = 0;
};

// In a process of its own, so that its peak memory is the report's.
Cost MakeInChild(const fs::path& folder) {
  Cost cost;
  int status = 1;
  rusage usage{};
  cost.seconds = Seconds([&] {
    const pid_t child = fork();
    if (child == 0) {
      ReportOptions options;
      options.templates = folder / "templates";
      options.name = "bench";
      const Status written = WriteReport(folder, options);
      if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
      _exit(written ? 0 : 1);
    }
    wait4(child, &status, 0, &usage);
  });
  if (status != 0) std::exit(5);
  for (const timeval& time : {usage.ru_utime, usage.ru_stime})
    cost.processor_s += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  cost.peak_MB = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
  return cost;
}

// zlib alone on the pixels of all pictures.
double DeflateSeconds(const fs::path& folder) {
  double seconds = 0;
  for (int i = 0; i < kPictures; ++i) {
    const auto image = ReadPng(folder / "pictures" / PictureName(i));
    if (!image) std::abort();
    const std::vector<unsigned char>& pixels = image->pixels;
    uLongf size = compressBound(pixels.size());
    std::vector<unsigned char> packed(size);
    const double start = ProcessorSeconds();
    compress2(packed.data(), &size, pixels.data(), pixels.size(), 6);
    seconds += ProcessorSeconds() - start;
  }
  return seconds;
}

bool Say(const char* what, double value, double most, const char* unit) {
  std::printf("%-24s %8.2f %-3s (at most %g)%s\n", what, value, unit, most,
              value <= most ? "" : "  MISSED");
  return value <= most;
}

int Run(const fs::path& folder) {
  WriteInputs(folder);
  std::vector<double> seconds, processor, peaks, deflate;
  for (int run = 0; run < kRuns; ++run) {
    const Cost cost = MakeInChild(folder);
    seconds.push_back(cost.seconds);
    processor.push_back(cost.processor_s);
    peaks.push_back(cost.peak_MB);
    deflate.push_back(DeflateSeconds(folder));
  }
  const double size_MB = static_cast<double>(fs::file_size(folder / "report.pdf")) / 1e6;
  bool met = Say("report, median of 5", Median(seconds), kMost_s, "s");
  met = Say("size", size_MB, kMostSize_MB, "MB") && met;
  met = Say("peak memory, largest", *std::max_element(peaks.begin(), peaks.end()), kMostMemory_MB,
            "MB") &&
        met;
  std::printf("%-24s %8.2f s processor time\n", "report", Median(processor));
  std::printf("%-24s %8.2f s processor time\n", "zlib level 6", Median(deflate));
  std::printf("%-24s %8.2f\n", "report over zlib", Median(processor) / Median(deflate));
  return met ? 0 : 1;
}

}  // namespace
}  // namespace telestrain

int main(int count, char** words) {
  return telestrain::Run(count > 1 ? words[1] : telestrain::TestFolder("bench"));
}
