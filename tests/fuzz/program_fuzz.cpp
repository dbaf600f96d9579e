// NC programs: the first byte selects the dialect (by number, otherwise detected); the rest is the program.
#include "fuzz/fuzz_input.h"
#include "program/interpreter.h"
#include "toolpath/toolpath_summary.h"

using namespace clsurf;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    return fuzz::answer([&] {
        InterpreterOptions options;
        options.most_jumps = 5'000;  // loops cost time and show nothing new
        options.most_repeated = 50'000;
        const std::size_t dialect = static_cast<std::size_t>(data[0] - unsigned{'0'});
        if (dialect < dialects().size()) options.dialect = &dialects()[dialect];
        const Program program = parse_program(SourceText("input", fuzz::text_of(data + 1, size - 1), nullptr), options);
        (void)summarise(program.motions);
        for (const Diagnostic& d : program.diagnostics.summary()) (void)to_text(d);
    });
}
