// Cells of a table that a spreadsheet opens.
#include "flank/sweep/table_text.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

TEST(CsvCell, TextThatASpreadsheetWouldRunIsText) {
  for (const std::string begin : {"=", "+", "-", "@", "\t", "\r"}) {
    SCOPED_TRACE(begin);
    for (const std::string rest : {"cmd|' /C calc'!A0", "1+1", "HYPERLINK(\"x\")", "", "5 mm", "1,2", "e5"}) {
      const std::string cell = csv_cell(begin + rest);
      EXPECT_TRUE(cell.starts_with("\"'" + begin)) << cell;
      EXPECT_TRUE(cell.ends_with("\"")) << cell;
    }
  }
}

TEST(CsvCell, NumbersStayNumbers) {
  for (const std::string number : {"-0.5", "+3", "-1e-9", "-12", "0.25", "7", "-.5"})
    EXPECT_EQ(csv_cell(number), number);
}

TEST(CsvCell, OtherTextIsAsItWas) {
  EXPECT_EQ(csv_cell("cylinder:radius=5"), "cylinder:radius=5");
  EXPECT_EQ(csv_cell(""), "");
  EXPECT_EQ(csv_cell("F1,F2"), "\"F1,F2\"");
  EXPECT_EQ(csv_cell("say \"so\""), "\"say \"\"so\"\"\"");
  EXPECT_EQ(csv_cell("two\nlines"), "\"two\nlines\"");
}

}  // namespace
}  // namespace flank::internal
