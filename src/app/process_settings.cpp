#include "app/process_settings.h"

#include <dlfcn.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "base/parallel.h"
#include "base/value_names.h"
#include "correlation/kernels.h"
#include "target/image_file.h"

namespace telestrain {
namespace {

// Of a library that another library may have brought along, or not.
void CallIfThere(const char* function, int argument) {
  if (void* const found = ::dlsym(RTLD_DEFAULT, function))
    reinterpret_cast<void (*)(int)>(found)(argument);
}

std::vector<std::string> LevelNames() {
  std::vector<std::string> names;
  for (const correlation::VectorLevel level : correlation::kVectorLevels)
    names.push_back(correlation::NameOf(level));
  return names;
}

}  // namespace

void ProcessSettings::AddTo(CLI::App& app) {
  app.add_option("--threads", threads,
                 "threads that the program works on, 1 to " + std::to_string(kMostThreads) +
                     " (default: one per core); the results do not depend on it")
      ->type_name(kCount)
      ->envname("TELESTRAIN_THREADS")
      ->check(CLI::Range(1, kMostThreads));
  app.add_option("--vector", vector_level,
                 "instructions that the correlation uses (default: the best of this processor); "
                 "avx2 and avx512 give the same bits, plain differs in the last digits")
      ->envname("TELESTRAIN_VECTOR")
      ->check(CLI::IsMember(LevelNames()));
}

Status ProcessSettings::Apply() const {
  if (threads > 0) SetDefaultThreads(threads);
  KeepImagesOnOneThread();
  CallIfThere("omp_set_num_threads", DefaultThreads());
  CallIfThere("openblas_set_num_threads", 1);
  if (vector_level.empty()) return {};
  const auto level = correlation::VectorLevelOf(vector_level);
  if (level && correlation::SetVectorLevel(*level)) return {};
  return Error{ErrorKind::kUsage, "--vector " + vector_level +
                                      ": this processor lacks these instructions; the best that "
                                      "it has is " +
                                      correlation::NameOf(correlation::BestVectorLevel())};
}

}  // namespace telestrain
