"""Who owns the memory of arrays, how long it lives, and threads."""

import gc
import resource
import threading
import time

import numpy as np
import pytest

import clsurf
from conftest import files


def address(array):
    return array.__array_interface__["data"][0]


COLUMNS = {
    "time": lambda part: part.time,
    "line": lambda part: part.line,
    "position": lambda part: part.position,
    "pass_number": lambda part: part.pass_number,
    "passes": lambda part: part.passes,
    "field": lambda part: part.field("speed"),
    "channel": lambda part: part.channel("cmd.x"),
    "points": lambda part: part.surface().points,
    "triangles": lambda part: part.surface().triangles,
}


@pytest.mark.parametrize("name", COLUMNS)
def test_nothing_is_copied(uneven, name):
    first, second = COLUMNS[name](uneven), COLUMNS[name](uneven)
    assert first.size > 0
    assert address(first) == address(second)
    assert not first.flags.owndata
    assert not first.flags.writeable
    with pytest.raises(ValueError):
        first[...] = 0
    with pytest.raises(ValueError):
        first.setflags(write=True)


@pytest.mark.parametrize("name", COLUMNS)
def test_arrays_outlive_their_part(uneven, uneven_files, name):
    part = clsurf.Part(*uneven_files, tool="ball:6")
    array = COLUMNS[name](part)
    del part
    gc.collect()
    # What was freed would be taken by others.
    others = [np.full(array.shape, 7, array.dtype) for _ in range(20)]
    np.testing.assert_array_equal(array, COLUMNS[name](uneven))
    del others


def test_a_mesh_outlives_its_part(uneven_files, uneven):
    support = pytest.importorskip("vtkmodules.util.numpy_support")
    mesh = clsurf.Part(*uneven_files).surface().to_vtk()
    gc.collect()
    np.testing.assert_array_equal(support.vtk_to_numpy(mesh.GetPoints().GetData()), uneven.surface().points)


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def test_memory_does_not_grow():
    program, log = files("dome_loops.nc")

    def load():
        part = clsurf.Part(program, log)
        kept = (part.time, part.line, part.position, part.field("speed"), part.surface().triangles, part.query(point=100))
        return sum(array.nbytes for array in kept[:5])

    for _ in range(5):
        size = load()
    gc.collect()
    before = resident()
    for _ in range(50):
        load()
    gc.collect()
    # What each load takes, kept 50 times, would show.
    assert resident() - before < 10 * size


def test_two_threads_ask_the_same_part(uneven_files):
    part = clsurf.Part(*uneven_files, tool="none")
    alone = clsurf.Part(*uneven_files, tool="none")
    answers = [None] * 4

    def ask(i):
        answers[i] = (part.check(), address(part.field("acceleration")), part.query(at=(1.5, -4.7, 4.9)))

    threads = [threading.Thread(target=ask, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(answer == answers[0] for answer in answers)
    assert answers[0][0] == alone.check()


def test_two_threads_read_different_parts():
    parts = [None] * 4
    names = ["bottle_uneven.nc", "dome_loops.nc"] * 2

    def read(i):
        parts[i] = clsurf.Part(*files(names[i])).field("speed")

    threads = [threading.Thread(target=read, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    np.testing.assert_array_equal(parts[0], parts[2])
    np.testing.assert_array_equal(parts[1], parts[3])


def test_other_threads_run_while_a_part_is_judged(uneven_files):
    part = clsurf.Part(*uneven_files, tool="none")
    worker = threading.Thread(target=part.check)
    worker.start()
    # With the interpreter's lock held, this thread would not run before the end.
    turns = 0
    while worker.is_alive():
        turns += 1
        time.sleep(0.001)
    assert turns > 5
