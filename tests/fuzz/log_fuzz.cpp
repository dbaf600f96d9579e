// Any log that needs no second file: BIIP, text with a header, the formats of controls, compressed or not.
#include "fuzz/fuzz_input.h"

using namespace clsurf;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::answer([&] {
        io::LogOptions options;
        options.period = 0.001;
        fuzz::look_at(io::open_log(io::unpacked(fuzz::source_of(fuzz::text_of(data, size))), options));
    });
}
