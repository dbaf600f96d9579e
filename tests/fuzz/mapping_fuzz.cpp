// A mapping file, a NUL byte, and the text log for it.
#include "fuzz/fuzz_input.h"

using namespace clsurf;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::answer([&] {
        const auto [mapping, text] = fuzz::in_two(fuzz::text_of(data, size));
        const fuzz::MemoryFile file(mapping);
        io::LogOptions options;
        options.mapping = file.path();
        fuzz::look_at(io::open_log(fuzz::source_of(text), options));
    });
}
