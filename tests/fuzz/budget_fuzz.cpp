// Budget files.
#include "fuzz/fuzz_input.h"
#include "io/readers/budget_file.h"

using namespace clsurf;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::answer([&] {
        const fuzz::MemoryFile file(fuzz::text_of(data, size));
        (void)io::read_budget(file.path());
    });
}
