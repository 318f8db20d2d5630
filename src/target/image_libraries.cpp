#include "target/image_libraries.h"

#include <jconfig.h>

#include <opencv2/core/utility.hpp>
#include <opencv2/core/version.hpp>

namespace telestrain {

// The macro is 2.1.5 as bare tokens.
#define TELESTRAIN_TEXT_OF(tokens) #tokens
#define TELESTRAIN_TEXT(macro) TELESTRAIN_TEXT_OF(macro)

std::vector<LibraryVersion> ImageLibraries() {
  return {{"OpenCV", CV_VERSION, cv::getVersionString()},
          {"libjpeg-turbo", TELESTRAIN_TEXT(LIBJPEG_TURBO_VERSION), ""}};
}

}  // namespace telestrain
