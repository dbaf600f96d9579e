// BIIP, with any first bytes.
#include "fuzz/fuzz_input.h"
#include "io/formats/known_formats.h"

using namespace clsurf;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::answer([&] {
        Log log = io::biip_format.open(fuzz::source_of(fuzz::text_of(data, size)), {});
        if (!(log.period > 0)) log.period = 0.001;
        fuzz::look_at(log);
    });
}
