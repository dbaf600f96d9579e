#include "io/files/atomic_file.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/files/mapped_file.h"
#include "support/temporary_folder.h"

namespace clsurf::io::atomic_file_test {
namespace {

TEST(AtomicFile, LeavesTheOldFileUntilItIsCommitted) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("out", "old");
    {
        AtomicFile file(path);
        file.write("new");
        EXPECT_EQ(test::read_file(path), "old");
    }
    EXPECT_EQ(test::read_file(path), "old");
    EXPECT_EQ(folder.files(), 1u);
    AtomicFile file(path);
    file.write("new");
    file.commit();
    EXPECT_EQ(test::read_file(path), "new");
    EXPECT_EQ(folder.files(), 1u);
}

TEST(AtomicFile, LeavesDevicesAndLinksWhatTheyAre) {
    AtomicFile full("/dev/full");
    full.write("new");
    EXPECT_THROW(full.commit(), SystemError);
    const test::TemporaryFolder folder;
    const std::string target = folder.write("target", "old");
    std::filesystem::create_symlink(target, folder / "link");
    AtomicFile file(folder / "link");
    file.write("new");
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(test::read_file(target), "new");
}

TEST(AtomicFile, KeepsTheOrderOfSmallAndLargePieces) {
    const test::TemporaryFolder folder;
    std::string expected;
    AtomicFile file(folder / "out");
    // Larger than the buffer, as large, and smaller.
    for (const std::size_t bytes : {5U, 3U << 20U, 7U, 1U << 20U, (1U << 20U) - 1, 1U, 2U << 20U}) {
        const std::string piece(bytes, static_cast<char>('a' + expected.size() % 26));
        file.write(piece);
        expected += piece;
    }
    file.commit();
    EXPECT_TRUE(test::read_file(folder / "out") == expected);
}

TEST(AtomicFile, FailsWhereAFileThatIsReadBecameShorter) {
    const test::TemporaryFolder folder;
    const Source input = map_file(folder.write("in", "0123456789"));
    AtomicFile file(folder / "out");
    std::filesystem::resize_file(folder / "in", 5);
    EXPECT_THROW(file.commit(), InputError);
}

TEST(AtomicFile, DoesNotFailForAFileThatIsNoLongerRead) {
    const test::TemporaryFolder folder;
    {
        const Source input = map_file(folder.write("in", "0123456789"));
        std::filesystem::resize_file(folder / "in", 5);
    }
    AtomicFile file(folder / "out");
    file.write("new");
    file.commit();
    EXPECT_EQ(test::read_file(folder / "out"), "new");
}

TEST(AtomicFile, SaysWhereItCannotWrite) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(AtomicFile(folder / "no/such/folder"), SystemError);
    EXPECT_THROW(AtomicFile(folder / ""), SystemError);
}

}  // namespace
}  // namespace clsurf::io::atomic_file_test
