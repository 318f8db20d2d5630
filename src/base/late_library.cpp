#include "base/late_library.h"

#include <dlfcn.h>

namespace telestrain {

LateLibrary::LateLibrary(const std::string& file)
    : library_(::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
  if (library_) return;
  const char* const said = ::dlerror();
  failure_ = (said ? said : file + " cannot be loaded") +
             std::string("; install the Debian package of that library");
}

void* LateLibrary::Address(const char* symbol) const {
  return library_ ? ::dlsym(library_, symbol) : nullptr;
}

}  // namespace telestrain
