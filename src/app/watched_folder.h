#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/strain_journal.h"
#include "base/console.h"
#include "base/file_limits.h"
#include "session/session.h"

namespace telestrain {

// How long `measure --watch` goes on.
struct WatchChoices {
  std::filesystem::path folder;
  int until = 0;      // states in all; 0: no limit
  double idle_s = 0;  // without a new image; 0: no limit
};

// Images as they arrive in a folder. First the states that the journal knows, while their images
// are there unchanged; then every new image, by name. A file counts once its size and time stay the
// same and it decodes; one that stays undecodable is named with the reason and left out until it
// changes. An image has the row of pipe.csv with its file name: of the folder's table if it has
// one, else of the session's; without a row the image stands for itself. With a table the
// reference is its first row, which is waited for.
class WatchedFolder : public PipeStream {
 public:
  WatchedFolder(const WatchChoices& choices, const Session& session, StrainJournal& journal,
                Console& console)
      : choices_(choices),
        most_(choices.until > 0 ? std::min(choices.until, static_cast<int>(kMostTableRows))
                                : static_cast<int>(kMostTableRows)),
        session_(session),
        journal_(journal),
        console_(console) {}

  Result<std::optional<PipeImage>> Next() override;
  // Prints the state.
  Status Keep(const PipeSequence& sequence, const PipeImage& image, const MeasuredState& state,
              double spent_ms) override;
  // Prints why an image could not be measured, and goes on.
  bool Skip(const Error& error) override;
  void Stop() override { stop_ = true; }

 private:
  struct Stamp {
    std::uintmax_t size = 0;
    std::filesystem::file_time_type time;
    bool operator==(const Stamp&) const = default;
  };
  struct File {
    Stamp stamp;
    std::chrono::steady_clock::time_point since;  // unchanged
    bool done = false;                            // handed out
    bool bad = false;                             // in this form
  };

  Result<std::optional<PipeImage>> NextKnown();
  Result<bool> ReadTable();  // whether it is whole
  void LookAtFiles();
  std::optional<PipeImage> TakeFirstReady();
  std::optional<PipeImage> Decode(const std::string& name, File& file);
  PipeState RowOf(const std::string& name) const;
  bool MayBeNext(const std::string& name) const;
  void SayThatItWaits(const std::string& name);

  const WatchChoices choices_;
  const int most_;  // states
  const Session& session_;
  StrainJournal& journal_;
  Console& console_;
  std::atomic<bool> stop_ = false;
  std::atomic<int> kept_ = 0, skipped_ = 0;
  // Of the thread that calls Next.
  std::vector<PipeState> table_;
  std::string table_text_;  // that `table_` was read from
  bool table_seen_ = false;
  std::chrono::steady_clock::time_point table_since_;  // not whole
  std::map<std::string, File> files_;
  int handed_out_ = 0;
  bool all_known_handed_out_ = false;
  bool said_that_it_waits_ = false;
};

}  // namespace telestrain
