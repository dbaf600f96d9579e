// A program read in pieces equals the program read at once.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "io/files/compressed.h"
#include "io/readers/program_file.h"
#include "program/motion_rows.h"
#include "program/program_reader.h"

namespace clsurf::program_reader_test {
namespace {

bool same(const Xyz& a, const Xyz& b) {
    const auto equal = [](double u, double v) { return u == v || (u != u && v != v); };
    return equal(a.x, b.x) && equal(a.y, b.y) && equal(a.z, b.z);
}

/// Compares the motions of a piece with those of the whole program from `first` on.
void expect_piece(const Program& piece, std::int64_t size, const Program& whole, std::int64_t first) {
    const Motions &m = piece.motions, &w = whole.motions;
    ASSERT_LE(first + size, w.size());
    EXPECT_TRUE(size == 0 || same(m.begin_of(0), w.begin_of(first)));
    for (std::int64_t k = 0; k < size; ++k) {
        const auto i = static_cast<std::size_t>(k), j = static_cast<std::size_t>(first + k);
        ASSERT_EQ(m.kind[i], w.kind[j]) << j;
        ASSERT_TRUE(same(m.end[i], w.end[j])) << j;
        ASSERT_TRUE(m.feed[i] == w.feed[j] || (std::isnan(m.feed[i]) && std::isnan(w.feed[j]))) << j;
        ASSERT_EQ(m.line[i], w.line[j]);
        ASSERT_TRUE(same(m.rotary.empty() ? Xyz{} : m.rotary[i], w.rotary.empty() ? Xyz{} : w.rotary[j])) << j;
        ASSERT_EQ(m.file.empty() ? 0 : m.file[i], w.file.empty() ? 0 : w.file[j]);
        ASSERT_EQ(m.call.empty() ? 0 : m.call[i], w.call.empty() ? 0 : w.call[j]);
        const Arc *arc = m.arc_of(k), *of_whole = w.arc_of(first + k);
        ASSERT_EQ(arc == nullptr, of_whole == nullptr) << j;
        if (arc == nullptr) continue;
        EXPECT_TRUE(same(arc->centre, of_whole->centre)) << j;
        EXPECT_EQ(arc->turns, of_whole->turns);
        EXPECT_EQ(arc->axis, of_whole->axis);
    }
}

void expect_same(ProgramReader& reader, const Program& whole) {
    EXPECT_EQ(reader.outline().motions, whole.motions.size());
    EXPECT_EQ(reader.outline().curved, !whole.motions.arcs.empty() || !whole.motions.curves.empty());
    std::int64_t at = 0;
    std::size_t event = 0;
    while (reader.next_piece()) {
        const Program& piece = reader.program();
        ASSERT_NO_FATAL_FAILURE(expect_piece(piece, reader.piece_size(), whole, at));
        for (const ProgramEvent& e : piece.events) {
            if (e.motion >= reader.piece_size()) break;
            ASSERT_LT(event, whole.events.size());
            EXPECT_EQ(e.motion + at, whole.events[event].motion);
            EXPECT_EQ(e.value, whole.events[event].value);
            ++event;
        }
        at += reader.piece_size();
    }
    EXPECT_FALSE(reader.next_piece());
    EXPECT_EQ(at, whole.motions.size());
    EXPECT_EQ(reader.program().diagnostics.summary().size(), whole.diagnostics.summary().size());
}

void expect_same(const std::string& text, const char* dialect) {
    const auto kept = std::make_shared<std::string>(text);
    InterpreterOptions options;
    options.dialect = find_dialect(dialect);
    const Program whole = parse(text, dialect);
    for (const std::int64_t piece : {1, 2, 3, 5, 1000}) {
        SCOPED_TRACE(piece);
        ProgramReader reader(SourceText("test.nc", *kept, kept), options, piece);
        expect_same(reader, whole);
    }
}

TEST(ProgramReader, SamplePrograms) {
    for (const auto& entry : std::filesystem::directory_iterator(SAMPLE_DATA "/programs")) {
        const std::string extension = entry.path().extension();
        if (extension != ".nc" && extension != ".ngc" && extension != ".mpf") continue;
        SCOPED_TRACE(entry.path().filename());
        const io::Source source = io::open_source(entry.path());
        const Program whole = io::read_program(source);
        ProgramReader reader(SourceText(source.name, source.text(), source.keep_alive), {}, 1000);
        expect_same(reader, whole);
    }
}

TEST(ProgramReader, WhatLooksBackAtMotionsThatAreForgotten) {
    // A tangential arc after a plunge and dwells: the last motion in its plane is that along X.
    expect_same("G00 G90 X0 Y0 Z0*\nG01 X10 F60*\nG01 Z-1*\nG04 F1*\nG04 F1*\nZ-2*\nG06 X10 Y10*\nG06 X20 Y20*\n",
                "heidenhain-iso");
    // An inside corner of cutter compensation moves the end of the previous motion; plunges in between follow it.
    expect_same("G0 X0 Y0 Z0\nG41.1 D2 G1 X10 Y0 F60\nX20\nZ-1\nZ-2\nY10\nX5\nG40 X0 Y20\nX1\nM2\n", "linuxcnc");
    expect_same("G21 G90 G0 X0 Y0 Z0\nG10 L12 P1 R1\nG41 D1 G1 X10 Y0 F60\nZ-1\nX20\nY10\nX5\nG40 X0 Y20\nX1\nM30\n",
                "fanuc");
    // A length that was changed since the last motion is read again at the tool change.
    expect_same("G0 X1 Y1 Z1\nT1 M6 G43\nG1 X2 F60\nT2 M6 G43\nG0 Z5\nM2\n", "linuxcnc");
    // Subprograms, loops, rotary axes that begin late, a second program number after the first program.
    expect_same(
        "o100 sub\nG1 X#1 F60\nG2 X[#1+2] I1 J0\no100 endsub\n#2=0\no1 repeat [5]\n#2=[#2+10]\no100 call [#2]\nG64 P[0.001*#2]\no1 endrepeat\nG1 A90\nX0\nM2\n",
        "linuxcnc");
    expect_same("O1\nG0 X1\nX2\nX3\nO2\nX4\n", "fanuc");
}

TEST(ProgramReader, TellsOfErrorsBeforeTheFirstMotion) {
    std::string text = "G1 F60\n";
    for (int i = 1; i < 100; ++i) text += "X" + std::to_string(i) + "\n";
    text += "G2 X0 R1\n";
    EXPECT_THROW(ProgramReader(SourceText("test.nc", text, nullptr), {}, 10), InputError);
}

TEST(ProgramReader, ForgetsWhatWasGoneThrough) {
    std::string text = "G1 F60\n";
    for (int i = 1; i < 1000; ++i) text += "S" + std::to_string(i) + " M3\nG2 X" + std::to_string(i % 2) + " Y0 R1\n";
    ProgramReader reader(SourceText("test.nc", text, nullptr), {}, 10);
    while (reader.next_piece()) {
        EXPECT_LE(reader.program().motions.size(), 12);
        EXPECT_LE(reader.program().motions.arcs.size(), 12u);
        EXPECT_LE(reader.program().events.size(), 24u);
    }
}

}  // namespace
}  // namespace clsurf::program_reader_test
