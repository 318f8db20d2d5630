#include "app/watched_folder.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <system_error>
#include <thread>

#include "base/files.h"
#include "base/numbers.h"
#include "base/utf8.h"
#include "session/inside_folder.h"
#include "session/pipe_table.h"
#include "target/image_file.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kPause = std::chrono::milliseconds(100);  // between two looks at the folder
constexpr auto kSettled = std::chrono::milliseconds(150);
// After that without a change, an image that does not decode is taken to be damaged, not slow.
constexpr auto kGiveUp = std::chrono::seconds(3);

bool IsImageName(const std::string& name) {
  if (name.empty() || name.front() == '.') return false;
  std::string extension = fs::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr const char* kKnown[] = {".png", ".tif", ".tiff", ".bmp", ".pgm", ".jpg", ".jpeg"};
  return std::find(std::begin(kKnown), std::end(kKnown), extension) != std::end(kKnown);
}

std::string FileName(const PipeState& row) { return fs::path(row.image).filename().string(); }

std::string TimeOfDay() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::localtime_r(&now, &parts);
  char text[16];
  return std::string(text, std::strftime(text, sizeof(text), "%H:%M:%S", &parts));
}

std::string Microstrain(double strain, int decimals) { return FormatFixed(1e6 * strain, decimals); }

}  // namespace

Result<std::optional<PipeImage>> WatchedFolder::Next() {
  if (!all_known_handed_out_) {
    TELESTRAIN_ASSIGN_OR_RETURN(std::optional<PipeImage> known, NextKnown());
    if (known) return known;
    all_known_handed_out_ = true;
  }
  const auto start = Clock::now();
  for (; !stop_; std::this_thread::sleep_for(kPause)) {
    if (kept_ >= most_) break;
    if (handed_out_ - skipped_ >= most_) continue;  // the states under way may be enough
    TELESTRAIN_ASSIGN_OR_RETURN(const bool whole, ReadTable());
    LookAtFiles();
    if (!whole) continue;
    if (auto image = TakeFirstReady()) {
      ++handed_out_;
      return image;
    }
    const std::chrono::duration<double> waited = Clock::now() - start;
    if (choices_.idle_s > 0 && waited.count() > choices_.idle_s) break;
  }
  return std::optional<PipeImage>{};
}

// Nothing when the next record's image is not there as it was.
Result<std::optional<PipeImage>> WatchedFolder::NextKnown() {
  const auto index = static_cast<std::size_t>(handed_out_);
  if (index >= journal_.known().size() || handed_out_ >= most_ || stop_)
    return std::optional<PipeImage>{};
  TELESTRAIN_RETURN_IF_ERROR(ReadTable());
  const std::string name = fs::path(journal_.known()[index].image).filename().string();
  const auto bytes = ReadFile(choices_.folder / name, kMostImageBytes);
  if (!bytes) return std::optional<PipeImage>{};
  PipeImage image;
  image.table = RowOf(name);
  image.sha256 = Sha256Hex(*bytes);
  image.known = journal_.Known(index, image.table, image.sha256);
  if (!image.known) return std::optional<PipeImage>{};
  if (index == 0) {
    TELESTRAIN_ASSIGN_OR_RETURN(
        image.image, DecodeGrayImage((choices_.folder / name).string(), *bytes,
                                     session_.sensor.width_px, session_.sensor.height_px));
  }
  ++handed_out_;
  files_[name].done = true;
  return std::optional<PipeImage>(std::move(image));
}

// A table may grow with the images. While it is being written, or replaced, it is not whole, and no
// image is handed out with half a row.
Result<bool> WatchedFolder::ReadTable() {
  const fs::path path = choices_.folder / "pipe.csv";
  std::error_code code;
  if (!fs::exists(path, code)) {
    if (!table_seen_) table_ = session_.pipe_states;
    return !table_seen_;
  }
  if (!table_seen_) table_since_ = Clock::now();
  table_seen_ = true;
  const auto text = ReadFile(path, kMostTableBytes);
  if (text && *text == table_text_ && !table_text_.empty()) return true;
  const bool ends = text && !text->empty() && text->back() == '\n';
  auto table = ReadPipeTableOf(session_, path);
  if (!ends || !table) {
    if (Clock::now() - table_since_ < kGiveUp) return false;
    if (!table) return table.error();
  }
  table_since_ = Clock::now();
  if (table->gauge_columns != session_.gauge_columns)
    return BadInput(path.string() +
                    ": has other gauge columns than when the watch began; a table with all its "
                    "columns must be there from the start");
  table_ = std::move(table->states);
  table_text_ = text ? *text : std::string();
  return true;
}

void WatchedFolder::LookAtFiles() {
  std::error_code code;
  for (fs::directory_iterator entry(choices_.folder, code), end; !code && entry != end;
       entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    std::error_code gone;
    if (!IsImageName(name) || !entry->is_regular_file(gone)) continue;
    const Stamp stamp{entry->file_size(gone), entry->last_write_time(gone)};
    File& file = files_[name];
    if (file.done || gone || (file.stamp == stamp && file.since != Clock::time_point())) continue;
    file.stamp = stamp;
    file.since = Clock::now();
    file.bad = false;
  }
}

bool WatchedFolder::MayBeNext(const std::string& name) const {
  return handed_out_ > 0 || table_.empty() || FileName(table_.front()) == name;
}

void WatchedFolder::SayThatItWaits(const std::string& name) {
  if (!said_that_it_waits_)
    console_.Note("  " + name + " waits for the reference, " + FileName(table_.front()) +
                  ", which the first row of pipe.csv names");
  said_that_it_waits_ = true;
}

// By name; a later image does not overtake one that is still being written.
std::optional<PipeImage> WatchedFolder::TakeFirstReady() {
  for (auto& [name, file] : files_) {
    if (file.done || file.bad) continue;
    if (!MayBeNext(name)) {
      SayThatItWaits(name);
      continue;
    }
    if (Clock::now() - file.since < kSettled) return {};
    auto image = Decode(name, file);
    if (image || !file.bad) return image;
  }
  return {};
}

std::optional<PipeImage> WatchedFolder::Decode(const std::string& name, File& file) {
  const fs::path path = choices_.folder / name;
  const auto complain = [&](const Error& error) {
    file.bad = Clock::now() - file.since > kGiveUp;
    if (file.bad) console_.Note("  not used: " + error.message);
    return std::optional<PipeImage>{};
  };
  if (!IsValidUtf8(name))
    return complain(BadInput(PrintableText(path.string()) +
                             ": its name is not UTF-8, so that no table can name it; rename it"));
  if (const Status inside = StaysInside(path); !inside) return complain(inside.error());
  const auto bytes = ReadFile(path, kMostImageBytes);
  if (!bytes) return complain(bytes.error());
  auto pixels =
      DecodeGrayImage(path.string(), *bytes, session_.sensor.width_px, session_.sensor.height_px);
  if (!pixels) return complain(pixels.error());
  file.done = true;
  PipeImage image;
  image.table = RowOf(name);
  image.sha256 = Sha256Hex(*bytes);
  image.image = std::move(pixels).value();
  return image;
}

PipeState WatchedFolder::RowOf(const std::string& name) const {
  for (const PipeState& row : table_)
    if (FileName(row) == name) return row;
  PipeState alone;
  alone.image = name;
  return alone;
}

Status WatchedFolder::Keep(const PipeSequence& sequence, const PipeImage& image,
                           const MeasuredState& state, double spent_ms) {
  TELESTRAIN_RETURN_IF_ERROR(journal_.Add(sequence, image, state));
  if (++kept_ == static_cast<int>(kMostTableRows))
    console_.Note("  the watch ends with " + std::to_string(kMostTableRows) +
                  " states, the limit of one results folder; begin another for the next images");
  const StateStrain& strain = state.strain;
  const auto local = [&](std::size_t group) {
    return group < strain.local_axial_strain.size()
               ? Microstrain(strain.local_axial_strain[group], 1)
               : std::string("-");
  };
  const double k = session_.acceptance.coverage_factor;
  console_.Say(
      TimeOfDay() + "  " + state.table.image + "  axial " + Microstrain(strain.axial_strain, 2) +
      " +- " + Microstrain(k * strain.standard_uncertainty, 2) + "  local A " + local(0) + " B " +
      local(1) + " microstrain (U, k = " + FormatShortest(k) + ")  " +
      std::to_string(strain.points_used) + " of " + std::to_string(sequence.grid().points.size()) +
      " points  " + (image.known ? std::string("known") : FormatFixed(spent_ms, 0) + " ms"));
  return {};
}

bool WatchedFolder::Skip(const Error& error) {
  if (error.kind != ErrorKind::kEstimationFailed) return false;
  ++skipped_;
  console_.Note("  not used: " + error.message);
  return true;
}

}  // namespace telestrain
