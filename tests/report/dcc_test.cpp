#include <algorithm>

#include "dcc_fixture.h"

namespace telestrain {
namespace {

TEST_F(Dcc, IsValid) {
  NEEDS_SCHEMA();
  ExpectValid(Make());
}

TEST_F(Dcc, IsValidWithoutRulerAndStrain) {
  NEEDS_SCHEMA();
  fixture_.ruler = nullptr;
  fixture_.strain = nullptr;
  const std::string xml = Make();
  ExpectValid(xml);
  EXPECT_EQ(TextsAt(xml, "//dcc:measurementResult/dcc:name"),
            std::vector<std::string>{"Calibration of the camera array"});
  EXPECT_TRUE(TextsAt(xml, "//*[contains(@refType, 'ruler')]").empty());
}

TEST_F(Dcc, IsValidWhereNothingWasMeasured) {
  NEEDS_SCHEMA();
  fixture_.detection = fixture_.calibration = fixture_.diagnosis = nullptr;
  fixture_.ruler = fixture_.strain = nullptr;
  const std::string xml = Make();
  ExpectValid(xml);
  EXPECT_EQ(TextsAt(xml, "//dcc:measurementResult//dcc:text"),
            std::vector<std::string>{"Nothing was measured."});
}

TEST_F(Dcc, SaysWhatTheSessionDoesNotState) {
  fixture_.inputs["document"] = Json::object();
  const std::string xml = Make();
  for (const char* xpath : {"//dcc:calibrationLaboratory//dcc:name", "//dcc:customer/dcc:name",
                            "//dcc:respPerson//dcc:name", "//dcc:influenceCondition/dcc:data",
                            "//dcc:statement[dcc:name/dcc:content='Traceability']/dcc:declaration"})
    EXPECT_EQ(TextsAt(xml, xpath), std::vector<std::string>{"not stated"}) << xpath;
  EXPECT_EQ(TextsAt(xml, "//dcc:countryCodeISO3166_1"), std::vector<std::string>{"ZZ"});
  EXPECT_EQ(TextsAt(xml, "//dcc:beginPerformanceDate"), std::vector<std::string>{"0001-01-01"});
  EXPECT_TRUE(TextsAt(xml, "//dcc:issueDate").empty());
  EXPECT_NE(xml.find("The date of the calibration is not stated"), std::string::npos);
  EXPECT_TRUE(TextsAt(xml, "//dcc:uniqueIdentifier").at(0).starts_with("sha256:"));
  NEEDS_SCHEMA();
  ExpectValid(xml);
}

TEST_F(Dcc, TakesNoDateThatIsNone) {
  for (const char* date : {"January 2026", "2026-02-30", "2026-13-01", "2026-1-1", ""}) {
    fixture_.inputs["document"]["date"] = date;
    EXPECT_EQ(TextsAt(Make(), "//dcc:endPerformanceDate"), std::vector<std::string>{"0001-01-01"})
        << date;
  }
  fixture_.inputs["document"]["date"] = "2026-02-28T10:00:00Z";
  EXPECT_EQ(TextsAt(Make(), "//dcc:issueDate"), std::vector<std::string>{"2026-02-28"});
}

TEST_F(Dcc, HoldsTheFactsOfTheDocument) {
  const std::string xml = Make();
  const auto expect = [&](const char* xpath, const std::string& text) {
    const auto found = TextsAt(xml, xpath);
    EXPECT_NE(std::find(found.begin(), found.end(), text), found.end()) << xpath << ": " << text;
  };
  expect("//dcc:uniqueIdentifier", "AR-2026-0042 revision 1");
  expect("//dcc:beginPerformanceDate", "2026-01-31");
  expect("//dcc:calibrationLaboratory//dcc:name", "Metrology laboratory, Prüfzentrum Süd");
  expect("//dcc:customer/dcc:name", "Müller Rohrwerke GmbH, Köln");
  expect("//dcc:respPerson//dcc:name", "张伟 (Zhang Wei), Søren Łukasz, Ελένη Παππά");
  expect("//dcc:subItems/dcc:item[1]//dcc:identification/dcc:value", "40211");
  expect("//dcc:subItems/dcc:item[2]//dcc:identification/dcc:value", "0998");
  expect("//dcc:dccSoftware/dcc:software/dcc:release", "0.1.0");
  expect("//dcc:usedMethod/dcc:norm", "VDI/VDE 2634 Part 1");
  expect("//dcc:statement/dcc:declaration", Printed(results_["decision"]["printed"]));
  expect("//dcc:measuringEquipment[@id='ruler']//si:value", "27.6");
  expect("//dcc:measuringEquipment[@id='ruler']//si:value", "0.25");
}

TEST_F(Dcc, KeepsEveryFactOfTheDocument) {
  fixture_.inputs["document"]["order_of_the_customer"] = "PO 7 & 8";
  const std::string xml = Make();
  EXPECT_EQ(TextsAt(xml,
                    "//dcc:statement[dcc:name/dcc:content='Order of the customer']"
                    "/dcc:declaration/dcc:content"),
            std::vector<std::string>{"PO 7 & 8"});
}

// Nobody said in which language the session is.
TEST_F(Dcc, TextsOfTheSessionHaveNoLanguage) {
  fixture_.inputs["document"]["condition"] = "ohne Schäden";
  const std::string xml = Make();
  for (const char* given : {"//dcc:customer/dcc:name", "//dcc:respPerson//dcc:name",
                            "//dcc:item[@id='specimen']/dcc:description",
                            "//dcc:statement[dcc:name/dcc:content='Traceability']/dcc:declaration",
                            "//dcc:influenceCondition//dcc:text"}) {
    EXPECT_FALSE(TextsAt(xml, std::string(given) + "/dcc:content").empty()) << given;
    EXPECT_TRUE(TextsAt(xml, std::string(given) + "/dcc:content/@lang").empty()) << given;
  }
  EXPECT_EQ(TextsAt(xml, "//dcc:influenceCondition/dcc:name/dcc:content/@lang").at(0), "en");
}

TEST_F(Dcc, EscapesAndCleansTexts) {
  Json& document = fixture_.inputs["document"];
  document["customer"] = "A<b>&\"c\" 'd' ]]> \t\n  e";
  document["operator"] = std::string("张\x01\x7F伟\xEF\xBF\xBE \xF0\x9F\x94\xA7");
  document["laboratory"] = "\n \x02 ";
  document["number"] = "  AR 1\n";
  fixture_.ruler["images"][0]["image"] = "ruler/position one <1>.png";
  const std::string xml = Make();
  EXPECT_EQ(TextsAt(xml, "//dcc:customer/dcc:name").at(0), "A<b>&\"c\" 'd' ]]> e");
  EXPECT_EQ(TextsAt(xml, "//dcc:respPerson//dcc:name").at(0), "张伟 \xF0\x9F\x94\xA7");
  EXPECT_EQ(TextsAt(xml, "//dcc:calibrationLaboratory//dcc:name").at(0), "not stated");
  EXPECT_EQ(TextsAt(xml, "//dcc:uniqueIdentifier").at(0), "AR 1 revision 1");
  // Blanks separate the entries of a list; within one they do not break it.
  EXPECT_NE(QuantityOf(ReadQuantities(xml), "telestrain_ruler_Image")
                .text.find("ruler/position\u00A0one\u00A0<1>.png ruler/position_01.png"),
            std::string::npos);
  NEEDS_SCHEMA();
  ExpectValid(xml);
}

TEST_F(Dcc, IllFormedTextsBecomeReadableOnes) {
  Make();
  results_["document"]["customer"] = "M\xFCller";  // Latin-1
  results_["document"].erase("number");
  const auto xml = MakeDcc(results_, nullptr);
  ASSERT_TRUE(xml) << xml.error().message;
  EXPECT_EQ(TextsAt(*xml, "//dcc:customer/dcc:name").at(0), "M\uFFFDller");
}

TEST_F(Dcc, TheSameResultsGiveTheSameBytes) {
  const std::string first = Make();
  EXPECT_EQ(Make(), first);
  // What is read back from the folder says the same as what MakeResults had in memory.
  const auto again = MakeDcc(results_, fixture_.calibration);
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, first);
}

TEST_F(Dcc, ACoverageFactorBelowOneIsSaidInWords) {
  fixture_.inputs["acceptance"]["coverage_factor"] = 0.5;
  const std::string xml = Make();
  const ReadQuantity read = QuantityOf(ReadQuantities(xml), "telestrain_ruler_error");
  EXPECT_TRUE(read.uncertainties.empty());
  EXPECT_NE(xml.find("(k = 0.5)"), std::string::npos);
  NEEDS_SCHEMA();
  ExpectValid(xml);
}

TEST_F(Dcc, ABrokenCertificateIsRefusedWithItsLine) {
  NEEDS_SCHEMA();
  std::string xml = Make();
  const std::string wanted = "<dcc:performanceLocation>other</dcc:performanceLocation>";
  const std::size_t at = xml.find(wanted);
  ASSERT_NE(at, std::string::npos);
  const auto line = 1 + std::count(xml.begin(), xml.begin() + static_cast<long>(at), '\n');
  xml.replace(at, wanted.size(), "<dcc:performanceLocation>moon</dcc:performanceLocation>");
  const Status status = ValidateDcc("broken.xml", xml, SchemaFolder());
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::kBadInput);
  const std::string start = "broken.xml: line " + std::to_string(line) + ": ";
  EXPECT_TRUE(status.error().message.starts_with(start)) << status.error().message;
  EXPECT_NE(status.error().message.find("performanceLocation"), std::string::npos);
}

TEST_F(Dcc, WhatIsNoXmlIsRefused) {
  NEEDS_SCHEMA();
  const Status status = ValidateDcc("cut.xml", Make().substr(0, 500), SchemaFolder());
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::kBadInput);
  EXPECT_NE(status.error().message.find("not XML"), std::string::npos) << status.error().message;
}

TEST(ValidateDcc, AFolderWithoutTheSchemaIsNamed) {
  const Status status = ValidateDcc("dcc.xml", "<a/>", "no/such/folder");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::kBadInput);
  EXPECT_NE(status.error().message.find("no/such/folder/dcc.xsd"), std::string::npos);
}

}  // namespace
}  // namespace telestrain
