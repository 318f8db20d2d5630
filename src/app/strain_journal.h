#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "measurement/state_record.h"

namespace telestrain {

// The files that `measure` makes state by state: pipe_NNN.vtp, then a line of strain.csv, then the
// line of strain_states.jsonl that makes the state count. Each is written anew and put in the place
// of the old one, so that it is whole at any moment. A run that is ended leaves whole states
// behind; the next one takes over those that were made from the same inputs, to the first one that
// was not, and ends with the bytes of a run that was never ended.
class StrainJournal {
 public:
  // Reads what an earlier run left; the first Add removes strain.json, which is made from all
  // states, and the whole of it when it was made from something else.
  // `made_from`: what every state depends on beside the images.
  StrainJournal(const std::filesystem::path& results,
                const std::map<std::string, std::string>& made_from);

  // The states of the earlier run that fit `made_from` and each other, the reference first; their
  // images are for the caller to compare. Does not change.
  const std::vector<StateRecord>& known() const { return known_; }

  // The record at `index` if it was made from the image with this name and hash.
  std::optional<MeasuredState> Known(std::size_t index, const PipeState& table,
                                     const std::string& sha256) const;

  // Takes the states in order: one that is known stays as it lies there, up to the first that is
  // not.
  Status Add(const PipeSequence& sequence, const PipeImage& image, const MeasuredState& state);
  // After the last state: strain.csv and the records say just what was added.
  Status Finish();

 private:
  void ReadKnown();
  Status RemoveEarlier();
  bool Fits(const StateRecord& record) const;
  Status Settle();

  std::filesystem::path results_;
  std::map<std::string, std::string> made_from_;
  std::vector<StateRecord> known_;
  std::vector<std::string> lines_;  // of the known records
  std::string csv_;                 // what the table holds
  std::string reference_sha256_;
  std::size_t count_ = 0;
  bool settled_ = false;
};

}  // namespace telestrain
