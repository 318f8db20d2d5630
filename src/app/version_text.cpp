#include "app/version_text.h"

#include <elf.h>
#include <link.h>
#include <sys/utsname.h>

#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "app/build_record.h"
#include "base/library_version.h"
#include "calibration/solver_versions.h"
#include "correlation/kernels.h"
#include "report/report_libraries.h"
#include "target/image_libraries.h"
#include "viz/viz_libraries.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

// Schemas of JSON and TOML files, then those of others; a test looks for more in the source.
constexpr std::array kFormats = {"telestrain.calibration/1",
                                 "telestrain.comparison/1",
                                 "telestrain.correlate/1",
                                 "telestrain.design/1",
                                 "telestrain.detection/1",
                                 "telestrain.inputs/1",
                                 "telestrain.mrcal/1",
                                 "telestrain.pattern/1",
                                 "telestrain.results/1",
                                 "telestrain.ruler/1",
                                 "telestrain.session/1",
                                 "telestrain.strain/1",
                                 "telestrain.strain_state/1",
                                 "telestrain.study/1",
                                 "telestrain.truth/1",
                                 "DCC 3.3.0",
                                 "PDF/A-3a",
                                 "PDF/A-1b",
                                 "PDF/UA-1"};

std::size_t Aligned(std::size_t size) { return (size + 3) / 4 * 4; }

// The build's note among the notes of one segment.
std::string BuildIdIn(const char* notes, std::size_t size) {
  while (size >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes, sizeof note);
    const std::size_t name = sizeof note, id = name + Aligned(note.n_namesz);
    const std::size_t end = id + Aligned(note.n_descsz);
    if (end > size) return "";
    if (note.n_type == NT_GNU_BUILD_ID && std::strncmp(notes + name, "GNU", 4) == 0) {
      std::string text;
      for (std::size_t i = 0; i < note.n_descsz; ++i) {
        constexpr const char* kDigits = "0123456789abcdef";
        const auto byte = static_cast<unsigned char>(notes[id + i]);
        text += {kDigits[byte >> 4], kDigits[byte & 15]};
      }
      return text;
    }
    notes += end;
    size -= end;
  }
  return "";
}

// The first object that the loader lists is the program itself.
int ReadBuildId(dl_phdr_info* object, std::size_t, void* result) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const std::string id = BuildIdIn(
        reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr), segment.p_memsz);
    if (!id.empty()) *static_cast<std::string*>(result) = id;
  }
  return 1;
}

Json LibrariesJson() {
  std::vector<LibraryVersion> all = SolverVersions();
  for (const auto& list : {ImageLibraries(), viz::Libraries(), ReportLibraries()})
    all.insert(all.end(), list.begin(), list.end());
  Json json = Json::array();
  for (const LibraryVersion& library : all) {
    json.push_back({{"name", library.name}, {"compiled", library.compiled}});
    if (!library.loaded.empty()) json.back()["loaded"] = library.loaded;
  }
  return json;
}

std::string LibraryLine(const Json& library) {
  const std::string compiled = library.at("compiled"), loaded = library.value("loaded", "");
  std::string line = library.at("name").get<std::string>() + " " + compiled;
  if (!loaded.empty()) line += ", loaded " + loaded;
  return line + (loaded.empty() || loaded == compiled ? "" : " (differs)");
}

}  // namespace

std::string BuildId() {
  std::string id;
  ::dl_iterate_phdr(ReadBuildId, &id);
  return id;
}

Json VersionRecord() {
  utsname system{};
  ::uname(&system);
  return {{"telestrain", TELESTRAIN_VERSION},
          {"revision", kBuildRecord.revision},
          {"build-id", BuildId()},
          {"build-type", kBuildRecord.build_type},
          {"compiler", kBuildRecord.compiler},
          {"compiler-flags", kBuildRecord.flags},
          {"architecture", system.machine},
          {"vector-instructions", correlation::NameOf(correlation::ActiveVectorLevel())},
          {"library", LibrariesJson()},
          {"format", kFormats},
          {"licence", "Apache-2.0"}};
}

std::string VersionText() {
  const Json record = VersionRecord();
  std::string text;
  for (const auto& [key, value] : record.items()) {
    const Json list = value.is_array() ? value : Json::array({value});
    for (const Json& item : list)
      text += key + (text.empty() ? " " : ": ") +
              (item.is_object() ? LibraryLine(item) : item.get<std::string>()) + "\n";
  }
  text.pop_back();
  return text;
}

}  // namespace telestrain
