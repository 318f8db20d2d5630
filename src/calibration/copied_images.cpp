#include "calibration/copied_images.h"

#include <algorithm>
#include <map>

namespace telestrain {
namespace {

bool ShowSameCorners(const CalibrationData& data, int image, int other) {
  std::vector<const BoardData*> a, b;
  for (const BoardData& board : data.boards) {
    if (board.image == image) a.push_back(&board);
    if (board.image == other) b.push_back(&board);
  }
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto* p, const auto* q) {
    return p->view == q->view && p->corner == q->corner && p->pixels == q->pixels;
  });
}

}  // namespace

void DropCopiedImages(const Session& session, CalibrationData& data) {
  const int images = static_cast<int>(data.images.size());
  std::map<std::pair<double, double>, int> first_with;  // by the first corner
  std::vector<int> copy_of(data.images.size(), -1);
  for (const BoardData& board : data.boards) {
    if (copy_of[static_cast<std::size_t>(board.image)] >= 0 || board.Count() == 0) continue;
    const auto [at, is_new] =
        first_with.try_emplace({board.pixels(0, 0), board.pixels(1, 0)}, board.image);
    if (!is_new && at->second != board.image && ShowSameCorners(data, board.image, at->second))
      copy_of[static_cast<std::size_t>(board.image)] = at->second;
  }
  if (std::count(copy_of.begin(), copy_of.end(), -1) == images) return;
  for (const BoardData& board : data.boards) {
    const int original = copy_of[static_cast<std::size_t>(board.image)];
    if (original < 0) continue;
    data.rejected.push_back({data.images[static_cast<std::size_t>(board.image)].image,
                             session.views[static_cast<std::size_t>(board.view)].name,
                             "a copy of " + data.images[static_cast<std::size_t>(original)].image +
                                 ": the same corners to the last digit",
                             static_cast<int>(board.Count())});
  }
  std::erase_if(data.boards, [&](const BoardData& b) {
    return copy_of[static_cast<std::size_t>(b.image)] >= 0;
  });
  data.DropUndeterminedImages(session);
}

}  // namespace telestrain
