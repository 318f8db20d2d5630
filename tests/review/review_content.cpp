#include "review/review_content.h"

#include <array>
#include <string>

namespace telestrain::review_test {
namespace {

using nlohmann::ordered_json;

viz::ViewVolume View(const std::string& name, const std::string& group, double x_mm) {
  viz::ViewVolume view;
  view.name = name;
  view.group = group;
  view.center_in_array_mm = {x_mm, 0, kSurfaceHeight_mm};
  view.axis_in_array = -Eigen::Vector3d::UnitZ();
  view.image_y_in_array = -Eigen::Vector3d::UnitY();
  view.width_mm = 6;
  view.height_mm = 4;
  view.depth_of_field_mm = 3;
  return view;
}

viz::Board BoardAt(const std::string& image, const Eigen::Vector3d& middle) {
  viz::Board board;
  board.image = image;
  board.pose = "P001";
  board.group = "A";
  board.square_mm = 0.5;
  const Eigen::Vector3d along(2, 0, 0), across(0, 1.5, 0);
  board.outline_in_array_mm = {middle - along - across, middle + along - across,
                               middle + along + across, middle - along + across};
  board.corner_grid_in_array_mm = board.outline_in_array_mm;
  board.rms_px = 0.02;
  board.views = {{"A1", 12, 0.02}};
  return board;
}

// Adds a group: 5 x 5 points over 4 x 2 mm at the pipe's top, from `x_mm` on.
void AddGroup(std::size_t state, int group, double x_mm, viz::Surface* surface_to) {
  viz::Surface& surface = *surface_to;
  const auto begin = static_cast<int>(surface.points_in_array_mm.size());
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column) {
      surface.points_in_array_mm.emplace_back(x_mm + column, -1 + 0.5 * row, kSurfaceHeight_mm);
      surface.displacement_mm.emplace_back(1e-3 * static_cast<double>(state), 0, 0);
      surface.sigma_um.push_back(0.1);
      surface.group.push_back(group);
      surface.values[0].values.push_back(kStrain_microstrain[state]);
      surface.values[1].values.push_back(kHoop_microstrain[state]);
    }
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const int first = begin + 5 * row + column;
      surface.quads.push_back({first, first + 1, first + 6, first + 5});
    }
}

viz::Surface SurfaceOf(std::size_t state) {
  viz::Surface surface;
  surface.values = {{{"axial_microstrain", "axial strain", "\u00b5\u03b5"}, {}},
                    {{"hoop_microstrain", "hoop strain", "\u00b5\u03b5"}, {}}};
  AddGroup(state, 0, -5, &surface);
  AddGroup(state, 1, 6, &surface);
  return surface;
}

viz::Pipe MadeUpPipe() {
  viz::Pipe pipe;
  pipe.radius_mm = pipe.nominal_radius_mm = kSurfaceHeight_mm;
  pipe.base_length_mm = 16;
  for (const std::size_t i : {0u, 1u}) {
    viz::PipeState state;
    state.image = "pipe/pipe_00" + std::to_string(i) + ".png";
    state.cycle = "1";
    state.step = std::to_string(i);
    state.axial_microstrain = kStrain_microstrain[i];
    state.standard_uncertainty_microstrain = 0.25;
    state.surface = SurfaceOf(i);
    pipe.states.push_back(std::move(state));
  }
  pipe.largest_state = 1;
  return pipe;
}

}  // namespace

viz::Scene MadeUpScene() {
  viz::Scene scene;
  scene.views = {View("A1", "A", -8), View("B1", "B", 8)};
  scene.boards = {BoardAt("calibration/low.png", {-8, 0, kSurfaceHeight_mm}),
                  BoardAt("calibration/high.png", {-8, 0, kSurfaceHeight_mm + 1})};
  scene.target_poses = 2;
  scene.rulers = {{"ruler/ruler_001.png", {{{-8, 0.3, 4.2}, {8, 0.3, 4.2}}}, 0.4, 0.7, "pass"}};
  scene.pipe = MadeUpPipe();
  scene.magnification_px_per_mm = 227;
  return scene;
}

std::string SmallPng() {
  constexpr unsigned char kBytes[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
      0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00,
      0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00, 0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78,
      0xda, 0x63, 0x68, 0x00, 0x00, 0x00, 0x82, 0x00, 0x81, 0xda, 0x45, 0x08, 0x3b, 0x00,
      0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char*>(kBytes), sizeof(kBytes)};
}

viz::ReviewContent MadeUpContent() {
  viz::ReviewContent content;
  content.version = "1.2.3";
  content.results = ordered_json::parse(R"({
    "schema": "telestrain.results/1", "verdict": "pass", "title": "Bench test",
    "document": {"operator": "Ada", "report_number": "R-7", "shift": "night"},
    "decision": {"printed": "The rule.", "printed_undecided": ""},
    "quantities": [{"label": "Ruler error", "value": -0.4, "unit": "\u00b5m",
      "expanded_uncertainty": 0.7, "limit": 3.0, "verdict": "pass", "printed": "-0.4",
      "printed_uncertainty": "0.7", "printed_limit": "\u00b1 3"}],
    "tables": [{"id": "strain-states", "title": "States",
      "columns": [{"name": "Image", "unit": ""}, {"name": "Strain", "unit": "\u00b5\u03b5"}],
      "rows": [["pipe/pipe_000.png", {"value": 100.0, "printed": "100"}],
               ["pipe/pipe_001.png", {"value": -12.25, "printed": "-12.25"}]]},
     {"id": "decisions", "title": "Decisions", "columns": [{"name": "Quantity", "unit": ""},
      {"name": "Decision", "unit": ""}], "rows": [["Ruler error", "passes with 1.9 to spare"]]}]
  })");
  content.hashes = {{"results.json", std::string(64, 'a')},
                    {"calibration.json", std::string(64, 'b')}};
  content.scene = MadeUpScene();
  content.list = viz::PartsOf(content.scene);
  content.pictures = {{"array.png", SmallPng()}};
  content.vtk_js = viz::BuiltInVtkJs();
  return content;
}

}  // namespace telestrain::review_test
