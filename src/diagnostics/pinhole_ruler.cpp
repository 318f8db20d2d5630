#include "diagnostics/pinhole_ruler.h"

#include <map>
#include <utility>

namespace telestrain {
namespace {

// Pixel of a cross by image and view.
using CrossPixels = std::map<std::pair<std::string, std::string>, Eigen::Vector2d>;

std::vector<PinholeMeasurement> MeasurementsOf(const std::vector<PinholeView>& views,
                                               const CrossPixels& pixels, const std::string& image,
                                               const std::string& group) {
  std::vector<PinholeMeasurement> measurements;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto at = pixels.find({image, views[v].name});
    if (views[v].group == group && at != pixels.end())
      measurements.push_back({static_cast<int>(v), at->second});
  }
  return measurements;
}

PinholeRulerLength MeasureOne(const Session& session, const std::vector<PinholeView>& views,
                              const CrossPixels& pixels, const std::string& image) {
  PinholeRulerLength length;
  length.image = image;
  const std::vector<std::string> groups = session.Groups();
  if (groups.size() < 2) {
    length.rejected_because = "the session has one group of views, a ruler needs two";
    return length;
  }
  const auto a = MeasurementsOf(views, pixels, image, groups[0]);
  const auto b = MeasurementsOf(views, pixels, image, groups[1]);
  if (a.size() < 2 || b.size() < 2) {
    length.rejected_because = "a group has fewer than two views of its cross";
    return length;
  }
  const auto end_a = Triangulate(views, a), end_b = Triangulate(views, b);
  if (!end_a || !end_b) {
    length.rejected_because = "the rays of a cross meet in no point before the cameras";
    return length;
  }
  length.end_a_in_array_mm = *end_a;
  length.end_b_in_array_mm = *end_b;
  length.length_mm = (*end_b - *end_a).norm();
  length.error_um = 1000 * (length.length_mm - session.ruler.length_mm);
  return length;
}

}  // namespace

std::vector<PinholeRulerLength> MeasureRulerWithPinhole(
    const Session& session, const std::vector<PinholeView>& views,
    const std::vector<CrossObservation>& crosses) {
  CrossPixels pixels;
  for (const CrossObservation& cross : crosses)
    if (cross.center) pixels[{cross.image, cross.view}] = cross.center->pixel;
  std::vector<PinholeRulerLength> lengths;
  for (const std::string& image : session.ruler_images)
    lengths.push_back(MeasureOne(session, views, pixels, image));
  return lengths;
}

}  // namespace telestrain
