#include "report/reading/printed_hashes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace telestrain {
namespace {

constexpr std::size_t kMostRows = 500;    // of a page: lines of 4 points are 200
constexpr double kSmallestType_pt = 4;    // ours are 5.4 at least
constexpr double kSameLine_pt = 2;        // a monospaced text stands 0.8 higher than its neighbour
constexpr double kLeastContrast = 0.3;    // of luminance, black on white has 1
constexpr double kNarrowestLetter = 0.4;  // of the size: texts that meet overlap at least so far
constexpr std::size_t kDigits = 64;

bool IsHash(const std::string& text) {
  return text.size() == kDigits && text.find_first_not_of("0123456789abcdef") == text.npos;
}

// Every colour that may lie below it is far from its own.
bool StandsOut(const PageDrawing& drawing, const TextPiece& piece) {
  const auto differs = [&](double luminance) {
    return luminance >= 0 && std::abs(luminance - piece.luminance) >= kLeastContrast;
  };
  for (auto below = drawing.boxes.rbegin(); below != drawing.boxes.rend(); ++below) {
    if (below->order > piece.order || !below->box.Overlaps(piece.box)) continue;
    if (!differs(below->luminance)) return false;
    if (below->is_filled && below->box.Contains(piece.box)) return true;
  }
  return differs(1);  // paper
}

DrawnBox LeastBox(const TextPiece& piece) {
  DrawnBox box = piece.box;
  box.right_pt = box.left_pt + (box.right_pt - box.left_pt) * kNarrowestLetter / 0.6;
  return box;
}

bool IsCovered(const PageDrawing& drawing, const TextPiece& piece) {
  for (const PaintedBox& over : drawing.boxes)
    if (over.order > piece.order && over.box.Overlaps(piece.box)) return true;
  for (const TextPiece& other : drawing.pieces)
    if (&other != &piece && LeastBox(other).Overlaps(LeastBox(piece))) return true;
  return false;
}

bool IsVisible(const PageDrawing& drawing, const TextPiece& piece) {
  return piece.is_upright && piece.size_pt >= kSmallestType_pt &&
         piece.clip.Contains(piece.x_pt, piece.y_pt) && piece.clip.Contains(LeastBox(piece)) &&
         StandsOut(drawing, piece) && !IsCovered(drawing, piece);
}

const TextPiece* FirstOfRow(const PageDrawing& drawing, const TextPiece& hash) {
  const TextPiece* first = nullptr;
  for (const TextPiece& piece : drawing.pieces)
    if (std::abs(piece.y_pt - hash.y_pt) <= kSameLine_pt && piece.x_pt < hash.x_pt &&
        (!first || piece.x_pt < first->x_pt))
      first = &piece;
  return first;
}

}  // namespace

std::vector<PrintedHash> PrintedHashes(const PageDrawing& drawing) {
  std::vector<const TextPiece*> hashes;
  for (const TextPiece& piece : drawing.pieces)
    if (IsHash(piece.text)) hashes.push_back(&piece);
  if (hashes.size() > kMostRows) throw std::runtime_error("a page of it has too much text");
  std::stable_sort(hashes.begin(), hashes.end(),
                   [](const TextPiece* a, const TextPiece* b) { return a->y_pt > b->y_pt; });
  std::vector<PrintedHash> rows;
  for (const TextPiece* hash : hashes) {
    const TextPiece* first = FirstOfRow(drawing, *hash);
    if (first && IsVisible(drawing, *hash) && IsVisible(drawing, *first))
      rows.push_back({first->text, hash->text});
  }
  return rows;
}

}  // namespace telestrain
