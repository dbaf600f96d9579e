// Machine files: a readable file can be written, and reads back as the same.
#include <cstdlib>

#include "fuzz/fuzz_input.h"
#include "io/readers/machine_file.h"

using namespace clsurf;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::answer([&] {
        const fuzz::MemoryFile file(fuzz::text_of(data, size));
        const std::string written = io::machine_text(io::read_machine(file.path()));
        const fuzz::MemoryFile again(written);
        if (io::machine_text(io::read_machine(again.path())) != written) std::abort();
    });
}
