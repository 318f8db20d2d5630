#include "viz/desk/x_display.h"

#include <cstdlib>
#include <string>

// Last: it defines Status, None and other plain words as macros.
#include <GL/glx.h>

namespace telestrain::viz {
namespace {

Error NoDisplay(const std::string& problem) {
  return OutputFailed("no window can be opened: " + problem +
                      "; run it on a desktop, or use what needs no screen: 'telestrain review' "
                      "(the scene as a page to turn) or 'telestrain render' (pictures)");
}

}  // namespace

Result<std::shared_ptr<void>> OpenDisplay() {
  const char* name = std::getenv("DISPLAY");
  if (name == nullptr || *name == '\0') return NoDisplay("DISPLAY is not set");
  const std::string where = std::string("DISPLAY ") + name;
  const std::shared_ptr<Display> display(XOpenDisplay(nullptr), [](Display* opened) {
    if (opened != nullptr) XCloseDisplay(opened);
  });
  if (display == nullptr) return NoDisplay(where + " names no X server that lets us in");
  int error_base = 0, event_base = 0;
  if (glXQueryExtension(display.get(), &error_base, &event_base) == 0)
    return NoDisplay("the X server of " + where + " has no OpenGL (GLX)");
  return std::shared_ptr<void>(display);
}

}  // namespace telestrain::viz
