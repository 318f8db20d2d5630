#include "base/value_names.h"

namespace telestrain {

std::string Among(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ",") + value;
  return "TEXT:{" + text + "}";
}

}  // namespace telestrain
