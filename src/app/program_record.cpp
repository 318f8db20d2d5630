#include "app/program_record.h"

#include <sys/utsname.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/parallel.h"
#include "correlation/kernels.h"

namespace telestrain {

using Json = nlohmann::ordered_json;

Json ProgramRecord() {
  Json libraries;
  std::string list = TELESTRAIN_LIBRARIES;  // "name version|name version|…" from CMake
  while (!list.empty()) {
    const std::string item = list.substr(0, list.find('|'));
    list.erase(0, item.size() + 1);
    libraries[item.substr(0, item.find(' '))] = item.substr(item.find(' ') + 1);
  }
  return {{"name", "telestrain"}, {"version", TELESTRAIN_VERSION}, {"libraries", libraries}};
}

Json HostRecord() {
  utsname system{};
  ::uname(&system);
  Json instructions = Json::array();
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) instructions.push_back("avx2");
  if (__builtin_cpu_supports("fma")) instructions.push_back("fma");
  if (__builtin_cpu_supports("avx512f")) instructions.push_back("avx512f");
#endif
  return {{"name", system.nodename},
          {"system", std::string(system.sysname) + " " + system.release},
          {"architecture", system.machine},
          {"vector_instructions", instructions},
          {"vector_level", correlation::NameOf(correlation::ActiveVectorLevel())},
          {"threads", DefaultThreads()}};
}

}  // namespace telestrain
