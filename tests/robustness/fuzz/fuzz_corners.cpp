#include <sstream>

#include "base/console.h"
#include "robustness/fuzz/fuzz_target.h"
#include "target/corner_import.h"
#include "target/corners_file.h"
#include "target/detection.h"

namespace telestrain::fuzz {
namespace {

const std::set<std::string> kFiles{"corners.vnl", "corner_covariances.csv", "detection.json"};

// Boards of 3 x 2 corners in two views.
Session SmallSession() {
  Session session;
  session.sensor = {200, 100, 5};
  session.lens_magnification = 0.2;
  session.target.columns = 3;
  session.target.rows = 2;
  session.target.square_mm = 1;
  session.target.boards.push_back({"A", Eigen::Vector3d::Zero(), 0});
  session.views.resize(2);
  session.views[0].name = "A1";
  session.views[1].name = "A2";
  session.views[1].region.x = 100;
  for (NominalView& view : session.views) {
    view.group = "A";
    view.region.width = view.region.height = 100;
  }
  session.calibration_images = {{"a.png", "p1", 0}, {"b.png", "p2", 1}};
  session.corners_are_given = true;
  return session;
}

bool AreEqual(const BoardObservation& a, const BoardObservation& b) {
  if (a.image != b.image || a.view != b.view || a.rejected_because != b.rejected_because ||
      a.corners.size() != b.corners.size())
    return false;
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    if (a.corners[i].has_value() != b.corners[i].has_value()) return false;
    if (a.corners[i] && a.corners[i]->pixel != b.corners[i]->pixel) return false;
  }
  return true;
}

void CheckWrittenAgain(const std::vector<BoardObservation>& boards, int corner_count) {
  const auto again = ParseCornersVnl("again", CornersVnlText(boards), corner_count);
  Require(again.ok(), "written corners read: " + (again ? "" : again.error().message));
  Require(again->size() == boards.size(), "as many boards are read as were written");
  for (std::size_t i = 0; i < boards.size(); ++i)
    Require(AreEqual(boards[i], (*again)[i]), "a written board reads back equal");
}

}  // namespace

void FuzzCorners(std::string_view input) {
  static MemoryFolder folder("corners_");
  static const Session session = SmallSession();
  const auto files = FilesIn(input, kFiles);
  folder.Hold(files, kFiles);
  const auto text = files.find("corners.vnl");
  if (text != files.end()) {
    const auto boards = ParseCornersVnl("corners.vnl", text->second, session.target.CornerCount());
    if (Succeeds(boards)) CheckWrittenAgain(*boards, session.target.CornerCount());
  }
  std::ostringstream said;
  Console console(said, said, false);
  Succeeds(ImportCorners(session, folder.path() / "corners.vnl", console));
  Succeeds(ReadDetectedBoards(session, folder.path()));
  Succeeds(ReadDetectedCrosses(folder.path()));
}

}  // namespace telestrain::fuzz
