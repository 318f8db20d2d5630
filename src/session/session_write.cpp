#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <numbers>
#include <system_error>

#include "base/csv.h"
#include "base/files.h"
#include "base/numbers.h"
#include "session/session_parts.h"
#include "session/toml_tree.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr char kHeader[] =
    "# A recording session of a virtual four-view telecentric camera array.\n"
    "# Lengths in mm; pixel (0, 0) is the centre of the top-left pixel. Paths in the tables "
    "beside\n"
    "# this file (calibration.csv, ruler.csv, pipe.csv) are relative to this folder.\n";

// A basic TOML string: quoted, with escapes for what may not stand in it.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted.append(1, '\\').append(1, c);
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04X", static_cast<unsigned>(c));
      quoted += escape;
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string Key(const std::string& key) {
  constexpr char kBare[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  const bool is_bare = !key.empty() && key.find_first_not_of(kBare) == std::string::npos;
  return is_bare ? key : Quoted(key);
}

// Adds piece by piece: GCC 12 warns about chains of operator+ that begin with a literal.
std::string Bracketed(std::initializer_list<std::string> items) {
  std::string text;
  for (const std::string& item : items) text.append(text.empty() ? "[" : ", ").append(item);
  return text.append("]");
}

std::string Array(const Eigen::Vector3d& vector) {
  return Bracketed({TomlFloat(vector.x()), TomlFloat(vector.y()), TomlFloat(vector.z())});
}

// The text of a TOML file, line by line.
class TomlWriter {
 public:
  void Comment(const std::string& text) { text_ += text; }
  void Head(const std::string& head) { text_ += "\n" + head + "\n"; }
  void Line(const std::string& key, const std::string& value) {
    text_ += Key(key) + " = " + value + "\n";
  }
  void Whole(const std::string& key, int value) { Line(key, std::to_string(value)); }
  void Number(const std::string& key, double value) { Line(key, TomlFloat(value)); }
  // Leaves out what is not there or says the default.
  void Number(const std::string& key, double value, double fallback) {
    if (value != fallback) Number(key, value);
  }
  void Number(const std::string& key, const std::optional<double>& value) {
    if (value) Number(key, *value);
  }
  void Vector(const std::string& key, const Eigen::Vector3d& value) { Line(key, Array(value)); }
  void Text(const std::string& key, const std::string& value) { Line(key, Quoted(value)); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void WriteInstrument(const Session& session, TomlWriter& toml) {
  toml.Head("[sensor]  # one image holds all views");
  toml.Whole("width_px", session.sensor.width_px);
  toml.Whole("height_px", session.sensor.height_px);
  toml.Number("pixel_pitch_um", session.sensor.pixel_pitch_um);
  toml.Head("[lens]  # nominal; magnification is image size / object size");
  toml.Number("magnification", session.lens_magnification);
  toml.Number("depth_of_field_mm", session.depth_of_field_mm);
  if (session.camera) {
    toml.Head("[camera]  # the physical camera in front of the mirrors");
    toml.Vector("position_mm", session.camera->position_mm);
    toml.Vector("axis", session.camera->axis);
    toml.Vector("image_x", session.camera->image_x);
    toml.Vector("image_y", session.camera->image_y);
  }
  toml.Head("[stage]  # sense of positive stage_mm");
  toml.Vector("axis_in_array", session.stage_axis_in_array);
  toml.Number("sigma_mm", session.stage_sigma_mm);
}

void WriteView(const NominalView& view, TomlWriter& toml) {
  toml.Head("[[view]]");
  toml.Text("name", view.name);
  toml.Text("group", view.group);
  const auto text = [](int number) { return std::to_string(number); };
  toml.Line("region_px", Bracketed({text(view.region.x), text(view.region.y),
                                    text(view.region.width), text(view.region.height)}));
  toml.Vector("image_x_in_array", view.image_x_in_array);
  toml.Vector("image_y_in_array", view.image_y_in_array);
  toml.Vector("axis_in_array", view.axis_in_array);
  toml.Vector("center_in_array_mm", view.center_in_array_mm);
  if (view.mirrors.empty()) return;
  std::string mirrors = "[\n";
  for (const Mirror& mirror : view.mirrors)
    mirrors +=
        "  { point_mm = " + Array(mirror.point_mm) + ", normal = " + Array(mirror.normal) + " },\n";
  toml.Line("mirrors", mirrors + "]");
}

// Degrees that read back to exactly `rotation_rad` where there are such, preferably short ones.
double DegreesOf(double rotation_rad) {
  const auto reads_back = [&](double degrees) { return RadiansOf(degrees) == rotation_rad; };
  const double quotient = rotation_rad * 180.0 / std::numbers::pi;
  const double rounded = std::round(quotient * 1e6) / 1e6;
  if (reads_back(rounded)) return rounded;
  double below = quotient, above = quotient;
  for (int i = 0; i < 4; ++i) {
    if (reads_back(below)) return below;
    if (reads_back(above)) return above;
    below = std::nextafter(below, -1e9);
    above = std::nextafter(above, 1e9);
  }
  return quotient;
}

void WriteArtefacts(const Session& session, TomlWriter& toml) {
  const TargetSpec& target = session.target;
  toml.Head("[target]  # inner corners of each sub-board");
  toml.Whole("columns", target.columns);
  toml.Whole("rows", target.rows);
  toml.Number("square_mm", target.square_mm);
  toml.Number("sigma_square_um", target.sigma_square_um, 0);
  toml.Number("sigma_separation_um", target.sigma_separation_um, 0);
  toml.Number("coplanarity_um", target.coplanarity_um, 0);
  toml.Number("flatness_um", target.flatness_um, 0);
  for (const SubBoard& board : target.boards) {
    toml.Head("[[target.board]]");
    toml.Text("group", board.group);
    toml.Vector("center_in_target_mm", board.center_in_target_mm);
    toml.Number("rotation_deg", DegreesOf(board.rotation_rad), 0);
  }
  if (session.ruler.length_mm > 0) {
    toml.Head("[ruler]");
    toml.Number("length_mm", session.ruler.length_mm);
    toml.Number("sigma_length_um", session.ruler.sigma_length_um, 0);
  }
}

void WritePipe(const PipeSpec& pipe, TomlWriter& toml) {
  if (pipe.outer_diameter_mm <= 0) return;
  toml.Head("[pipe]");
  toml.Number("outer_diameter_mm", pipe.outer_diameter_mm);
  toml.Number("poisson_ratio", pipe.poisson_ratio);
  if (!pipe.material.empty()) toml.Text("material", pipe.material);
  toml.Number("thermal_expansion_per_k", pipe.thermal_expansion_per_k, 0);
  toml.Number("sigma_thermal_expansion_per_k", pipe.sigma_thermal_expansion_per_k, 0);
  toml.Number("sigma_temperature_k", pipe.sigma_temperature_k, 0);
  if (pipe.sigma_gauge_microstrain)
    toml.Number("sigma_gauge_microstrain", *pipe.sigma_gauge_microstrain);
  for (const PipeGauge& gauge : pipe.gauges) {
    toml.Head("[[pipe.gauge]]");
    toml.Text("column", gauge.column);
    toml.Number("axial_mm", gauge.axial_mm);
    toml.Number("angle_deg", DegreesOf(gauge.angle_rad));
    toml.Number("length_mm", gauge.length_mm, 0);
    toml.Number("sigma_microstrain", gauge.sigma_microstrain, 0);
    toml.Number("sigma_angle_deg", DegreesOf(gauge.sigma_angle_rad), 0);
    if (gauge.reads_thermal_strain) toml.Text("reads", "apparent");
  }
}

void WriteLimitsAndTexts(const Session& session, TomlWriter& toml) {
  const AcceptanceSpec& limits = session.acceptance;
  toml.Head("[acceptance]  # each limit that is present is decided");
  toml.Number("reprojection_rms_px", limits.reprojection_rms_px);
  toml.Number("ruler_mpe_um", limits.ruler_mpe_um);
  toml.Number("strain_error_microstrain", limits.strain_error_microstrain);
  toml.Number("coverage_factor", limits.coverage_factor);
  toml.Text("decision_rule", limits.decision_rule == DecisionRule::kGuarded ? "guarded" : "simple");
  if (session.document.empty()) return;
  toml.Head("[document]");
  for (const auto& [key, text] : session.document) toml.Text(key, text);
}

std::string SessionToml(const Session& session) {
  TomlWriter toml;
  toml.Comment(kHeader);
  toml.Text("schema", "telestrain.session/1");
  toml.Text("title", session.title);
  WriteInstrument(session, toml);
  for (const NominalView& view : session.views) WriteView(view, toml);
  WriteArtefacts(session, toml);
  WritePipe(session.pipe, toml);
  WriteLimitsAndTexts(session, toml);
  return toml.text();
}

std::string CalibrationCsv(const Session& session) {
  std::string csv = CsvLine({"image", "pose", "stage_mm"});
  for (const CalibrationImage& image : session.calibration_images)
    csv += CsvLine({image.image, image.pose, FormatShortest(image.stage_mm)});
  return csv;
}

std::string RulerCsv(const Session& session) {
  std::string csv = CsvLine({"image"});
  for (const std::string& image : session.ruler_images) csv += CsvLine({image});
  return csv;
}

std::string PipeCsv(const Session& session) {
  const auto cell = [](const std::optional<double>& value) {
    return value ? FormatShortest(*value) : std::string{};
  };
  bool has_times = false, has_temperatures = false;
  for (const PipeState& state : session.pipe_states) {
    has_times |= state.time_s.has_value();
    has_temperatures |= state.temperature_c.has_value();
  }
  std::vector<std::string> header{"image", "cycle", "step"};
  if (has_times) header.push_back("time_s");
  if (has_temperatures) header.push_back("temperature_c");
  header.insert(header.end(), session.gauge_columns.begin(), session.gauge_columns.end());
  std::string csv = CsvLine(header);
  for (const PipeState& state : session.pipe_states) {
    std::vector<std::string> cells{state.image, state.cycle, state.step};
    if (has_times) cells.push_back(cell(state.time_s));
    if (has_temperatures) cells.push_back(cell(state.temperature_c));
    for (const auto& gauge : state.gauges_microstrain) cells.push_back(cell(gauge));
    csv += CsvLine(cells);
  }
  return csv;
}

// A table without rows is left out, and one that an earlier session left there goes.
Status WriteTable(const fs::path& path, bool is_empty, const std::string& csv) {
  if (!is_empty) return WriteFileAtomically(path, csv);
  std::error_code code;
  fs::remove(path, code);
  if (code) return OutputFailed(path.string() + ": cannot be removed: " + code.message());
  return {};
}

}  // namespace

Status WriteSession(const Session& session, const fs::path& folder) {
  TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder));
  const bool no_pipe = session.pipe_states.empty() && session.gauge_columns.empty();
  TELESTRAIN_RETURN_IF_ERROR(
      WriteFileAtomically(folder / "calibration.csv", CalibrationCsv(session)));
  TELESTRAIN_RETURN_IF_ERROR(
      WriteTable(folder / "ruler.csv", session.ruler_images.empty(), RulerCsv(session)));
  TELESTRAIN_RETURN_IF_ERROR(WriteTable(folder / "pipe.csv", no_pipe, PipeCsv(session)));
  return WriteFileAtomically(folder / "session.toml", SessionToml(session));
}

}  // namespace telestrain
