#include "target/opencv_version.h"

#include <opencv2/core/utility.hpp>
#include <opencv2/core/version.hpp>

namespace telestrain {

LibraryVersion OpenCvVersion() { return {"OpenCV", CV_VERSION, cv::getVersionString()}; }

}  // namespace telestrain
