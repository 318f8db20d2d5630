#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "viz/scene/part.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// The interactive scene's library; empty when the program was built without it.
struct VtkJs {
  std::string_view script, license;
};
VtkJs BuiltInVtkJs();

struct ReviewPicture {
  std::string name;  // "array.png"
  std::string png;   // the file's bytes
};

// What a page is made of.
struct ReviewContent {
  std::string version;                                      // of the program
  nlohmann::ordered_json results;                           // results.json
  std::vector<std::pair<std::string, std::string>> hashes;  // SHA-256 by file name
  Scene scene;
  PartList list;
  std::vector<ReviewPicture> pictures;  // in the order of the page
  VtkJs vtk_js;
};

// One HTML file that needs no other and no network: verdict with its reasons, the interactive
// scene, pictures and tables. Without `vtk_js` it says that the scene is missing. The same content
// gives the same bytes. Fails (kBadInput) when results.json lacks what its schema promises.
Result<std::string> ReviewPage(const ReviewContent& content);

}  // namespace telestrain::viz
