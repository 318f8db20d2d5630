#include "base/late_library.h"

#include <dlfcn.h>

namespace telestrain {

LateLibrary::LateLibrary(const std::string& file)
    : file_(file), library_(::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
  if (library_) return;
  const char* const said = ::dlerror();
  failure_ = (said ? said : file + " cannot be loaded") +
             std::string("; install the Debian package of that library");
}

std::string LateLibrary::Failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void* LateLibrary::Address(const char* symbol) const {
  if (!library_) return nullptr;
  void* const address = ::dlsym(library_, symbol);
  const std::lock_guard lock(mutex_);
  if (!address)
    failure_ = file_ + " has no function " + symbol +
               "; install that library as this release of Debian has it";
  return address;
}

}  // namespace telestrain
