#include <gtest/gtest.h>

#include "tests/unit/session/malformed.h"

namespace telestrain {
namespace {

class MalformedViewTest : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedViewTest, NamesPlaceAndRemedy) { ExpectRefused(GetParam()); }

std::string NameOf(const testing::TestParamInfo<Malformed>& info) { return info.param.name; }

const std::string kToml = "session.toml";

// View B1 of the sample from its group to its axis, and the same with other lines; A1 looks 30
// degrees off the array's z.
const std::string kB1 =
    "group = \"B\"\nregion_px = [1296, 0, 1296, 972]\nimage_x_in_array = [1, 0, 0]\n"
    "image_y_in_array = [0.0, 0.866, 0.5]\naxis_in_array    = [0.0, -0.5, 0.866]";

std::string B1InGroupA(const std::string& image_y, const std::string& axis) {
  return "group = \"A\"\nregion_px = [1296, 0, 1296, 972]\nimage_x_in_array = [1, 0, 0]\n" +
         ("image_y_in_array = " + image_y) + "\naxis_in_array = " + axis;
}

INSTANTIATE_TEST_SUITE_P(
    ViewsOfOneGroup, MalformedViewTest,
    testing::Values(Malformed{"Parallel",
                              kToml,
                              kB1,
                              B1InGroupA("[0.0, 0.866, -0.5]", "[0.0, 0.5, 0.866]"),
                              "[[view]]\nname = \"B1\"",
                              {"'A1' and 'B1' of group 'A'", "0.00 deg apart", "at least 5",
                               "correct axis_in_array"}},
                    Malformed{"Antiparallel",
                              kToml,
                              kB1,
                              B1InGroupA("[0.0, 0.866, -0.5]", "[0.0, -0.5, -0.866]"),
                              "[[view]]\nname = \"B1\"",
                              {"'A1' and 'B1' of group 'A'", "0.00 deg apart"}},
                    Malformed{"FourDegreesApart",
                              kToml,
                              kB1,
                              B1InGroupA("[0.0, 0.8290, -0.5592]", "[0.0, 0.5592, 0.8290]"),
                              "[[view]]\nname = \"B1\"",
                              {"4.00 deg apart", "give it another group"}}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    Names, MalformedViewTest,
    testing::Values(Malformed{"NameWithBlank",
                              kToml,
                              "name = \"B1\"",
                              "name = \"B 1\"",
                              "B 1",
                              {"the view name 'B 1' holds white space or '#'", "rename the view"}},
                    Malformed{"NameWithTab",
                              kToml,
                              "name = \"B1\"",
                              "name = \"B1\\t\"",
                              "name = \"B1",
                              {"without control characters"}},
                    Malformed{"NameWithHash",
                              kToml,
                              "name = \"B1\"",
                              "name = \"B#1\"",
                              "B#1",
                              {"the view name 'B#1' holds", "rename the view"}}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    Stage, MalformedViewTest,
    testing::Values(Malformed{"StageAcross",
                              kToml,
                              "[0.0, 0.0, -1.0]",
                              "[1.0, 0.0, 0.0]",
                              "[1.0, 0.0, 0.0]\nsigma",
                              {"stage.axis_in_array is 90.0 deg away from the array's z",
                               "the limit is 60", "along the target's normal", "turn the stage"}},
                    Malformed{"StageTooOblique",
                              kToml,
                              "[0.0, 0.0, -1.0]",
                              "[0.0, 0.8829, -0.4695]",
                              "0.8829",
                              {"is 62.0 deg away"}},
                    Malformed{"StageTooLong",
                              kToml,
                              "[0.0, 0.0, -1.0]",
                              "[0.0, 0.0, -1.03]",
                              "-1.03",
                              {"stage.axis_in_array has the length 1.0300", "within 2 %"}}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    Views, MalformedViewTest,
    testing::Values(
        Malformed{"RegionOutside",
                  kToml,
                  "[1296, 0, 1296, 972]",
                  "[1297, 0, 1296, 972]",
                  "1297",
                  {"[1297, 0, 1296, 972]", "sensor of 2592 x 1944", "correct the region"}},
        Malformed{"RegionOfNoWidth",
                  kToml,
                  "[1296, 0, 1296, 972]",
                  "[1296, 0, 0, 972]",
                  ", 0, 0,",
                  {"[1296, 0, 0, 972]", "inside the sensor"}},
        Malformed{"RegionOfThree",
                  kToml,
                  "[1296, 0, 1296, 972]",
                  "[1296, 0, 1296]",
                  "1296, 0, 12",
                  {"an array of 3 values", "[x, y, width, height]"}},
        Malformed{"NegativeRegion",
                  kToml,
                  "[1296, 0, 1296, 972]",
                  "[1296, -1, 1296, 972]",
                  "-1, 12",
                  {"region_px[2] is -1", "a whole number from 0"}},
        Malformed{"DuplicateName",
                  kToml,
                  "name = \"B1\"",
                  "name = \"A1\" # again",
                  "# again",
                  {"'A1' is used twice", "its own name"}},
        Malformed{"OverlappingRegions",
                  kToml,
                  "[1296, 0, 1296, 972]",
                  "[1295, 0, 1296, 972]",
                  "1295",
                  {"'B1' overlaps that of view 'A1'", "correct region_px"}},
        Malformed{"GroupWithoutBoard",
                  kToml,
                  "group = \"B\"\nregion",
                  "group = \"b\"\nregion",
                  "\"b\"",
                  {"group 'b' of view 'B1' has no board", "add a [[target.board]]"}},
        Malformed{"TwoBoardsOfAGroup",
                  kToml,
                  "group = \"B\"\ncenter",
                  "group = \"A\"\ncenter",
                  "[[target.board]]\ngroup = \"A\"\ncenter_in_target_mm = [13",
                  {"group 'A' has two boards", "one board per group"}},
        Malformed{"VectorTooLong",
                  kToml,
                  "[-1.0, 0.0, 0.0]",
                  "[-1.03, 0.0, 0.0]",
                  "-1.03",
                  {"length 1.0300", "wanted 1 within 2 %", "divide the vector by its length"}},
        Malformed{"VectorOfTwo",
                  kToml,
                  "[-1.0, 0.0, 0.0]",
                  "[-1.0, 0.0]",
                  "[-1.0, 0.0]",
                  {"view[1].image_x_in_array is an array of 2 values", "a unit vector"}},
        Malformed{"AxesNotOrthogonal",
                  kToml,
                  "[-1.0, 0.0, 0.0]",
                  "[-0.9986, 0.0523, 0.0]",
                  "[[view]]",
                  {"enclose 87.40 deg", "wanted 90 within 2"}},
        Malformed{"AxisNotParallel",
                  kToml,
                  "[0.0, 0.5, 0.866]",
                  "[0.0, 0.559, 0.829]",
                  "[[view]]",
                  {"the axis of view[1]", "(either sign)", "the limit is 2"}},
        Malformed{"StageAxisNotUnit",
                  kToml,
                  "[0.0, 0.0, -1.0]",
                  "[0.0, 0.0, 0.0]",
                  "0.0, 0.0, 0.0]\nsigma",
                  {"stage.axis_in_array has the length 0.0000"}},
        Malformed{"MirrorsWithoutCamera",
                  kToml,
                  "group = \"B\"\nregion",
                  "mirrors = [{ point_mm = [0, 0, 1], normal = [0, 0, 1] }]\ngroup = \"B\"\nregion",
                  "mirrors",
                  {"view 'B1' is given by mirrors", "add [camera] with position_mm"}}),
    NameOf);

}  // namespace
}  // namespace telestrain
