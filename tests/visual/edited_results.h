#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "base/files.h"
#include "base/json_file.h"

namespace telestrain::visual_test {

// Replaces the first `from` in a file of the fixture.
inline void Damage(const std::filesystem::path& path, const std::string& from,
                   const std::string& to) {
  std::string text = ReadFile(path, kMostResultBytes).value();
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error(path.string() + " has no " + from);
  const Status written = WriteFileAtomically(path, text.replace(at, from.size(), to));
  if (!written) throw std::runtime_error(written.error().message);
}

inline nlohmann::ordered_json JsonOf(const std::filesystem::path& path) {
  return nlohmann::ordered_json::parse(ReadFile(path, kMostResultBytes).value());
}

inline void EditJson(const std::filesystem::path& path,
                     const std::function<void(nlohmann::ordered_json&)>& edit) {
  nlohmann::ordered_json json = JsonOf(path);
  edit(json);
  const Status written = WriteJson(path, json);
  if (!written) throw std::runtime_error(written.error().message);
}

}  // namespace telestrain::visual_test
