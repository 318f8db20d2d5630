#include "app/correlate_outputs.h"

#include <set>

#include "app/correlate_arguments.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

std::string LowerCase(std::string text) {
  for (char& byte : text)
    if (byte >= 'A' && byte <= 'Z') byte = static_cast<char>(byte - 'A' + 'a');
  return text;
}

}  // namespace

std::vector<std::string> OutputStems(const std::vector<std::string>& images) {
  std::set<std::string> taken{"pattern", "correlate"};
  std::vector<std::string> stems;
  for (const std::string& image : images) {
    const std::string own = fs::path(image).stem().string();
    std::string stem = own;
    for (int copy = 2; !taken.insert(LowerCase(stem)).second; ++copy)
      stem = own + "_" + std::to_string(copy);
    stems.push_back(stem);
  }
  return stems;
}

Status CheckOutputs(const fs::path& folder, const std::vector<std::string>& stems,
                    const std::vector<fs::path>& inputs) {
  std::vector<std::string> names{"pattern.txt", "pattern.json", "pattern.png", "correlate.json"};
  for (const std::string& stem : stems)
    for (const char* ending : {".csv", ".vtp", ".png"}) names.push_back(stem + ending);
  for (const std::string& name : names) {
    std::error_code unreadable;
    if (!fs::exists(folder / name, unreadable)) continue;
    for (const fs::path& input : inputs)
      if (fs::equivalent(folder / name, input, unreadable))
        return WrongUsage("--out " + folder.string() + ": the result " + name +
                          " would take the place of the input " + input.string() +
                          "; choose another folder");
  }
  return {};
}

}  // namespace telestrain
