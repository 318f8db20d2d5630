#pragma once

#include <filesystem>
#include <vector>

#include "base/console.h"
#include "session/session.h"
#include "target/board_observation.h"

namespace telestrain {

inline constexpr const char* kDetectionSchema = "telestrain.detection/1";

// Everything that the images of the target and of the ruler say, in the order of the session: one
// entry per image and view.
struct Detection {
  std::vector<BoardObservation> boards;
  std::vector<CrossObservation> crosses;
};

// Reads every calibration and ruler image and searches all views, images in parallel. Fails
// (kBadInput) when an image cannot be read or has another size than the sensor.
Result<Detection> DetectAll(const Session& session, Console& console);

// Takes the boards from a corner table (corners_file.h) instead of the calibration images: 0.1 px
// for level 0, twice that for every further level. Images and views of the session that the table
// has no block for become rejected boards. Crosses are found in the ruler images as above. Fails
// (kBadInput) when a block names an image or view that the session has not, or comes twice.
Result<Detection> ImportCorners(const Session& session, const std::filesystem::path& corners_vnl,
                                Console& console);

// corners.vnl, corner_covariances.csv and detection.json in the results folder.
Status WriteDetection(const Session& session, const Detection& detection,
                      const std::filesystem::path& results);

// The boards of corners.vnl with the covariances of corner_covariances.csv (0.1 px times
// 2^level where that file is missing, as for corners from another detector) and the reasons of
// detection.json.
Result<std::vector<BoardObservation>> ReadDetectedBoards(const Session& session,
                                                         const std::filesystem::path& results);
Result<std::vector<CrossObservation>> ReadDetectedCrosses(const std::filesystem::path& results);

}  // namespace telestrain
