#include "base/csv.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace telestrain {
namespace {

CsvTable Parsed(const std::string& text) {
  const auto table = ParseCsv("t.csv", text);
  if (!table) throw std::runtime_error(table.error().message);
  return *table;
}

std::string MessageOf(const std::string& text) {
  const auto table = ParseCsv("t.csv", text);
  EXPECT_FALSE(table.ok()) << text;
  return table ? "" : table.error().message;
}

TEST(CsvTest, WhatIsWrittenReadsBack) {
  // Cells of awkward characters; line breaks cannot stand in a cell.
  const std::vector<std::string> letters = {"a", "b", " ", "\t", ",", "\"", "#", "'", ".", "ä"};
  std::mt19937 random(7);
  for (int round = 0; round < 500; ++round) {
    std::vector<std::string> cells(1 + random() % 4);
    for (auto& cell : cells)
      for (auto length = random() % 5; length > 0; --length)
        cell += letters[random() % letters.size()];
    std::vector<std::string> header;
    for (std::size_t i = 0; i < cells.size(); ++i)
      header.push_back(std::string("c").append(std::to_string(i)));
    const CsvTable table = Parsed(CsvLine(header) + CsvLine(cells));
    ASSERT_EQ(table.rows.size(), 1u) << CsvLine(cells);
    EXPECT_EQ(table.rows[0].cells, cells) << CsvLine(cells);
  }
}

TEST(CsvTest, SkipsCommentsAndEmptyLinesButCountsThem) {
  const CsvTable table = Parsed("# comment\n\n a , b \r\n# more\n 1 ,\t2\n\n3,\n");
  EXPECT_EQ(table.header_line, 3);
  EXPECT_EQ(table.columns, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].line, 5);
  EXPECT_EQ(table.rows[0].cells, (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(table.rows[1].line, 7);
  EXPECT_EQ(table.rows[1].cells, (std::vector<std::string>{"3", ""}));
}

TEST(CsvTest, QuotesProtectCommasAndQuotes) {
  const CsvTable table = Parsed("a,b\n\"x, y\" , \"say \"\"yes\"\"\"\n");
  EXPECT_EQ(table.rows[0].cells, (std::vector<std::string>{"x, y", "say \"yes\""}));
}

TEST(CsvTest, RefusesControlCharactersByTheirByte) {
  EXPECT_EQ(
      MessageOf("a,b\n1,2\x1b[31m\n"),
      "t.csv:2: byte 4 of the line is the control character \\x1b; remove it, or save the file "
      "as UTF-8");
}

TEST(CsvTest, RefusesEndlessHeaders) {
  std::string header = "c0";
  for (std::size_t i = 1; i < kMostColumns; ++i) header += ",c" + std::to_string(i);
  EXPECT_EQ(Parsed(header + "\n").columns.size(), kMostColumns);
  EXPECT_NE(MessageOf(header + ",more\n").find("has 257 columns, the limit is 256"),
            std::string::npos);
}

TEST(CsvTest, IgnoresAByteOrderMarkAndFindsColumns) {
  const CsvTable table = Parsed("\xEF\xBB\xBFimage,pose\n");
  EXPECT_EQ(table.Find("image"), 0);
  EXPECT_EQ(table.Find("pose"), 1);
  EXPECT_EQ(table.Find("stage"), -1);
  EXPECT_TRUE(table.rows.empty());
}

TEST(CsvTest, ErrorsNameTheLine) {
  EXPECT_NE(MessageOf("").find("t.csv: is empty; it needs a header line"), std::string::npos);
  EXPECT_NE(MessageOf("# only\n").find("is empty"), std::string::npos);
  EXPECT_EQ(MessageOf("a,b\n1,2,3\n").find("t.csv:2: 3 cells, the header has 2"), 0u);
  EXPECT_EQ(MessageOf("a,\n").find("t.csv:1: a column has no name"), 0u);
  EXPECT_EQ(MessageOf("a,a\n").find("t.csv:1: column 'a' appears twice"), 0u);
  for (const char* row : {"\"open", "\"a\"b", "a\"b\"", "\"a\"\"", "\"a\" \"b\""})
    EXPECT_EQ(MessageOf(std::string("a\n1\n") + row + "\n").find("t.csv:3: a cell with a double"),
              0u)
        << row;
}

TEST(CsvTest, OtherEncodingsAreRefusedWithLineAndColumn) {
  const std::string remedy = " holds bytes that are not UTF-8; save the file as UTF-8";
  EXPECT_EQ(MessageOf("a,b\n1,ä\n1,\xE4\n"), "t.csv:3: column 'b'" + remedy);
  EXPECT_EQ(MessageOf("a,b\n\"R\xF6hre, 1\",2\n"), "t.csv:2: column 'a'" + remedy);
  EXPECT_EQ(MessageOf("a,\xB5m\n"), "t.csv:1: column 2" + remedy);
  EXPECT_EQ(MessageOf("a,b\n1,2,\xB5m\n"), "t.csv:2: column 3" + remedy);
  EXPECT_EQ(MessageOf("# \xB5m\na\n"), "t.csv:1: the line" + remedy);
  EXPECT_EQ(MessageOf("a\n\"\xB5\n"), "t.csv:2: the line" + remedy);
  EXPECT_EQ(MessageOf("\xFF\xFE" + std::string("a\0\n\0", 4)), "t.csv:1: column 1" + remedy);
}

TEST(CsvTest, MissingFileIsBadInput) {
  const auto table = ReadCsv(testing::TempDir() + "there/is/none.csv");
  ASSERT_FALSE(table.ok());
  EXPECT_EQ(table.error().kind, ErrorKind::kBadInput);
}

}  // namespace
}  // namespace telestrain
