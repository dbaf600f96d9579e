// Compressed data of any kind, and data that are not compressed.
#include "fuzz/fuzz_input.h"

using namespace clsurf;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::answer([&] { (void)io::unpacked(fuzz::source_of(fuzz::text_of(data, size))); });
}
