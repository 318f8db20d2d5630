#include "study_fixture.h"

#include <cmath>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::ordered_json;

// Repeatable scatter between -1 and 1.
double Scatter(int i) { return std::sin(12.9898 * i) * std::cos(78.233 * i); }

Json Series(const char* name, const char* kind, Json x, Json y) {
  return {{"name", name}, {"kind", kind}, {"x", std::move(x)}, {"y", std::move(y)}};
}

Json DistancePlot() {
  const Json distances = {50, 100, 200, 500, 1000, 2000, 5000, 10000};
  Json locked = Json::array(), free_lens = Json::array(), ruler = Json::array();
  for (const Json& distance : distances) {
    const double d_mm = distance.get<double>();
    locked.push_back(std::hypot(131.6 / d_mm, 0.0997));
    free_lens.push_back(std::hypot(119.1 / d_mm, 0.0996));
    ruler.push_back(std::hypot(157.0 / d_mm, 0.35));
  }
  Json plot = {{"id", "rms-over-distance"},
               {"title", "Reprojection error of a pinhole model against its working distance"},
               {"caption",
                "The pinhole model is calibrated on the corners that the telecentric model fits to "
                "the noise. Its error falls with the distance, as it has nothing else than the "
                "distance to come near parallel rays with."},
               {"x", {{"label", "Working distance / mm"}, {"log", true}}},
               {"y", {{"label", "RMS / px"}, {"log", true}}}};
  plot["series"] = {Series("pinhole, core locked at f = m D", "line", distances, locked),
                    Series("pinhole, five coefficients free", "line", distances, free_lens),
                    Series("ruler error of the pinhole / µm", "markers", distances, ruler)};
  plot["limits"] = {{{"y", 0.1}, {"text", "noise of the corners, 0.1 px"}},
                    {{"y", 0.78}, {"text", "paper, 0.78 px"}}};
  return plot;
}

Json HistogramPlot() {
  Json middles = Json::array(), telecentric = Json::array(), pinhole = Json::array();
  Json rayleigh = Json::array();
  for (int i = 0; i < 30; ++i) {
    const double x = 0.02 * i + 0.01;
    middles.push_back(x);
    const double expected = 67392 * x * std::exp(-x * x / 0.02);
    rayleigh.push_back(expected);
    telecentric.push_back(std::round(expected * (1 + 0.08 * Scatter(i))));
    pinhole.push_back(std::round(17000 * x * std::exp(-x * x / 0.09)));
  }
  return {{"id", "histogram"},
          {"title", "Size of the corners' errors"},
          {"caption", "33 696 corners each."},
          {"x", {{"label", "Error of a corner / px"}}},
          {"y", {{"label", "Corners"}}},
          {"series",
           {Series("telecentric", "bars", middles, telecentric),
            Series("pinhole at 1 m", "step", middles, pinhole),
            Series("Rayleigh distribution of 0.1 px", "line", middles, rayleigh)}}};
}

Json ScatterPlot() {
  Json places = Json::array(), errors = Json::array(), mean = Json::array();
  Json few = Json::array(), few_errors = Json::array(), half = Json::array();
  for (int i = 0; i < 850; ++i) {
    const double z_mm = -1.55 + 3.1 * i / 849;
    places.push_back(z_mm);
    errors.push_back(0.6 * z_mm * z_mm + 1.7 * Scatter(i));
    mean.push_back(i > 300 && i < 340 ? Json(nullptr) : Json(0.6 * z_mm * z_mm));
  }
  for (int i = 0; i < 7; ++i) {
    few.push_back(-1.5 + 0.5 * i);
    few_errors.push_back(1.2 * std::pow(-1.5 + 0.5 * i, 2));
    half.push_back(0.8);
  }
  Json plot = {{"id", "ruler"},
               {"title", "Error of the ruler's length in 850 images"},
               {"caption", "The U shape of the paper's Figure 13."},
               {"x", {{"label", "Height of the ruler above focus / mm"}}},
               {"y", {{"label", "Error / µm"}, {"low", -5}, {"high", 5}}}};
  plot["series"] = {Series("images", "markers", places, errors),
                    Series("mean", "line", places, mean),
                    Series("paper, read from its figure", "markers", few, few_errors)};
  plot["series"][2]["half_height"] = half;
  return plot;
}

Json ManyPlot() {
  Json plot = {{"id", "many"},
               {"title", "Seven error sources and what each adds to the ruler's error"},
               {"x", {{"label", "Size of the source over its nominal value"}, {"log", true}}},
               {"y", {{"label", "Standard deviation of the ruler's error / µm"}}}};
  plot["series"] = Json::array();
  for (int s = 0; s < 7; ++s) {
    Json x = Json::array(), y = Json::array();
    for (int i = 0; i < 8; ++i) {
      x.push_back(std::pow(2.0, i - 2));
      y.push_back(0.3 + 0.05 * s + 0.02 * (s + 1) * i);
    }
    plot["series"].push_back(
        Series(("source number " + std::to_string(s + 1)).c_str(), "line", x, y));
  }
  return plot;
}

Json LongTable() {
  Json table = {{"id", "poses"}, {"title", "Figures against the number of poses"}};
  table["columns"] = {{{"name", "Poses"}},
                      {{"name", "RMS"}, {"unit", "px"}},
                      {{"name", "Ruler, sd"}, {"unit", "µm"}},
                      {{"name", "Remark"}}};
  table["rows"] = Json::array();
  for (int i = 1; i <= 60; ++i)
    table["rows"].push_back({i, 0.0997 + 0.0001 * i, Json{{"value", 0.35}, {"printed", "0.350"}},
                             i % 7 == 0 ? Json("converged") : Json(nullptr)});
  return table;
}

// The numbers are invented.
Json Comparison() {
  return {{{"quantity", "Reprojection error, telecentric"},
           {"unit", "px"},
           {"paper", "0.0413"},
           {"ours", "0.0379"},
           {"limit", "≤ 0.05"},
           {"met", true},
           {"differs",
            "The paper does not state whether it is a mean or an RMS; ours is an RMS over "
            "both coordinates of all corners of the 288 boards."}},
          {{"quantity", "Reprojection error, pinhole"},
           {"unit", "px"},
           {"paper", "0.2517"},
           {"ours", "0.2484 at D = 520 mm"},
           {"limit", "none"},
           {"met", nullptr},
           {"differs", "Depends on the working distance alone."}},
          {{"quantity", "Largest error of the ruler"},
           {"unit", "µm"},
           {"paper", "1.74"},
           {"ours", "2.113"},
           {"limit", "≤ 2"},
           {"met", false},
           {"differs", ""}}};
}

}  // namespace

Json SampleStudy() {
  Json study = {
      {"schema", "telestrain.study/1"},
      {"study", "paper-simulation"},
      {"title", "Telecentric against pinhole on simulated images"},
      {"question",
       "Does the telecentric model fit the simulated images of the paper's section 3 "
       "better than a pinhole model, and does it measure the ruler better?"},
      {"answer",
       "Yes. The telecentric model fits the corners to their noise and measures the ruler "
       "to 0.35 µm. A pinhole model comes near only as its working distance grows, that "
       "is, as it stops being one."}};
  study["comparison"] = Comparison();
  study["plots"] = {DistancePlot(), HistogramPlot(), ScatterPlot(), ManyPlot()};
  study["images"] = {{{"file", "board.png"}, {"caption", "A simulated image of the board."}}};
  study["tables"] = {LongTable()};
  study["notes"] = {"Corners are detected in rendered images; nothing is copied from the truth.",
                    "The images are seeded: the same settings give the same study, byte for byte. "
                    "Another seed moves the ruler's standard deviation by about a tenth."};
  study["settings"] = {{{"name", "seed"}, {"value", 7}},
                       {{"name", "noise of the images"}, {"value", 1.5}, {"unit", "gray"}},
                       {{"name", "defocus"}, {"value", true}},
                       {{"name", "working distances"}, {"value", "50 to 10000"}, {"unit", "mm"}}};
  return study;
}
