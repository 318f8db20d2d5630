#include <sstream>
#include <string>

#include "viz/render.h"

// A library that uses viz privately, as the report or a command does.
std::string RenderThroughAnotherLibrary(const std::string& folder) {
  std::ostringstream out, err;
  telestrain::Console console(out, err, false);
  const auto status = telestrain::RenderResults(folder, {1200, 740}, console);
  return status.ok() ? "" : status.error().message;
}
