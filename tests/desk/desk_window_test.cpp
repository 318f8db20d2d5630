#include "viz/desk/desk_window.h"

#include <gtest/gtest.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "desk/x_server.h"
#include "export/small_scene.h"
#include "viz/desk/desk_control.h"
#include "viz/desk/desk_style.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

using testing::SmallScene;

// A window of its own X server, driven by the events that VTK makes of those of X.
class Desk : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!server_.problem().empty()) GTEST_SKIP() << server_.problem();
    folder_ = std::filesystem::path(TELESTRAIN_BINARY_DIR) / "desk_test" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    const Scene scene = SmallScene();
    model_ = std::make_unique<DeskModel>("small", scene, *ChooseValues(scene, "largest", ""));
    auto window = DeskWindow::Open(model_.get(), 1000, 700);
    ASSERT_TRUE(window.ok()) << window.error().message;
    window_ = std::move(window).value();
    control_ = std::make_unique<DeskControl>(model_.get(), window_.get(), folder_);
    interactor_ = MakeInteractor(window_.get(), control_.get());
    window_->Render();
  }
  void TearDown() override {
    interactor_ = nullptr;  // before the window
    window_.reset();
  }

  void Key(const std::string& symbol) {
    interactor_->SetKeySym(symbol.c_str());
    interactor_->InvokeEvent(vtkCommand::KeyPressEvent);
  }
  void Mouse(const Eigen::Vector2d& pixel, unsigned long event) {
    interactor_->SetEventInformation(static_cast<int>(std::lround(pixel.x())),
                                     static_cast<int>(std::lround(pixel.y())));
    interactor_->InvokeEvent(event);
  }
  void Click(const Eigen::Vector2d& pixel) {
    Mouse(pixel, vtkCommand::LeftButtonPressEvent);
    Mouse(pixel, vtkCommand::LeftButtonReleaseEvent);
  }
  // The inner measured point of patch A in row 1, column 2 of a state.
  Eigen::Vector3d MeasuredPoint(std::size_t state) const {
    return model_->scene().pipe->states[state].surface.points_in_array_mm[kPoint];
  }
  std::array<int, 3> ColorAt(const RgbImage& image, const Eigen::Vector2d& pixel) const {
    const auto row = static_cast<std::size_t>(image.height_px - 1 - std::lround(pixel.y()));
    const auto at = 3 * (row * static_cast<std::size_t>(image.width_px) +
                         static_cast<std::size_t>(std::lround(pixel.x())));
    return {image.rgb.at(at), image.rgb.at(at + 1), image.rgb.at(at + 2)};
  }
  // The colour drawn at the measured point against that of its value.
  void ExpectColorOfValue() {
    const auto image = window_->Grab();
    ASSERT_TRUE(image.ok()) << image.error().message;
    const ShownValues& shown = *model_->shown();
    const Surface& surface = model_->scene().pipe->states[shown.state].surface;
    const double value = surface.Find(shown.quantity.key)->values[kPoint];
    const auto found = ColorAt(*image, window_->Camera().PixelOf(MeasuredPoint(shown.state)));
    const auto wanted = BytesOf(ValueColorMap(shown.scale).At(value));
    // A step of the table changes a channel by 3 at most, and half a pixel off the value by less
    // than a step.
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(found[i], wanted[i], 4) << shown.quantity.key << " state " << shown.state;
  }
  bool HasText(const std::string& part) const {
    const auto texts = window_->Texts();
    return std::any_of(texts.begin(), texts.end(), [&](const PlacedText& text) {
      return text.text.find(part) != std::string::npos;
    });
  }
  const HotArea& Area(DeskAction action, int argument) const {
    const auto& areas = window_->hot_areas();
    const auto found = std::find_if(areas.begin(), areas.end(), [&](const HotArea& area) {
      return area.action == action && area.argument == argument;
    });
    if (found == areas.end()) throw std::runtime_error("the panel has no such area");
    return *found;
  }
  static Eigen::Vector2d MiddleOf(const PixelBox& box) {
    return {box.left + 0.5 * box.width, box.bottom + 0.5 * box.height};
  }

  static constexpr std::size_t kPoint = 1 * testing::kColumns + 2;
  desk_test::XServer server_;
  std::filesystem::path folder_;
  std::unique_ptr<DeskModel> model_;
  std::unique_ptr<DeskWindow> window_;
  std::unique_ptr<DeskControl> control_;
  vtkSmartPointer<vtkRenderWindowInteractor> interactor_;
};

TEST_F(Desk, DrawsTheSurfaceInTheColoursOfItsValuesInEveryStateAndQuantity) {
  model_->ShowOnly({Layer::kSurface});
  Key("3");
  for (const char* key : {"Left", "Right", "Down", "Right", "Up", "c"}) {
    Key(key);
    ExpectColorOfValue();
  }
  EXPECT_EQ(model_->shown()->state, 2U);
  EXPECT_TRUE(HasText("state 2 of 0 to 2"));
  EXPECT_TRUE(HasText("axial strain / \u00b5\u03b5"));
}

TEST_F(Desk, ProjectsAsVtkDoes) {
  for (const char* key : {"1", "2", "3", "4"}) {
    Key(key);
    vtkRenderer* scene = window_->window()->GetRenderers()->GetFirstRenderer();
    for (const Eigen::Vector3d& point : {MeasuredPoint(1), Eigen::Vector3d(20, -3, 5)}) {
      scene->SetWorldPoint(point.x(), point.y(), point.z(), 1);
      scene->WorldToDisplay();
      const double* theirs = scene->GetDisplayPoint();
      const Eigen::Vector2d ours = window_->Camera().PixelOf(point);
      // VTK counts from the corner of the corner pixel or its middle, as its versions differ.
      EXPECT_NEAR(ours.x(), theirs[0], 0.51) << key;
      EXPECT_NEAR(ours.y(), theirs[1], 0.51) << key;
    }
  }
}

TEST_F(Desk, ClickKeepsTheFactsOfTheMeasuredPointUntilOneClicksOnNothing) {
  Key("4");
  EXPECT_TRUE(HasText("POINT AT SOMETHING"));
  Click(window_->Camera().PixelOf(MeasuredPoint(1)));
  EXPECT_TRUE(HasText("surface A (kept)"));
  EXPECT_TRUE(HasText("axial strain"));
  EXPECT_TRUE(HasText("678.0 \u00b5\u03b5"));
  EXPECT_TRUE(HasText("standard uncertainty along the pipe"));
  Mouse({3, 3}, vtkCommand::MouseMoveEvent);
  EXPECT_TRUE(HasText("(kept)"));
  Click({3, 690});
  EXPECT_TRUE(HasText("POINT AT SOMETHING"));
}

TEST_F(Desk, PointingTellsWithoutAClick) {
  Key("4");
  Mouse(window_->Camera().PixelOf(MeasuredPoint(1)), vtkCommand::MouseMoveEvent);
  EXPECT_TRUE(HasText("678.0 \u00b5\u03b5"));
  Mouse({3, 690}, vtkCommand::MouseMoveEvent);
  EXPECT_FALSE(HasText("678.0 \u00b5\u03b5"));
}

TEST_F(Desk, DraggingTurnsTheSceneAndPicksNothing) {
  const Eigen::Vector3d before = window_->Camera().camera.towards_viewer;
  Mouse({300, 300}, vtkCommand::LeftButtonPressEvent);
  Mouse({340, 320}, vtkCommand::MouseMoveEvent);
  Mouse({340, 320}, vtkCommand::LeftButtonReleaseEvent);
  EXPECT_GT((window_->Camera().camera.towards_viewer - before).norm(), 0.05);
  EXPECT_FALSE(control_->pick().has_value());
}

TEST_F(Desk, WheelZooms) {
  const double before_mm = window_->Camera().camera.half_height_mm;
  Mouse({300, 300}, vtkCommand::MouseWheelForwardEvent);
  EXPECT_LT(window_->Camera().camera.half_height_mm, before_mm);
}

TEST_F(Desk, PanelTogglesLayersStepsQuantitiesAndSlidesThroughStates) {
  Click(MiddleOf(Area(DeskAction::kToggleLayer, static_cast<int>(Layer::kViews)).box));
  EXPECT_FALSE(model_->Shows(Layer::kViews));
  Key("v");
  EXPECT_TRUE(model_->Shows(Layer::kViews));
  Click(MiddleOf(Area(DeskAction::kStepQuantity, 1).box));
  EXPECT_EQ(model_->shown()->quantity.key, "hoop_microstrain");
  EXPECT_TRUE(HasText("hoop strain / \u00b5\u03b5"));
  const Eigen::Vector3d before = window_->Camera().camera.towards_viewer;
  Mouse(MiddleOf(Area(DeskAction::kShowState, 0).box), vtkCommand::LeftButtonPressEvent);
  EXPECT_EQ(model_->shown()->state, 0U);
  Mouse(MiddleOf(Area(DeskAction::kShowState, 2).box), vtkCommand::MouseMoveEvent);
  EXPECT_EQ(model_->shown()->state, 2U);
  Mouse({300, 300}, vtkCommand::LeftButtonReleaseEvent);
  EXPECT_EQ(window_->Camera().camera.towards_viewer, before);
}

TEST_F(Desk, SavesEveryPictureUnderANewName) {
  Key("4");
  Click(window_->Camera().PixelOf(MeasuredPoint(1)));
  Key("s");
  Key("s");
  EXPECT_TRUE(HasText("saved "));
  for (const char* name :
       {"telestrain_state_1_axial_microstrain.png", "telestrain_state_1_axial_microstrain_2.png"})
    EXPECT_GT(std::filesystem::file_size(folder_ / name), 5000U) << name;
}

TEST_F(Desk, HelpComesAndGoes) {
  EXPECT_FALSE(HasText("the next state"));
  Key("h");
  EXPECT_TRUE(HasText("the next state"));
  Key("H");
  EXPECT_FALSE(HasText("the next state"));
}

TEST_F(Desk, TextsStayInTheWindowAndApart) {
  Key("2");  // the views stand behind each other
  for (const char* key : {"h", "3", "4"}) {
    Key(key);
    const auto texts = window_->Texts();
    ASSERT_GT(texts.size(), 15U);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const PixelBox& box = texts[i].box;
      EXPECT_TRUE(box.left >= 0 && box.Right() <= 1000) << texts[i].text;
      EXPECT_TRUE(box.bottom >= 0 && box.Top() <= 700) << texts[i].text;
      for (std::size_t j = 0; j < i; ++j) {
        const PixelBox& other = texts[j].box;
        const bool apart = box.left >= other.Right() || other.left >= box.Right() ||
                           box.bottom >= other.Top() || other.bottom >= box.Top();
        EXPECT_TRUE(apart) << texts[i].text << " covers " << texts[j].text;
      }
    }
    if (std::string(key) == "h") Key("h");
  }
}

TEST_F(Desk, UnknownKeysDoNothing) {
  const auto before = window_->Grab();
  Key("x");
  Key("F5");
  const auto after = window_->Grab();
  ASSERT_TRUE(before.ok() && after.ok());
  EXPECT_EQ(before->rgb, after->rgb);
}

}  // namespace
}  // namespace telestrain::viz
