#include "app/strain_journal.h"

#include <fstream>
#include <system_error>

#include "app/results_folder.h"
#include "base/files.h"
#include "base/numbers.h"
#include "measurement/pipe_file.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecords = "strain_states.jsonl";
constexpr const char* kTable = "strain.csv";
constexpr const char* kImage = "image";          // keys of made_from
constexpr const char* kReference = "reference";  // the image of the first state
constexpr const char* kTemperature = "temperature_c";

std::string TextOrNothing(const fs::path& path) {
  const auto text = ReadFile(path, kMostLogBytes);
  return text ? *text : std::string();
}

Status WriteIfOther(const fs::path& path, const std::string& text) {
  std::error_code code;
  if (fs::exists(path, code) && TextOrNothing(path) == text) return {};
  return WriteFileAtomically(path, text);
}

std::string TemperatureText(const PipeState& table) {
  return table.temperature_c ? FormatShortest(*table.temperature_c) : std::string();
}

}  // namespace

StrainJournal::StrainJournal(const fs::path& results,
                             const std::map<std::string, std::string>& made_from)
    : results_(results), made_from_(made_from) {
  ReadKnown();
}

// A line that was cut short, is of other inputs or has lost its surface ends the list.
void StrainJournal::ReadKnown() {
  std::ifstream file(results_ / kRecords, std::ios::binary);
  for (std::string line; std::getline(file, line) && !file.eof();) {
    auto record = ReadStateRecord(line);
    if (!record || !Fits(*record)) break;
    const auto found = Sha256HexOfFile(results_ / SurfaceFileName(known_.size()));
    if (!found || *found != record->surface_sha256) break;
    known_.push_back(std::move(record).value());
    lines_.push_back(line + '\n');
  }
}

// A measurement that fails before its first state takes nothing away.
Status StrainJournal::RemoveEarlier() {
  return known_.empty() ? RemoveOutputsFrom(results_, Step::kMeasure)
                        : RemoveEndOfMeasure(results_);
}

bool StrainJournal::Fits(const StateRecord& record) const {
  std::map<std::string, std::string> wanted = made_from_;
  const auto image = record.made_from.find(kImage);
  if (image == record.made_from.end()) return false;
  wanted[kImage] = image->second;
  const auto temperature = record.made_from.find(kTemperature);
  if (temperature != record.made_from.end()) wanted[kTemperature] = temperature->second;
  wanted[kReference] = known_.empty() ? image->second : known_.front().made_from.at(kImage);
  const std::vector<ViewMotion> from =
      known_.empty() ? std::vector<ViewMotion>{} : known_.back().state.motions;
  return record.made_from == wanted && record.state.from == from;
}

std::optional<MeasuredState> StrainJournal::Known(std::size_t index, const PipeState& table,
                                                  const std::string& sha256) const {
  if (index >= known_.size()) return {};
  const StateRecord& record = known_[index];
  const auto temperature = record.made_from.find(kTemperature);
  const std::string measured_at =
      temperature == record.made_from.end() ? std::string() : temperature->second;
  if (record.image != table.image || record.made_from.at(kImage) != sha256 ||
      measured_at != TemperatureText(table))
    return {};
  return record.state;
}

// The files hold what was added so far and no more.
Status StrainJournal::Settle() {
  std::string records;
  for (std::size_t i = 0; i < count_; ++i) records += lines_[i];
  // The records first: a state that they name must be whole.
  TELESTRAIN_RETURN_IF_ERROR(WriteIfOther(results_ / kRecords, records));
  TELESTRAIN_RETURN_IF_ERROR(RemoveSurfacesFrom(results_, count_));
  csv_ = StrainCsvHeader() + csv_;
  TELESTRAIN_RETURN_IF_ERROR(WriteIfOther(results_ / kTable, csv_));
  settled_ = true;
  return {};
}

Status StrainJournal::Add(const PipeSequence& sequence, const PipeImage& image,
                          const MeasuredState& state) {
  if (count_ == 0) {
    TELESTRAIN_RETURN_IF_ERROR(RemoveEarlier());
    reference_sha256_ = image.sha256;
  }
  if (image.known) {
    TELESTRAIN_CHECK(!settled_ && count_ < known_.size(), "a known state after one that is not");
    csv_ += StrainCsvLine(state);
    ++count_;
    return {};
  }
  if (!settled_) TELESTRAIN_RETURN_IF_ERROR(Settle());
  const std::string surface = SurfaceVtp(sequence.grid(), state.strain, &sequence.geometry());
  StateRecord record{state.table.image, made_from_, Sha256Hex(surface), state};
  record.made_from[kImage] = image.sha256;
  record.made_from[kReference] = reference_sha256_;
  if (state.table.temperature_c) record.made_from[kTemperature] = TemperatureText(state.table);
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results_ / SurfaceFileName(count_), surface));
  csv_ += StrainCsvLine(state);
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results_ / kTable, csv_));
  // A record takes thousands of bytes; a part that a kill may leave ends the list when it is read.
  TELESTRAIN_RETURN_IF_ERROR(AppendToFile(results_ / kRecords, StateRecordLine(record)));
  ++count_;
  return {};
}

Status StrainJournal::Finish() { return settled_ ? Status{} : Settle(); }

}  // namespace telestrain
