#include "viz/matte.h"

#include <algorithm>

#include "base/check.h"

namespace telestrain::viz {

RgbImage Matte(RgbImage on_white, const RgbImage& on_black) {
  TELESTRAIN_CHECK(on_white.rgb.size() == on_black.rgb.size(), "a matte wants equal sizes");
  on_white.alpha.resize(on_white.rgb.size() / 3);
  for (std::size_t i = 0; i < on_white.alpha.size(); ++i) {
    std::uint8_t* white = &on_white.rgb[3 * i];
    const std::uint8_t* black = &on_black.rgb[3 * i];
    int difference = 0;
    for (int c = 0; c < 3; ++c) difference += white[c] - black[c];
    const int darkest = std::min({white[0], white[1], white[2]});
    // Less than 255 - darkest could not make white paper that dark.
    const int alpha = std::clamp(255 - (difference + 1) / 3, 255 - darkest, 255);
    on_white.alpha[i] = static_cast<std::uint8_t>(alpha);
    for (int c = 0; c < 3; ++c) {
      const int ink = white[c] - (255 - alpha);  // alpha times the colour
      white[c] = static_cast<std::uint8_t>(
          alpha == 0 ? 255 : std::clamp((255 * ink + alpha / 2) / alpha, 0, 255));
    }
  }
  return on_white;
}

}  // namespace telestrain::viz
