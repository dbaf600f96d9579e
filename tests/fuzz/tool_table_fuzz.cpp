// Tool tables.
#include "fuzz/fuzz_input.h"
#include "io/readers/tool_table_file.h"

using namespace clsurf;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::answer([&] { (void)io::read_tool_table(fuzz::source_of(fuzz::text_of(data, size))); });
}
