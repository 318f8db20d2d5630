#include "viz/vtk_messages.h"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <algorithm>

namespace telestrain::viz {
namespace {

class MessageCollector : public vtkOutputWindow {
 public:
  static MessageCollector* New();
  vtkTypeMacro(MessageCollector, vtkOutputWindow) void DisplayText(const char*) override {}
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    if (first_error_.empty()) first_error_ = text;
  }
  std::string first_error_;
};
vtkStandardNewMacro(MessageCollector);

std::mutex& VtkMutex() {
  static std::mutex mutex;
  return mutex;
}

MessageCollector* Collector() {
  return MessageCollector::SafeDownCast(vtkOutputWindow::GetInstance());
}

// "ERROR: In file.cxx, line 12\nvtkFoo (0x1234): text\n\n" -> "text".
std::string Essence(const std::string& message) {
  const auto address = message.find("): ");
  std::string text = address == std::string::npos ? message : message.substr(address + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto end = text.find_last_not_of(' ');
  return end == std::string::npos ? "unknown error" : text.substr(0, end + 1);
}

}  // namespace

VtkMessages::VtkMessages() : lock_(VtkMutex()) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // it would print them as well
  auto collector = vtkSmartPointer<MessageCollector>::New();
  vtkOutputWindow::SetInstance(collector);
}

VtkMessages::~VtkMessages() { vtkOutputWindow::SetInstance(nullptr); }

std::string VtkMessages::FirstError() const {
  const MessageCollector* collector = Collector();
  if (collector == nullptr || collector->first_error_.empty()) return "";
  return Essence(collector->first_error_);
}

}  // namespace telestrain::viz
