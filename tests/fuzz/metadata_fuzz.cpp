// The JSON metadata of a log, to which the programs of the run are added.
#include "fuzz/fuzz_input.h"
#include "io/formats/program_identity.h"

using namespace clsurf;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::answer([&] {
        const ProgramReference program = io::identify(fuzz::source_of("G1 X1 F100\n"));
        (void)io::with_programs(std::string(fuzz::text_of(data, size)), std::span(&program, 1));
    });
}
