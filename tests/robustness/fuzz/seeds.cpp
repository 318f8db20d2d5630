// telestrain_fuzz_seeds FOLDER: what the targets begin with. It is made from the examples and the
// fixtures of other tests, so none of it is kept.
#include <cstdio>
#include <opencv2/imgcodecs.hpp>

#include "base/files.h"
#include "robustness/fuzz/seed_files.h"

namespace telestrain::fuzz {
namespace {

using Json = nlohmann::ordered_json;

// Matrices stay whole.
void Shorten(Json& json) {
  constexpr std::size_t kKept = 3;
  const bool is_long = json.is_array() && json.size() > kKept && json.front().is_structured();
  if (is_long && !(json.front().is_array() && json.front().size() == json.size()))
    json.erase(json.begin() + kKept, json.end());
  if (json.is_structured())
    for (Json& child : json) Shorten(child);
}

void WriteSessions(const Seeds& seeds) {
  const std::filesystem::path folder =
      std::filesystem::path(TELESTRAIN_SOURCE_DIR) / "data/small_session";
  const std::string toml = FileText(folder / "session.toml");
  const std::string boards = FirstLines(FileText(folder / "calibration.csv"), 4);
  seeds.Write("session", "small",
              Joined({{"session.toml", toml},
                      {"calibration.csv", boards},
                      {"ruler.csv", "image\nruler/ruler_01.png\n"},
                      {"pipe.csv", FirstLines(FileText(folder / "pipe.csv"), 1) +
                                       "pipe/pipe_01.png,1,1,0,,,\npipe/pipe_02.png,1,2,1,,,\n"}}));
  seeds.Write("session", "least", Joined({{"session.toml", toml}, {"calibration.csv", boards}}));
  seeds.Write("text", "toml", "t" + toml);
  seeds.Write("text", "table", "c" + boards);
}

void WriteTexts(const Seeds& seeds) {
  const std::vector<std::pair<std::string, std::string>> texts{
      {"quoted", "c\"a b\",c\n1,\"x\"\"y\"\n# comment\n 2 , 3 \n"},
      {"number", "n-1.25e-3"},
      {"region", "n0,0,200,972"},
      {"document", "ndate=2026-01-31"},
      {"unit", "nppm/mm²"},
      {"unicode", "uAé€😀\xE2\x80\xAE"},
      {"nested", "j[[[[[[[[[[[[[\"]\\\"[\"]]]]]]]]]]]]]"},
      {"iso", "d2026-01-31T12:30:00+01:00"},
      {"pdf-time", "dD:20260131123000Z"},
      {"filled", "f{\"a\":{\"b\":\"x\"},\"c\":null}\n{{a.b}} {{#a}}{{b}}{{/a}}{{^c}}-{{/c}}"},
      {"rounded", std::string("r\x9a\x99\x99\x99\x99\x99\x28\x40\x7b\x14\xae\x47\xe1"
                              "\x7a\x84\x3f",
                              17)}};
  for (const auto& [name, text] : texts) seeds.Write("text", name, text);
}

void WriteCorners(const Seeds& seeds) {
  const std::string block =
      "a.png#A1 10 10 0\na.png#A1 20 10 0\na.png#A1 30 10.5 0\n"
      "a.png#A1 10 20 0\na.png#A1 - - -\na.png#A1 30 20 1\n"
      "a.png#A2 - - -\n";
  std::string covariances = "image,view,column,row,cov_uu_px2,cov_uv_px2,cov_vv_px2\n";
  for (const char* place : {"0,0", "1,0", "2,0", "0,1", "2,1"})
    covariances += "a.png,A1," + std::string(place) + ",0.01,0,0.01\n";
  const Json cross{
      {"image", "r.png"}, {"view", "A1"}, {"pixel", {1.5, 2}}, {"covariance_px2", {1, 0, 0, 1}}};
  const Json detection{
      {"schema", "telestrain.detection/1"},
      {"boards",
       {{{"image", "a.png"}, {"view", "A2"}, {"found", false}, {"rejected_because", "too dark"}}}},
      {"crosses", {cross}}};
  seeds.Write("corners", "own",
              Joined({{"corners.vnl", "# filename x y level\n" + block},
                      {"corner_covariances.csv", covariances},
                      {"detection.json", detection.dump()}}));
  seeds.Write("corners", "no-level",
              Joined({{"corners.vnl",
                       "# filename x y\na.png#A1 10 10\na.png#A1 20 10\n"
                       "a.png#A1 30 10\na.png#A1 10 20\na.png#A1 20 20\n"
                       "a.png#A1 30 20\n"}}));
}

// A small ramp in every format and depth that is read.
void WriteImages(const Seeds& seeds) {
  cv::Mat gray(12, 16, CV_16U), color(12, 16, CV_8UC3);
  for (int y = 0; y < gray.rows; ++y)
    for (int x = 0; x < gray.cols; ++x) {
      gray.at<unsigned short>(y, x) = static_cast<unsigned short>(4096 * x + 300 * y);
      color.at<cv::Vec3b>(y, x) =
          cv::Vec3b(static_cast<unsigned char>(16 * x), static_cast<unsigned char>(20 * y), 128);
    }
  cv::Mat gray8;
  gray.convertTo(gray8, CV_8U, 1.0 / 257);
  for (const std::string format : {"png", "tiff", "bmp", "pgm", "jpg"}) {
    int index = 0;
    for (const cv::Mat& image : {gray8, gray, color}) {
      if (format == "pgm" && image.channels() != 1) continue;
      std::vector<unsigned char> bytes;
      if (cv::imencode("." + format, image, bytes))
        seeds.Write("image", format + std::to_string(index++), {bytes.begin(), bytes.end()});
    }
  }
}

}  // namespace

std::string FileText(const std::filesystem::path& path) {
  auto text = ReadFile(path, kMostReportBytes);
  if (!text) throw std::runtime_error(text.error().message);
  return *std::move(text);
}

std::string FirstLines(const std::string& text, int count) {
  std::size_t end = 0;
  for (int i = 0; i < count && end < text.size(); ++i)
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
  return text.substr(0, end);
}

std::string Short(Json json) {
  Shorten(json);
  return json.dump();
}

}  // namespace telestrain::fuzz

int main(int count, char** arguments) {
  using namespace telestrain::fuzz;
  if (count != 2) {
    std::fprintf(stderr, "telestrain_fuzz_seeds FOLDER\n");
    return 2;
  }
  const Seeds seeds(arguments[1]);
  WriteSessions(seeds);
  WriteTexts(seeds);
  WriteCorners(seeds);
  WriteImages(seeds);
  WriteResultsSeeds(seeds);
  WriteSignatureSeeds(seeds);
}
