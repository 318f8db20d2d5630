#include <fstream>
#include <nlohmann/json.hpp>

#include "robustness/fuzz/fuzz_target.h"
#include "session/pipe_table.h"
#include "session/session.h"
#include "session/session_record.h"
#include "session/session_rig.h"

namespace telestrain::fuzz {
namespace {

const std::set<std::string> kFiles{"session.toml", "calibration.csv", "ruler.csv", "pipe.csv"};

// Images that tables of inputs can name. They are empty: reading a session decodes none.
const std::set<std::string> kImages{"a.png", "b.png", "ruler/ruler_01.png", "pipe/pipe_01.png",
                                    "pipe/pipe_02.png"};

// Two folders: what is read, and what is written from it.
struct Folders {
  MemoryFolder read{"session_read_"}, written{"session_written_"};
  Folders() {
    for (const MemoryFolder* folder : {&read, &written})
      for (const std::string& image : kImages) {
        std::filesystem::create_directories((folder->path() / image).parent_path());
        std::ofstream(folder->path() / image, std::ios::binary);
      }
  }
};

std::string Told(const Session& session) {
  std::string text = SessionRecord(session).dump();
  for (const std::string& column : session.gauge_columns) text += "\n" + column;
  for (const PipeState& state : session.pipe_states) {
    text += "\n" + nlohmann::json({state.image, state.cycle, state.step}).dump();
    text += nlohmann::json(state.time_s.value_or(-1e300)).dump();
    text += nlohmann::json(state.temperature_c.value_or(-1e300)).dump();
    for (const auto& gauge : state.gauges_microstrain)
      text += " " + nlohmann::json(gauge.value_or(-1e300)).dump();
  }
  return text;
}

void UseGeometry(const Session& session) {
  for (const NominalView& view : session.views) session.NominalTelecentricView(view);
  for (const SubBoard& board : session.target.boards) session.target.CornersInTarget(board);
  Succeeds(RigOfSession(session));
}

}  // namespace

void FuzzSession(std::string_view input) {
  static Folders folders;
  folders.read.Hold(FilesIn(input, kFiles), kFiles);
  Succeeds(ReadRig(folders.read.path()));
  const auto session = ReadSession(folders.read.path(), true);
  if (!Succeeds(session)) return;
  UseGeometry(*session);
  Succeeds(ReadPipeTableOf(*session, folders.read.path() / "pipe.csv"));
  auto record = SessionRecord(*session), again_record = SessionRecord(SessionOfRecord(record));
  for (auto* one : {&record, &again_record}) one->at("counts").erase("pipe_images");
  Require(again_record == record, "a session's record tells all but the states of the pipe");
  Require(Succeeds(WriteSession(*session, folders.written.path())), "a session can be written");
  const auto again = ReadSession(folders.written.path(), true);
  Require(again.ok(), "a written session reads: " + (again ? "" : again.error().message));
  Require(Told(*again) == Told(*session), "a written session reads back equal");
}

}  // namespace telestrain::fuzz
