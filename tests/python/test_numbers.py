"""Numbers of the package against those of the program."""

import csv
import subprocess

import numpy as np
import pytest

import clsurf
from conftest import DATA, PROGRAM, check_json, files, run_json


def exported(tmp_path, program, log, columns):
    path = tmp_path / "columns.csv"
    subprocess.run([PROGRAM, "export", program, log, "-o", path, "--columns", ",".join(columns), "-q"], check=True)
    with open(path, newline="", encoding="utf-8") as file:
        rows = csv.reader(file)
        header = next(rows)
        values = np.array([[float(x) if x else np.nan for x in row] for row in rows])
    return header, values


@pytest.mark.parametrize("name", ["bottle_uneven.nc", "dome_loops.nc", "petal_zigzag_g64.ngc"])
def test_columns_are_those_of_export(tmp_path, name):
    program, log = files(name)
    part = clsurf.Part(program, log)
    own = ["time", "line", "pass", "x", "y", "z"]
    fields = ["speed", "acceleration", "jerk", "speed_mismatch"]
    header, values = exported(tmp_path, program, log, own + fields)
    assert len(part) == len(values) > 1000
    np.testing.assert_array_equal(part.time, values[:, 0])
    np.testing.assert_array_equal(part.line, values[:, 1])
    np.testing.assert_array_equal(part.pass_number, values[:, 2])
    np.testing.assert_array_equal(part.position, values[:, 3:6])
    for i, field in enumerate(fields, start=len(own)):
        assert header[i] == f"{field} [{part.fields[field]}]"
        np.testing.assert_array_equal(part.field(field), values[:, i].astype(np.float32))


def test_speed_is_the_length_of_the_path_over_time(uneven):
    """By NumPy alone: the way of a cut pass over its time is the mean of its speeds."""
    first, last = max(uneven.passes.tolist(), key=lambda ends: ends[1] - ends[0])
    way = np.linalg.norm(np.diff(uneven.position[first : last + 1], axis=0), axis=1).sum()
    mean = way / (uneven.time[last] - uneven.time[first]) * 60
    assert abs(np.mean(uneven.field("speed")[first : last + 1]) / mean - 1) < 0.01


def test_check_is_that_of_the_program(uneven, uneven_report):
    assert uneven.check() == uneven_report


@pytest.mark.parametrize("surface", ["commanded", "feedback"])
def test_check_measures_from_the_wanted_positions(surface):
    program, log = files("bottle_uneven.nc")
    report = check_json(program, log, "--tool", "none", "--surface", surface)
    assert clsurf.Part(program, log, tool="none", surface=surface).check() == report


def test_check_with_a_machine_has_its_limits(tmp_path):
    program, log = files("dome_loops.nc")
    machine = tmp_path / "slow.toml"
    machine.write_text('[[axis]]\nname = "x"\nmax_speed = 1200\n')
    report = clsurf.Part(program, log, tool="none", machine=machine).check()
    assert report == check_json(program, log, "--tool", "none", "--machine", machine)
    assert report["limits"]


def test_defects_are_a_table_of_the_same_numbers(uneven, uneven_report):
    expected = uneven_report["defects"]
    frame = uneven.defects()
    assert len(frame) == len(expected) > 0
    assert list(frame.index) == [defect["id"] for defect in expected]
    for column in frame.columns:
        values = [None if value is None or value != value else value for value in frame[column]]
        assert values == [defect.get(column) for defect in expected]


@pytest.fixture
def clean_plane(tmp_path):
    """A zigzag on a plane, and its simulated log."""
    program, log = tmp_path / "plane.nc", tmp_path / "plane.biip"
    passes = [f"G1 Y{0.3 * k:.1f}\nG1 X{0 if k % 2 else 30}" for k in range(16)]
    program.write_text("\n".join(["G0 X0 Y0 Z5", "G1 Z0 F1200", *passes, "G0 Z5", "M2", ""]))
    subprocess.run([PROGRAM, "simulate", program, "-o", log, "-q"], check=True)
    return program, log


def test_a_part_without_defects_has_an_empty_table(clean_plane, uneven_report):
    frame = clsurf.Part(*clean_plane, tool="none").defects()
    assert len(frame) == 0
    always = set.intersection(*(set(defect) for defect in uneven_report["defects"]))
    assert set(frame.reset_index().columns) == always - {"contact_mm", "formed_um", "formed_note", "delta_e00"}


def test_a_log_that_cannot_be_judged_warns(tmp_path, clean_plane):
    program, log = clean_plane
    slow = tmp_path / "slow.csv"
    part = clsurf.Part(program, log, tool="none")
    rows = np.column_stack([part.field(f"cmd.{axis}")[::32] for axis in "xyz"])
    np.savetxt(slow, rows, delimiter=",", header="cmd.x,cmd.y,cmd.z", comments="")
    with pytest.warns(UserWarning, match="not judged: A record comes every 32 ms"):
        clsurf.Part(program, slow, tool="none", period=0.032).defects()


@pytest.mark.parametrize(
    "wanted, words",
    [
        ({"point": 4822}, ["--point", "4822"]),
        ({"line": 560}, ["--line", "560"]),
        ({"time": 4.822}, ["--time", "4.822"]),
        ({"at": (1.5, -4.7, 4.9)}, ["--at", "1.5,-4.7,4.9"]),
        ({"at": (1.5, -4.7), "nearest": 3}, ["--at", "1.5,-4.7", "--nearest", "3"]),
        ({"at": (1.9, -5.6), "of_tip": True}, ["--at", "tip:1.9,-5.6"]),
    ],
)
def test_query_is_that_of_the_program(uneven, uneven_files, wanted, words):
    matches = uneven.query(**wanted)
    assert matches
    assert matches == run_json("query", *uneven_files, "--tool", "ball:6", *words)["matches"]


def test_the_surface_is_that_of_export(uneven, uneven_files, tmp_path):
    vtk = pytest.importorskip("vtkmodules.vtkIOXML")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    path = tmp_path / "surface.vtp"
    subprocess.run([PROGRAM, "export", *uneven_files, "-o", path, "--columns", "speed,point,line,pass,time", "-q"], check=True)
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    written = reader.GetOutput()
    surface = uneven.surface()
    made = surface.to_vtk(["speed", "point", "line", "pass", "time"])
    for mesh in (written, made):
        np.testing.assert_array_equal(vtk_to_numpy(mesh.GetPoints().GetData()), surface.points)
        np.testing.assert_array_equal(vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3), surface.triangles)
        np.testing.assert_array_equal(vtk_to_numpy(mesh.GetPointData().GetArray("speed")), uneven.field("speed"))
        for name, column in (("line", uneven.line), ("point", np.arange(len(uneven), dtype=np.uint32))):
            values = vtk_to_numpy(mesh.GetPointData().GetArray(name))
            assert values.dtype == np.uint32
            np.testing.assert_array_equal(values, column)
    for get in ("GetConnectivityArray", "GetOffsetsArray"):
        np.testing.assert_array_equal(
            vtk_to_numpy(getattr(made.GetLines(), get)()), vtk_to_numpy(getattr(written.GetLines(), get)())
        )


def test_a_channel_is_what_the_log_stores():
    part = clsurf.Part(*files("bottle_uneven.nc"))
    assert part.channels["cmd.x"] == "mm"
    offset = part.position[:, 0] - part.channel("cmd.x")
    assert np.ptp(offset) < 1e-9


def test_simulate_is_that_of_the_program(tmp_path):
    program = DATA / "programs" / "bottle_uneven.nc"
    log = tmp_path / "run.biip"
    report = run_json("simulate", program, "-o", log)
    part = clsurf.simulate(program)
    assert part.simulation == report
    recorded = clsurf.Part(program, log)
    assert recorded.simulation is None
    np.testing.assert_array_equal(part.position, recorded.position)
    np.testing.assert_array_equal(part.line, recorded.line)
    np.testing.assert_array_equal(part.field("speed"), recorded.field("speed"))
    checked, checked_recording = part.check(), recorded.check()
    assert checked["defects"] == checked_recording["defects"]
    assert checked["simulation"] == checked_recording["simulation"] != None  # noqa: E711


def test_diff_is_that_of_the_program():
    program, log = files("bottle_uneven.nc")
    other_program, other = files("bottle_uneven_repaired.nc")
    report = clsurf.diff(clsurf.Part(program, log, tool="none"), clsurf.Part(other_program, other, tool="none"))
    expected = run_json("diff", log, other, "--program", program, "--tool", "none")
    assert report["runs"] and report["runs"][0]["quantities"] == expected["runs"][0]["quantities"]


def test_identify_is_that_of_the_program(tmp_path):
    program, log = files("transition_g61.nc")
    found = clsurf.identify([clsurf.Part(program, log)])
    written = tmp_path / "machine.toml"
    report = run_json("identify", program, log, "-o", written)
    assert found.report == report
    assert found.text == written.read_text()
