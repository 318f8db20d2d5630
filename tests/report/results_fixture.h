#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace telestrain {

// A results folder as the other modules would leave it: 24 target images in four views, 12 ruler
// images, 6 pipe states with gauges, 46 input files, three pictures. The numbers are plausible and
// come from a fixed pseudo-random sequence, so every run writes the same bytes.
struct ResultsFixture {
  nlohmann::ordered_json inputs, detection, calibration, diagnosis, ruler, strain;
  std::string residuals_csv;
  bool pictures = true;
};

ResultsFixture PlausibleResults();

// Writes what is not null. The folder is emptied first.
void WriteResults(const ResultsFixture& fixture, const std::filesystem::path& folder);

// An RGB picture of a strained cylinder.
void WritePicture(const std::filesystem::path& path, int width_px, int height_px);

// A folder of the running test below the system's folder for temporary files.
std::filesystem::path TestFolder(const std::string& name);

}  // namespace telestrain
