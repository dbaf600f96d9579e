#include "io/files/overwrite_guard.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/mapped_file.h"
#include "support/temporary_folder.h"

namespace clsurf::io::overwrite_guard_test {
namespace {

constexpr int refused = 7;

/// The guard cannot be removed: `use` runs in a separate process, whose exit code is the result.
template <typename Use>
[[noreturn]] void guarded(Use&& use) {
    guard_inputs();
    try {
        use();
    } catch (const UsageError&) { std::_Exit(refused); }
    std::_Exit(0);
}

TEST(OverwriteGuard, RefusesWhatWasReadBefore) {
    const test::TemporaryFolder folder;
    const std::string input = folder.write("input", "text");
    std::filesystem::create_hard_link(input, folder / "link");
    EXPECT_EXIT(guarded([&] {
                    (void)map_file(input);
                    AtomicFile(folder / "link");
                }),
                testing::ExitedWithCode(refused), "");
}

TEST(OverwriteGuard, RefusesToReadWhatIsBeingWritten) {
    const test::TemporaryFolder folder;
    const std::string input = folder.write("input", "text");
    EXPECT_EXIT(guarded([&] {
                    const AtomicFile output(input);
                    (void)map_file(input);
                }),
                testing::ExitedWithCode(refused), "");
}

TEST(OverwriteGuard, RefusesTwoOutputsOfOneName) {
    const test::TemporaryFolder folder;
    EXPECT_EXIT(guarded([&] {
                    const AtomicFile output(folder / "new");
                    const AtomicFile again(folder / "./new");
                }),
                testing::ExitedWithCode(refused), "");
}

TEST(OverwriteGuard, LetsGoWhatIsWritten) {
    const test::TemporaryFolder folder;
    EXPECT_EXIT(guarded([&] {
                    AtomicFile output(folder / "new");
                    output.write("text");
                    output.commit();
                    (void)map_file(folder / "new");
                }),
                testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace clsurf::io::overwrite_guard_test
