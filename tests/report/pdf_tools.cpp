#include "pdf_tools.h"

#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace telestrain {

ToolRun RunTool(const std::string& command_line) {
  ToolRun run;
  std::FILE* pipe = ::popen((command_line + " 2>&1").c_str(), "r");
  if (!pipe) return run;
  std::array<char, 4096> buffer;
  std::size_t size = 0;
  while ((size = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0)
    run.output.append(buffer.data(), size);
  run.ok = ::pclose(pipe) == 0;
  return run;
}

std::string WithoutSpace(const std::string& text) {
  std::string rest;
  for (const char c : text)
    if (!std::isspace(static_cast<unsigned char>(c))) rest.push_back(c);
  return rest;
}

std::string PreflightCommand() {
  std::string path;
  for (const char* jar : {"preflight", "pdfbox2", "fontbox2", "xmpbox", "commons-logging",
                          "commons-io", "javax.activation", "jaxb-api"}) {
    const std::string file = "/usr/share/java/" + std::string(jar) + ".jar";
    if (!std::filesystem::exists(file)) return "";
    path += (path.empty() ? "" : ":") + file;
  }
  if (!RunTool("java -version").ok) return "";
  return "java -cp " + path + " org.apache.pdfbox.preflight.Validator_A1b";
}

std::string FileBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace telestrain
