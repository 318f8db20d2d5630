#include "viz/review/part_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "review/review_content.h"

namespace telestrain::review_test {
namespace {

using Json = nlohmann::ordered_json;
using viz::Part;

// The opposite of Base64, written for this test.
std::string Decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char letter : text) {
    if (letter == '=') break;
    bits = (bits << 6 | static_cast<unsigned>(digits.find(letter))) & 0xffffffu;
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xffu);
  }
  return bytes;
}

template <typename Number>
std::vector<Number> NumbersOf(const Json& text) {
  const std::string bytes = Decoded(text.get<std::string>());
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

class SceneOfPage : public ::testing::Test {
 protected:
  const viz::Scene scene_ = MadeUpScene();
  const viz::PartList list_ = viz::PartsOf(scene_);
  const Json json_ = Json::parse(viz::SceneJson(scene_, list_).dump());

  const Json& QuantityJson(const std::string& key) const {
    for (const Json& quantity : json_["quantities"])
      if (quantity["key"] == key) return quantity;
    throw std::runtime_error("no quantity " + key);
  }
};

void ExpectSameMesh(const Part& part, const Json& json) {
  const auto points = NumbersOf<float>(json["points"]);
  ASSERT_EQ(points.size(), 3 * part.mesh.points_in_array_mm.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double exact = part.mesh.points_in_array_mm[i / 3][static_cast<Eigen::Index>(i % 3)];
    EXPECT_EQ(points[i], static_cast<float>(exact));
  }
  std::vector<std::uint32_t> faces, lines;
  for (const auto& face : part.mesh.faces) {
    faces.push_back(static_cast<std::uint32_t>(face.size()));
    faces.insert(faces.end(), face.begin(), face.end());
  }
  for (const auto& line : part.mesh.lines) lines.insert(lines.end(), line.begin(), line.end());
  EXPECT_EQ(NumbersOf<std::uint32_t>(json["faces"]), faces);
  EXPECT_EQ(NumbersOf<std::uint32_t>(json["lines"]), lines);
}

TEST_F(SceneOfPage, HoldsEveryPartAsItIs) {
  ASSERT_EQ(json_["parts"].size(), list_.parts.size());
  for (std::size_t i = 0; i < list_.parts.size(); ++i) {
    const Part& part = list_.parts[i];
    const Json& json = json_["parts"][i];
    SCOPED_TRACE(part.name);
    EXPECT_EQ(json["name"], part.name);
    EXPECT_EQ(json["layer"], viz::NameOf(part.layer));
    EXPECT_EQ(json["state"], part.state);
    ExpectSameMesh(part, json);
    ASSERT_EQ(json["values"].size(), part.values.size());
    for (std::size_t k = 0; k < part.values.size(); ++k) {
      EXPECT_EQ(json["values"][k]["quantity"], part.values[k].quantity.key);
      EXPECT_EQ(NumbersOf<float>(json["values"][k]["values"]).size(), part.values[k].values.size());
    }
    ASSERT_EQ(json["facts"].size(), part.facts.size());
    for (std::size_t k = 0; k < part.facts.size(); ++k)
      EXPECT_EQ(json["facts"][k], Json({part.facts[k].name, part.facts[k].value}));
  }
}

TEST_F(SceneOfPage, TheSurfacesQuantitiesComeFirst) {
  ASSERT_GE(json_["quantities"].size(), 2u);
  EXPECT_EQ(json_["quantities"][0]["key"], "axial_microstrain");
  EXPECT_EQ(json_["quantities"][0]["unit"], "\u00b5\u03b5");
}

TEST_F(SceneOfPage, AScaleOverAllStatesEndsAtTheLargestAndSmallestValue) {
  const Json& axial = QuantityJson("axial_microstrain");
  EXPECT_EQ(axial["scale"]["low"], kStrain_microstrain[0]);
  EXPECT_EQ(axial["scale"]["high"], kStrain_microstrain[1]);
  ASSERT_EQ(axial["state_scales"].size(), 2u);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_LT(axial["state_scales"][i]["low"], kStrain_microstrain[i]);
    EXPECT_GT(axial["state_scales"][i]["high"], kStrain_microstrain[i]);
  }
  EXPECT_EQ(axial["state_scales"][0]["ticks"].front(), axial["state_scales"][0]["low"]);
}

TEST_F(SceneOfPage, AValueThatIsMissingIsNoNumberAndNotInTheScale) {
  viz::PartList list = list_;
  for (Part& part : list.parts)
    for (viz::PointValues& values : part.values) values.values.front() = std::nan("");
  const Json json = viz::SceneJson(scene_, list);
  EXPECT_EQ(json["quantities"][0]["scale"], json_["quantities"][0]["scale"]);
  for (std::size_t i = 0; i < list.parts.size(); ++i)
    for (const Json& values : json["parts"][i]["values"])
      EXPECT_TRUE(std::isnan(NumbersOf<float>(values["values"]).front()));
}

TEST_F(SceneOfPage, StatesAreToldWithTheirStrainAndItsUncertainty) {
  ASSERT_EQ(json_["states"].size(), 2u);
  EXPECT_EQ(json_["first_state"], 1);
  const std::string text = json_["states"][1]["text"];
  EXPECT_EQ(text,
            "1  pipe/pipe_001.png, cycle 1, step 1: axial strain (200.00 \u00b1 0.50) "
            "\u00b5\u03b5, k = 2");
  viz::Scene unknown = scene_;
  unknown.pipe->states[0].standard_uncertainty_microstrain = 0;
  EXPECT_EQ(viz::SceneJson(unknown, list_)["states"][0]["text"],
            "0  pipe/pipe_000.png, cycle 1, step 0: axial strain 100.0 \u00b5\u03b5");
}

// A label stands on its view's axis, nearer to the camera than everything drawn of the view.
TEST_F(SceneOfPage, ViewsHaveTheirNames) {
  ASSERT_EQ(json_["labels"].size(), scene_.views.size());
  for (std::size_t i = 0; i < scene_.views.size(); ++i) {
    const Json& label = json_["labels"][i];
    EXPECT_EQ(label["text"], scene_.views[i].name);
    EXPECT_NEAR(label["at"][0], scene_.views[i].center_in_array_mm.x(), 1e-12);
    for (const Part& part : list_.parts) {
      if (part.name.find("view " + scene_.views[i].name) == std::string::npos) continue;
      for (const Eigen::Vector3d& point : part.mesh.points_in_array_mm)
        EXPECT_LT(point.z(), label["at"][2]) << part.name;
    }
  }
}

TEST_F(SceneOfPage, DirectionsAreRightAngles) {
  for (const Json& direction : json_["directions"]) {
    Eigen::Vector3d towards, up;
    for (const int i : {0, 1, 2}) {
      towards[i] = direction["towards_viewer"][static_cast<std::size_t>(i)];
      up[i] = direction["up"][static_cast<std::size_t>(i)];
    }
    EXPECT_NEAR(towards.norm(), 1, 1e-15) << direction["name"];
    EXPECT_LT(std::abs(towards.dot(up)), 0.5) << direction["name"];
  }
}

TEST_F(SceneOfPage, OnlyLayersWithPartsAreOffered) {
  for (const Json& layer : json_["layers"]) {
    const auto has = [&](const Part& part) { return viz::NameOf(part.layer) == layer["key"]; };
    EXPECT_TRUE(std::any_of(list_.parts.begin(), list_.parts.end(), has)) << layer;
  }
  EXPECT_EQ(viz::SceneJson({}, {})["layers"], Json::array());
}

}  // namespace
}  // namespace telestrain::review_test
