#include "core/column_file.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <utility>

#include "core/column.h"
#include "core/error.h"
#include "support/temporary_folder.h"

namespace clsurf::column_file_test {
namespace {

/// Bytes of mapped files without a name in a folder.
std::size_t mapped_in(const std::string& folder) {
    std::ifstream maps("/proc/self/maps");
    std::string line;
    std::size_t bytes = 0;
    while (std::getline(maps, line)) {
        if (line.find(folder) == std::string::npos || line.find("(deleted)") == std::string::npos) continue;
        const std::size_t dash = line.find('-');
        bytes += std::stoull(line.substr(dash + 1), nullptr, 16) - std::stoull(line.substr(0, dash), nullptr, 16);
    }
    return bytes;
}

class ColumnFile : public testing::Test {
protected:
    void TearDown() override { keep_columns_in(""); }
    test::TemporaryFolder folder_;
    std::string path_ = folder_ / "";
};

TEST_F(ColumnFile, LargeColumnsAreInFilesAndKeepTheirValues) {
    constexpr std::size_t least = 1 << 20, count = 1'000'000;
    keep_columns_in(path_, least);
    Column<std::int32_t> column;
    for (std::size_t i = 0; i < count; ++i) {
        column.push_back(static_cast<std::int32_t>(3 * i));
        if (i == 1000) { EXPECT_EQ(mapped_in(path_), 0U) << "a small one is in memory"; }
    }
    EXPECT_GE(mapped_in(path_), count * sizeof(std::int32_t));
    for (std::size_t i = 0; i < count; i += 999) ASSERT_EQ(column[i], static_cast<std::int32_t>(3 * i));

    Column<std::int32_t> copy = column;
    copy[7] = -1;
    EXPECT_EQ(column[7], 21);
    const Column<std::int32_t> moved = std::move(copy);
    EXPECT_EQ(moved[7], -1);
    column = Column<std::int32_t>();
    EXPECT_EQ(moved[count - 1], static_cast<std::int32_t>(3 * (count - 1)));
    EXPECT_GE(mapped_in(path_), count * sizeof(std::int32_t));
}

TEST_F(ColumnFile, TakeNoRoomWhenTheyAreGone) {
    keep_columns_in(path_, 1 << 20);
    { const Column<double> column(std::size_t{1} << 20, 1.5); }
    EXPECT_EQ(mapped_in(path_), 0U);
}

TEST_F(ColumnFile, AFolderThatIsNotThereIsAnError) {
    EXPECT_THROW(keep_columns_in(path_ + "nowhere"), SystemError);
    const Column<double> column(std::size_t{10} << 20, 1.5);
    EXPECT_EQ(column[5], 1.5) << "columns are in memory then";
}

TEST_F(ColumnFile, ADiskThatIsTooSmallIsAnError) {
    keep_columns_in(path_);
    EXPECT_THROW(Column<double>(std::size_t{1} << 50), SystemError);
}

}  // namespace
}  // namespace clsurf::column_file_test
