#include "azulejo/io/csv.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

CsvTable parse(std::string_view text, const CsvOptions& options = {}) { return parse_csv(text, "a.csv", options); }

std::string message_of(std::string_view text, const CsvOptions& options = {}, const Run& run = {}) {
  try {
    parse_csv(text, "a.csv", options, run);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

using Numbers = std::vector<double>;
using Texts = std::vector<std::string>;

Texts names_of(const CsvTable& table) {
  Texts names;
  for (const CsvColumn& column : table.columns) names.push_back(column.name);
  return names;
}

TEST(Csv, ReadsNamedColumnsOfNumbersAndTexts) {
  const CsvTable table = parse("city,people,area\nLisboa,544851,100.05\nPorto,231962,41.42\n");
  EXPECT_EQ(table.rows, 2U);
  EXPECT_EQ(names_of(table), (Texts{"city", "people", "area"}));
  EXPECT_EQ(table.columns[0].texts, (Texts{"Lisboa", "Porto"}));
  EXPECT_TRUE(std::isnan(table.columns[0].numbers[0]));
  EXPECT_EQ(table.columns[1].numbers, (Numbers{544851, 231962}));
  EXPECT_EQ(table.columns[2].numbers, (Numbers{100.05, 41.42}));
  EXPECT_FALSE(table.columns[2].is_text());
}

TEST(Csv, TakesNumbersAsProgramsWriteThem) {
  const double infinity = std::numeric_limits<double>::infinity();
  const CsvTable table =
      parse("1\n-.5\n+2e-3\n4.\ninf\n-Infinity\n1e999\n-1e999\n1e-999\n0.1\n1e-99999999999999999999\n");
  EXPECT_EQ(table.columns[0].numbers, (Numbers{1, -0.5, 2e-3, 4, infinity, -infinity, infinity, -infinity, 0, 0.1, 0}));
  const CsvTable zeros = parse("0." + std::string(400, '0') + "1\n" + std::string(400, '1') + ".5\n-0." +
                               std::string(350, '0') + "1e10\n");
  EXPECT_EQ(zeros.columns[0].numbers, (Numbers{0, infinity, 0}));
  for (const char* const text : {"0x10", "1,2,", "1e", "+-1", "--1", "1 2", "12%", "."}) {
    EXPECT_TRUE(parse(text, {.separator = ';', .header = false}).columns[0].is_text()) << text;
  }
}

TEST(Csv, WhatIsMissingIsNaNAndMakesNoText) {
  const CsvTable table = parse("a;b\n1;\nNaN;2\nNA;n/a\n NULL ;3\n");
  EXPECT_FALSE(table.columns[0].is_text());
  EXPECT_EQ(table.columns[0].numbers[0], 1);
  for (std::size_t row = 1; row < 4; ++row) EXPECT_TRUE(std::isnan(table.columns[0].numbers[row])) << row;
  EXPECT_TRUE(std::isnan(table.columns[1].numbers[0]));
  EXPECT_EQ(table.columns[1].numbers[3], 3);
}

TEST(Csv, FindsTheSeparator) {
  const Numbers expected{1.5, 3.5};
  for (const char* const text :
       {"1.5,2\n3.5,4", "1.5;2\n3.5;4", "1.5\t2\n3.5\t4", "1.5 2\n3.5   4", "  1.5 \t2 \n3.5 4\n", "1,5;2\n3,5;4",
        "1,5\t2\n3,5\t4", "sep=;\n1.5;2\n3.5;4\n", "1.5 , 2\n 3.5, 4"}) {
    const CsvTable table = parse(text);
    ASSERT_EQ(table.columns.size(), 2U) << text;
    EXPECT_EQ(table.columns[0].numbers, expected) << text;
    EXPECT_EQ(table.columns[1].numbers, (Numbers{2, 4})) << text;
  }
  EXPECT_EQ(parse("a b\nc d\n", {.separator = ','}).columns[0].name, "a b");
  EXPECT_EQ(parse("a, b;u\nc;2\n").columns[0].name, "a, b");  // only ; cuts both alike
  EXPECT_EQ(parse("7\n8\n").columns[0].numbers, (Numbers{7, 8}));
}

TEST(Csv, FindsTheHeader) {
  EXPECT_EQ(names_of(parse("x,y\n1,2")), (Texts{"x", "y"}));
  EXPECT_EQ(names_of(parse("1,2\n3,4")), (Texts{"1", "2"}));
  EXPECT_EQ(names_of(parse("anna,1\nben,2")), (Texts{"1", "2"}));         // no row of names has numbers,
  EXPECT_EQ(names_of(parse("year,2020\n1,2")), (Texts{"year", "2020"}));  // unless only it has a word in a column
  EXPECT_EQ(names_of(parse("x,\n1,2")), (Texts{"x", "2"}));
  EXPECT_EQ(names_of(parse("1,2\n3,4", {.header = true})), (Texts{"1", "2"}));
  EXPECT_EQ(parse("1,2\n3,4", {.header = true}).rows, 1U);
  EXPECT_EQ(parse("x,y\n1,2", {.header = false}).rows, 2U);
  EXPECT_EQ(parse("x,y").rows, 0U);
  EXPECT_EQ(parse(",\n1,2").rows, 2U);
}

TEST(Csv, QuotesKeepSeparatorsLineEndsAndQuotes) {
  const CsvTable table = parse("name,n\n\"a, \"\"b\"\"\",\"1\"\n \"two\r\nlines\" ,2\n\"\",3\nb\"c,4\n");
  EXPECT_EQ(table.columns[0].texts, (Texts{"a, \"b\"", "two\r\nlines", "", "b\"c"}));
  EXPECT_EQ(table.columns[1].numbers, (Numbers{1, 2, 3, 4}));
  EXPECT_EQ(parse("\"a b\" 1\n\"c\"\t2\n").columns[0].texts, (Texts{"a b", "c"}));
}

TEST(Csv, LinesEndAsTheyLikeAndEmptyOnesAndCommentsAreLeftOut) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const CsvTable table =
        parse("# made by hand" + end + end + "a,b" + end + " \t " + end + "1,2" + end + "#" + end + "3,4" + end + end);
    EXPECT_EQ(names_of(table), (Texts{"a", "b"}));
    EXPECT_EQ(table.columns[1].numbers, (Numbers{2, 4}));
  }
  EXPECT_EQ(parse("\t1\t\n\t2\t\n", {.separator = '\t'}).columns.size(), 3U);  // an empty cell isn't an empty line
}

TEST(Csv, ReadsFilesOfAnyEncoding) {
  const std::string path = testing::TempDir() + "/azulejo-csv.csv";
  const auto first_name = [&](std::string_view bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    return read_csv(path).columns[0].name;
  };
  EXPECT_EQ(first_name("\xEF\xBB\xBFpé,b\n1,2\n"), "pé");
  EXPECT_EQ(first_name("p\xE9,b\n1,2\n"), "pé");
  EXPECT_EQ(first_name(std::string_view("\xFF\xFEp\0\xE9\0,\0b\0\n\0001\0,\0002\0\n\0", 18)), "pé");
  std::remove(path.c_str());
  EXPECT_THROW(read_csv(path), Error);
}

TEST(Csv, ColumnsAreFoundByNameAndByNumber) {
  const CsvTable table = parse("height,2,width\n1,2,3");
  EXPECT_EQ(&table.column("width", "x"), &table.columns[2]);
  EXPECT_EQ(&table.column("3", "x"), &table.columns[2]);
  EXPECT_EQ(&table.column("2", "x"), &table.columns[1]);
  for (const char* const which : {"0", "4", "", "-1", "1.0", "99999999999999999999999"}) {
    EXPECT_THROW(table.column(which, "x"), Error) << which;
  }
  try {
    table.column("heigth", "x");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "x: \"heigth\" (did you mean height?), expected a column of a.csv: height, 2, width, or "
                 "a number from 1 to 3");
  }
}

TEST(Csv, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(message_of("a,b\n1,2\n\n3\n"), "a.csv: line 4: 1 cells, expected 2 as in the first row");
  EXPECT_EQ(message_of("a,b\n\"x\ny\",2\n3,4,5\n"), "a.csv: line 4: 3 cells, expected 2 as in the first row");
  EXPECT_EQ(message_of("a,b\n1,\"2\n"), "a.csv: line 2: a quote that isn't closed, expected \"");
  EXPECT_EQ(message_of("a,b\n\"1\"x,2\n"), "a.csv: line 2: \"x,2\" behind a closed quote, expected a separator");
  EXPECT_EQ(message_of(std::string_view("a,b\n1\0,2\n", 9)), "a.csv: line 2: a byte 0, expected text");
  EXPECT_EQ(message_of(""), "a.csv: no rows, expected a table");
  EXPECT_EQ(message_of("\n# no\n \n"), "a.csv: no rows, expected a table");
  EXPECT_EQ(message_of("a", {.separator = 'x'}), "separator: \"x\", expected a comma, a semicolon, a tab or a blank");
  azulejo::Run run;
  run.limits.memory_bytes = 100'000;
  EXPECT_NE(message_of(std::string(500, ','), {}, run), "");
  EXPECT_NE(message_of(
                [] {
                  std::string rows;
                  for (int i = 0; i < 20'000; ++i) rows += "1\n";
                  return rows;
                }(),
                {}, run),
            "");
}

/// Any bytes give a table whose columns are full, or an Error.
TEST(Csv, AnyBytesGiveATableOrAnError) {
  constexpr std::string_view kBytes = "1a.,;\t \"\"\n\r#-e\xE9\0=";
  for (unsigned seed = 0; seed < 3000; ++seed) {
    std::mt19937 random(seed);
    std::string text(random() % 60, ' ');
    for (char& c : text) c = kBytes[random() % kBytes.size()];
    SCOPED_TRACE(seed);
    try {
      const CsvTable table = parse(text);
      ASSERT_FALSE(table.columns.empty());
      for (const CsvColumn& column : table.columns) {
        ASSERT_EQ(column.numbers.size(), table.rows);
        ASSERT_TRUE(column.texts.empty() || column.texts.size() == table.rows);
        ASSERT_FALSE(column.name.empty());
      }
    } catch (const Error& error) {
      ASSERT_EQ(error.kind(), Error::Data);
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace azulejo
