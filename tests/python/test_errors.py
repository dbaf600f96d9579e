"""Errors: their class, their place, their words."""

import pytest

import clsurf
from conftest import SAMPLES, files


def test_a_bad_block_is_named_with_file_and_line(tmp_path):
    program = tmp_path / "bad.nc"
    program.write_text("G1 X1 F100\nG2 X5 Y5 R0.1\n")
    with pytest.raises(clsurf.InputError) as raised:
        clsurf.Part(program, SAMPLES / "bottle_uneven.biip")
    assert raised.value.file == str(program)
    assert raised.value.line == 2
    assert raised.value.text and raised.value.text in str(raised.value)
    assert isinstance(raised.value, (clsurf.Error, ValueError))


def test_a_file_that_is_not_there():
    with pytest.raises(clsurf.InputError) as raised:
        clsurf.Part("nowhere.nc", SAMPLES / "bottle_uneven.biip")
    assert raised.value.file == "nowhere.nc"
    assert raised.value.line is None


def test_a_wrong_key_of_a_machine_file(tmp_path):
    machine = tmp_path / "mill.toml"
    machine.write_text('name = "mill"\n\nspede = 3\n')
    with pytest.raises(clsurf.InputError) as raised:
        clsurf.Part(*files("bottle_uneven.nc"), machine=machine)
    assert (raised.value.file, raised.value.line) == (str(machine), 3)


def test_a_log_of_another_program():
    program, _ = files("bottle_uneven.nc")
    _, log = files("dome_loops.nc")
    with pytest.raises(clsurf.InputError):
        clsurf.Part(program, log)
    assert len(clsurf.Part(program, log, force=True)) > 0


@pytest.mark.parametrize(
    "ask",
    [
        lambda part: part.field("sped"),
        lambda part: part.channel("cmd.q"),
        lambda part: part.query(),
        lambda part: part.query(point=10**9),
        lambda part: part.query(point=-1),
        lambda part: part.query(line=10**6),
        lambda part: part.query(line=1, file="other.nc"),
        lambda part: part.query(time=float("nan")),
        lambda part: part.query(time=-5),
        lambda part: part.query(at=(1, 2, 3, 4)),
        lambda part: part.query(at=(1e4, 1e4)),
        lambda part: part.picture(view="behind"),
        lambda part: part.picture(color="sped"),
        lambda part: part.picture(size=(1, 1)),
        lambda part: part.picture(range=(2, 1)),
        lambda part: clsurf.diff(part),
        lambda part: clsurf.optimize(part.program, tolerance=0),
        lambda part: clsurf.optimize(part.program, feeds="fast"),
        lambda part: clsurf.identify([]),
    ],
)
def test_what_makes_no_sense_is_a_usage_error(uneven, ask):
    with pytest.raises(clsurf.UsageError) as raised:
        ask(uneven)
    assert str(raised.value)


@pytest.mark.parametrize("options", [{"tool": "cube:6"}, {"surface": "formed"}, {"dialect": "basic"}, {"derivative": "x"}, {"period": -1}, {"work_offset": (1,)}])
def test_options_are_checked(options):
    with pytest.raises(clsurf.UsageError):
        clsurf.Part(*files("bottle_uneven.nc"), **options)


def test_a_misspelt_field_is_suggested(uneven):
    with pytest.raises(clsurf.UsageError, match="speed"):
        uneven.field("sped")


def test_wrong_types_are_type_errors(uneven):
    with pytest.raises(TypeError):
        uneven.query(point="4822")
    with pytest.raises(TypeError):
        clsurf.Part(3, 4)


def test_bytes_that_are_no_utf8_are_replaced(tmp_path):
    log = tmp_path / "run.csv"
    rows = b"".join(b"%.3f;%.3f;0;0;%d.5\n" % (0.01 * i, 0.1 * i, i) for i in range(50))
    log.write_bytes(b"time;X;Y;Z;H\xf6he [\xb5m]\n" + rows)
    part = clsurf.Part(None, log)
    name = next(name for name in part.channels if name.startswith("H"))
    assert part.channel(name)[3] == pytest.approx(3.5)
    assert name in part.fields and len(part.field(name)) == len(part)
    log.write_bytes(b"Zeit (s);Weg [mm];H\xf6he [\xb5m]\n0;0;1\n1;1;1\n")
    with pytest.raises(clsurf.InputError) as raised:
        clsurf.Part(None, log)
    assert raised.value.file == str(log)
