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

// Of the ruler images only.
Result<std::vector<CrossObservation>> DetectCrosses(const Session& session, Console& console);

// corners.vnl, corner_covariances.csv and detection.json in the results folder.
Status WriteDetection(const Session& session, const Detection& detection,
                      const std::filesystem::path& results);

// Standard deviation of a corner of level 0 that comes without a covariance.
inline constexpr double kForeignSigma_px = 0.1;

// The boards of corners.vnl with the covariances of corner_covariances.csv and the reasons of
// detection.json. Fails (kBadInput) when one of the three is missing or a corner has no covariance.
Result<std::vector<BoardObservation>> ReadDetectedBoards(const Session& session,
                                                         const std::filesystem::path& results);
Result<std::vector<CrossObservation>> ReadDetectedCrosses(const std::filesystem::path& results);

}  // namespace telestrain
