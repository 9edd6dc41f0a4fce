#include "base/csv.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray {
namespace {

using fakes::expect_fault;

TEST(Csv, ReadsNumbersWordsAndWindowsLineEnds) {
    const fakes::TemporaryFolder folder;
    const CsvTable table =
        CsvTable::read(folder.write("t.csv", "a, b ,c\r\n1,-2.5e3,True\r\n\r\n9007199254740993,0,0\r\n"));
    ASSERT_EQ(table.row_count(), 2u);
    EXPECT_EQ(table.number(0, table.column("b")), -2500.0);
    EXPECT_TRUE(table.boolean(0, table.column("c")));
    EXPECT_EQ(table.integer(1, table.column("a")), 9007199254740993);
    EXPECT_FALSE(table.has_column("d"));
}

TEST(Csv, SaysWhereARowIsWrong) {
    const fakes::TemporaryFolder folder;
    expect_fault([&] { CsvTable::read(folder.path() / "none.csv"); }, ExitCode::BadInput, "none.csv");
    expect_fault([&] { CsvTable::read(folder.write("e.csv", "")); }, ExitCode::BadInput, "empty");
    expect_fault([&] { CsvTable::read(folder.write("s.csv", "a,b\n1,2\n3\n")); }, ExitCode::BadInput,
                 "s.csv:3");
    const CsvTable table = CsvTable::read(folder.write("v.csv", "a,b\n1,nan\nx,2\n"));
    expect_fault([&] { table.number(0, 1); }, ExitCode::BadInput, "v.csv:2");
    expect_fault([&] { table.number(1, 0); }, ExitCode::BadInput, "v.csv:3");
    expect_fault([&] { table.integer(1, 0); }, ExitCode::BadInput, "whole number");
    expect_fault([&] { table.boolean(1, 1); }, ExitCode::BadInput, "not 0 or 1");
    expect_fault([&] { table.column("z"); }, ExitCode::BadInput, "no column 'z'");
}

}  // namespace
}  // namespace foveray
