#pragma once

namespace telestrain {

// Positions on a page: points (1/72 inch) from the bottom left corner, y upwards, as in PDF.
struct PagePoint {
  double x_pt = 0, y_pt = 0;
};
struct PageBox {
  double left_pt = 0, bottom_pt = 0, width_pt = 0, height_pt = 0;
  double right_pt() const { return left_pt + width_pt; }
  double top_pt() const { return bottom_pt + height_pt; }
};

inline constexpr double kPointsPerMm = 72 / 25.4;
inline constexpr double kPageWidth_pt = 210 * kPointsPerMm;  // A4
inline constexpr double kPageHeight_pt = 297 * kPointsPerMm;

struct Color {
  double red = 0, green = 0, blue = 0;  // 0 to 1
};
// 0x14324F.
constexpr Color ColorOf(unsigned rgb) {
  return {(rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0};
}

enum class Face { kRegular, kBold, kMono };
enum class Align { kLeft, kCenter, kRight };

struct TextStyle {
  Face face = Face::kRegular;
  double size_pt = 9;
  Color color;
  double LineHeight_pt() const { return 1.32 * size_pt; }
};

enum class Dash { kSolid, kDashed, kDotted, kDashDot, kLong };

struct Stroke {
  Color color;
  double width_pt = 0.5;
  Dash dash = Dash::kSolid;
};

}  // namespace telestrain
